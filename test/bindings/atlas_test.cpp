// SPDX-License-Identifier: MIT
// The C interface: the same atlas as in C++, arrays that fit together, and faults that come back as numbers.
#include <Atlas/atlas.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/generate_atlas.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace {

struct Destroy
{
  void operator()(atlas_scene* scene) const { atlas_destroy(scene); }
};
using Scene = std::unique_ptr<atlas_scene, Destroy>;

/// A mesh with the arrays behind it.
struct Mesh
{
  std::vector<double> positions;
  std::vector<unsigned int> indices, sizes;
  std::vector<float> corner_uvs;

  atlas_mesh in_c() const
  {
    atlas_mesh mesh;
    ATLAS_MESH_INIT(&mesh);
    mesh.positions = positions.data();
    mesh.position_type = ATLAS_DOUBLE;
    mesh.number_of_vertices = positions.size() / 3;
    mesh.indices = indices.data();
    mesh.face_sizes = sizes.empty() ? nullptr : sizes.data();
    mesh.number_of_faces = sizes.empty() ? indices.size() / 3 : sizes.size();
    mesh.corner_uvs = corner_uvs.empty() ? nullptr : corner_uvs.data();
    return mesh;
  }
};

/// A box of quads.
Mesh box()
{
  return {{0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 0, 0, 0, 1, 2, 0, 1, 2, 1, 1, 0, 1, 1},
          {3, 2, 1, 0, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7},
          {4, 4, 4, 4, 4, 4},
          {}};
}

/// A flat square of two triangles, with coordinates; shifted ones overlap themselves.
Mesh square(bool is_folded = false)
{
  const float x = is_folded ? 0.75f : 0.25f;
  return {{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0},
          {0, 1, 2, 0, 2, 3},
          {},
          {.25f, .25f, .75f, .25f, .75f, .75f, .25f, .25f, .75f, .75f, x, is_folded ? .5f : .75f}};
}

Scene scene_of(const std::vector<Mesh>& meshes)
{
  Scene scene(atlas_create());
  for (const Mesh& mesh : meshes) {
    const atlas_mesh in_c = mesh.in_c();
    EXPECT_EQ(atlas_add_mesh(scene.get(), &in_c), ATLAS_OK) << atlas_error(scene.get());
  }
  return scene;
}

atlas_options defaults()
{
  atlas_options options;
  EXPECT_EQ(ATLAS_OPTIONS_INIT(&options), ATLAS_OK);
  return options;
}

atlas_result result_of(const Scene& scene, std::size_t mesh)
{
  atlas_result result;
  ATLAS_RESULT_INIT(&result);
  EXPECT_EQ(atlas_get_result(scene.get(), mesh, &result), ATLAS_OK) << atlas_error(scene.get());
  return result;
}

atlas_summary summary_of(const Scene& scene)
{
  atlas_summary summary;
  ATLAS_SUMMARY_INIT(&summary);
  EXPECT_EQ(atlas_get_summary(scene.get(), &summary), ATLAS_OK);
  return summary;
}

std::size_t charts_of(const Mesh& mesh, const atlas_options& options)
{
  const Scene scene = scene_of({mesh});
  EXPECT_EQ(atlas_generate(scene.get(), &options), ATLAS_OK) << atlas_error(scene.get());
  return summary_of(scene).number_of_charts;
}

} // namespace

TEST(atlas_h, CoordinatesAreThoseOfTheLibrary)
{
  const Mesh mesh = box();
  std::vector<Atlas::Point_3> points;
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3)
    points.emplace_back(mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]);
  const Atlas::Surface surface =
      Atlas::build_surface(points, {0, 4, 8, 12, 16, 20, 24}, {mesh.indices.begin(), mesh.indices.end()});
  std::vector<Atlas::Point_2> uv;
  const Atlas::Atlas_report report =
      Atlas::generate_atlas(surface, uv, Atlas::parameters::texture_size(256).gutter(4));

  const Scene scene = scene_of({mesh});
  atlas_options options = defaults();
  options.width = options.height = 256;
  options.gutter = 4;
  ASSERT_EQ(atlas_generate(scene.get(), &options), ATLAS_OK) << atlas_error(scene.get());
  const atlas_result result = result_of(scene, 0);
  ASSERT_EQ(result.number_of_corners, uv.size());
  for (std::size_t c = 0; c < uv.size(); ++c) {
    EXPECT_EQ(result.corner_uvs[2 * c], uv[c].x());
    EXPECT_EQ(result.corner_uvs[2 * c + 1], uv[c].y());
  }
  for (std::size_t f = 0; f < 6; ++f)
    EXPECT_EQ(result.face_charts[f], report.face_chart[f]);
  EXPECT_EQ(summary_of(scene).number_of_charts, report.charts.size());
  EXPECT_EQ(summary_of(scene).texels_per_unit, report.density);
  EXPECT_STREQ(atlas_error(scene.get()), "");
}

TEST(atlas_h, NewVerticesFitTheCorners)
{
  const std::vector<Mesh> meshes = {box(), square()};
  const Scene scene = scene_of(meshes);
  ASSERT_EQ(atlas_number_of_meshes(scene.get()), 2u);
  ASSERT_EQ(atlas_generate(scene.get(), nullptr), ATLAS_OK);
  std::set<unsigned int> charts;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const atlas_result r = result_of(scene, i);
    ASSERT_EQ(r.number_of_corners, meshes[i].indices.size());
    std::set<std::tuple<unsigned int, float, float>> vertices;
    for (std::size_t c = 0; c < r.number_of_corners; ++c) {
      ASSERT_LT(r.indices[c], r.number_of_vertices);
      EXPECT_EQ(r.vmapping[r.indices[c]], meshes[i].indices[c]);
      EXPECT_EQ(std::memcmp(r.uvs + 2 * r.indices[c], r.corner_uvs + 2 * c, 2 * sizeof(float)), 0);
      vertices.emplace(meshes[i].indices[c], r.corner_uvs[2 * c], r.corner_uvs[2 * c + 1]);
    }
    EXPECT_EQ(vertices.size(), r.number_of_vertices);
    ASSERT_EQ(r.number_of_triangles, i == 0 ? 12u : 2u);
    for (std::size_t t = 0; t < r.number_of_triangles; ++t)
      EXPECT_LT(r.face_of_triangle[t], r.number_of_faces);
    charts.insert(r.face_charts, r.face_charts + r.number_of_faces);
  }
  EXPECT_EQ(charts.size(), summary_of(scene).number_of_charts);
  const nlohmann::json report = nlohmann::json::parse(atlas_report(scene.get()));
  EXPECT_EQ(report["number_of_charts"], charts.size());
  EXPECT_EQ(report["certificate"]["is_valid"], true);
}

TEST(atlas_h, PositionsMayBeFloatsWithOtherThingsBetween)
{
  const Mesh mesh = box();
  std::vector<float> floats;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    floats.push_back(static_cast<float>(mesh.positions[i]));
    if (i % 3 == 2)
      floats.insert(floats.end(), 2, std::numeric_limits<float>::quiet_NaN());
  }
  atlas_mesh in_c = mesh.in_c();
  in_c.positions = floats.data();
  in_c.position_type = ATLAS_FLOAT;
  in_c.position_stride = 5 * sizeof(float);
  const Scene scene = scene_of({}), other = scene_of({mesh});
  ASSERT_EQ(atlas_add_mesh(scene.get(), &in_c), ATLAS_OK);
  ASSERT_EQ(atlas_generate(scene.get(), nullptr), ATLAS_OK);
  ASSERT_EQ(atlas_generate(other.get(), nullptr), ATLAS_OK);
  EXPECT_EQ(std::memcmp(result_of(scene, 0).corner_uvs, result_of(other, 0).corner_uvs, 48 * sizeof(float)),
            0);
}

TEST(atlas_h, OptionsArrive)
{
  atlas_options options = defaults();
  EXPECT_EQ(charts_of(square(), options), 1u);
  options.hard_angle = 60;
  EXPECT_EQ(charts_of(box(), options), 6u);
  options = defaults();
  options.max_charts = 1;
  options.threads = 1;
  EXPECT_EQ(charts_of(box(), options), 1u);

  // A seam between the two triangles, and none.
  const unsigned int diagonal[2] = {2, 0};
  const Mesh arrays = square();
  atlas_mesh mesh = arrays.in_c();
  mesh.seams = diagonal;
  mesh.number_of_seams = 1;
  const Scene scene = scene_of({});
  ASSERT_EQ(atlas_add_mesh(scene.get(), &mesh), ATLAS_OK);
  ASSERT_EQ(atlas_generate(scene.get(), nullptr), ATLAS_OK);
  EXPECT_EQ(summary_of(scene).number_of_charts, 2u);
}

TEST(atlas_h, StagesHaveNames)
{
  atlas_options options = defaults();
  EXPECT_EQ(charts_of(box(), options), 1u);
  options.segmentation = "normals";
  EXPECT_EQ(charts_of(box(), options), 3u);
  options.segmentation = "seams";
  options.hard_angle = 60;
  options.parameterizer = "tutte";
  options.optimizer = "none";
  options.packer = "rows";
  EXPECT_EQ(charts_of(box(), options), 6u);
}

/// Two triangles that do not quite meet.
TEST(atlas_h, NearVerticesAreWelded)
{
  const Mesh apart = {
      {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 1e-7, 1, 1, 1e-7, 0, 1, 1e-7}, {0, 1, 2, 3, 4, 5}, {}, {}};
  atlas_options options = defaults();
  EXPECT_EQ(charts_of(apart, options), 2u);
  options.weld = 1e-5;
  EXPECT_EQ(charts_of(apart, options), 1u);
}

/// The mean height of the vertices on seams of a torus.
double height_of_seams(const atlas_options& options, bool is_seen_above)
{
  constexpr unsigned int n = 24, m = 12;
  Mesh torus;
  std::vector<double> visibility;
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < m; ++j) {
      const double a = 2 * CGAL_PI * i / n, b = 2 * CGAL_PI * j / m, r = 2 + 0.7 * std::cos(b);
      torus.positions.insert(torus.positions.end(), {r * std::cos(a), r * std::sin(a), 0.7 * std::sin(b)});
      visibility.push_back(std::sin(b) > 0 ? 1 : 0);
      const unsigned int k = (i + 1) % n, l = (j + 1) % m;
      torus.indices.insert(torus.indices.end(), {m * i + j, m * k + j, m * k + l, m * i + l});
      torus.sizes.push_back(4);
    }
  atlas_mesh mesh = torus.in_c();
  mesh.visibility = is_seen_above ? visibility.data() : nullptr;
  const Scene scene = scene_of({});
  EXPECT_EQ(atlas_add_mesh(scene.get(), &mesh), ATLAS_OK);
  EXPECT_EQ(atlas_generate(scene.get(), &options), ATLAS_OK);
  atlas_result result;
  ATLAS_RESULT_INIT(&result);
  EXPECT_EQ(atlas_get_result(scene.get(), 0, &result), ATLAS_OK);
  std::vector<int> copies(visibility.size()); // of vertices at seams there are several
  for (std::size_t v = 0; v < result.number_of_vertices; ++v)
    ++copies[result.vmapping[v]];
  double sum = 0, count = 0;
  for (std::size_t v = 0; v < copies.size(); ++v)
    if (copies[v] > 1) {
      sum += torus.positions[3 * v + 2];
      ++count;
    }
  return sum / count;
}

TEST(atlas_h, SeamsAreHidden)
{
  atlas_options options = defaults();
  options.hide_seams = ATLAS_HIDE_DOME;
  options.hide_axis[2] = 2;
  const double below = height_of_seams(options, false);
  options.hide_axis[2] = -2;
  const double above = height_of_seams(options, false);
  EXPECT_LT(below + 0.1, above);
  options.hide_seams = ATLAS_HIDE_VIEW;
  EXPECT_GT(height_of_seams(options, false), below + 0.1);
  EXPECT_LT(height_of_seams(defaults(), true) + 0.1, above) << "by a map";
}

/// A strip of 40 quadrilaterals, which alone leaves most of the page empty.
TEST(atlas_h, ChartsAreCutForThePageUnlessThatIsForbidden)
{
  Mesh strip;
  for (unsigned int i = 0; i <= 40; ++i)
    for (unsigned int j = 0; j < 2; ++j)
      strip.positions.insert(strip.positions.end(), {double(i), double(j), 0});
  for (unsigned int i = 0; i < 40; ++i)
    strip.indices.insert(strip.indices.end(), {2 * i, 2 * i + 2, 2 * i + 3, 2 * i, 2 * i + 3, 2 * i + 1});
  atlas_options options = defaults();
  EXPECT_GT(charts_of(strip, options), 1u);
  options.symmetry = ATLAS_SYMMETRY_AUTO;
  EXPECT_EQ(charts_of(strip, options), 1u) << "mirrored charts stay so";
  options = defaults();
  options.seam_exchange_rate = 0;
  EXPECT_EQ(charts_of(strip, options), 1u);
}

TEST(atlas_h, BoundsAndStackingReachTheReport)
{
  const Scene scene = scene_of({square(), square()});
  atlas_options options = defaults();
  options.measure = ATLAS_MEASURE_L2_STRETCH;
  options.max_distortion = 1.25;
  options.max_stretch = 1.5;
  options.max_stretch_share = 0.75;
  options.stack = ATLAS_STACK_COPIES;
  options.min_coverage = 0.25;
  ASSERT_EQ(atlas_generate(scene.get(), &options), ATLAS_OK) << atlas_error(scene.get());
  const nlohmann::json report = nlohmann::json::parse(atlas_report(scene.get()));
  EXPECT_EQ(report["bound"]["measure"], "l2_stretch");
  EXPECT_EQ(report["bound"]["max"], 1.25);
  EXPECT_EQ(report["bound"]["max_stretch"], 1.5);
  EXPECT_EQ(report["bound"]["max_stretch_share"], 0.75);
  EXPECT_EQ(report["charts_beyond_bound"], 0);
  EXPECT_EQ(report["stacked_charts"], 1);
  EXPECT_EQ(report["min_coverage"], 0.25);
  options.mode = ATLAS_MODE_PAPER; // merges nothing
  EXPECT_EQ(atlas_generate(scene.get(), &options), ATLAS_INVALID_ARGUMENT);
}

TEST(atlas_h, ChartsStandUprightOnTexels)
{
  const Mesh wall = {{0, 0, 0, 1, 0, 0, 1, 0, 2.7, 0, 0, 2.7}, {0, 1, 2, 3}, {4}, {}};
  for (const double up : {1., -1.}) {
    const Scene scene = scene_of({wall});
    atlas_options options = defaults();
    options.width = options.height = 200;
    options.up[2] = up;
    options.snap = 1;
    ASSERT_EQ(atlas_generate(scene.get(), &options), ATLAS_OK) << atlas_error(scene.get());
    const float* uv = result_of(scene, 0).corner_uvs;
    EXPECT_GT(up * (uv[7] - uv[1]), 0.5); // from the first vertex to the last
    for (int i = 0; i < 8; ++i)
      EXPECT_NEAR(200 * uv[i], std::round(200 * uv[i]), 1e-3);
  }
}

TEST(atlas_h, ModeOfThePaperOnAPageOfAnyRatio)
{
  const Mesh strip = {{0, 0, 0, 9, 0, 0, 9, 1, 0, 0, 1, 0}, {0, 1, 2, 3}, {4}, {}};
  const Scene scene = scene_of({strip});
  atlas_options options = defaults();
  options.mode = ATLAS_MODE_PAPER;
  options.free_aspect = 1;
  options.width = options.height = 256;
  ASSERT_EQ(atlas_generate(scene.get(), &options), ATLAS_OK) << atlas_error(scene.get());
  const auto [shorter, longer] = std::minmax({summary_of(scene).width, summary_of(scene).height});
  EXPECT_GT(longer, 2 * shorter);
}

TEST(atlas_h, MaterialsHaveTheirDensities)
{
  const Mesh arrays = square();
  const unsigned int materials[2] = {7, 4000000000u};
  atlas_mesh mesh = arrays.in_c();
  mesh.face_materials = materials;
  const atlas_material_rule rule = {4000000000u, 2, 0, 0};
  atlas_options options = defaults();
  options.rules = &rule;
  options.number_of_rules = 1;
  const Scene scene = scene_of({});
  ASSERT_EQ(atlas_add_mesh(scene.get(), &mesh), ATLAS_OK);
  ASSERT_EQ(atlas_generate(scene.get(), &options), ATLAS_OK) << atlas_error(scene.get());
  const float* uv = result_of(scene, 0).corner_uvs;
  const auto side = [&](int c) {
    return std::hypot(uv[2 * c + 2] - uv[2 * c], uv[2 * c + 3] - uv[2 * c + 1]);
  };
  EXPECT_NEAR(side(4) / side(0), 2, 1e-3); // (1, 1) to (0, 1), and (0, 0) to (1, 0)
  const atlas_material_rule unknown = {8, 2, 0, 0};
  options.rules = &unknown;
  EXPECT_EQ(atlas_generate(scene.get(), &options), ATLAS_INVALID_ARGUMENT);
  EXPECT_NE(std::string(atlas_error(scene.get())).find("8"), std::string::npos);
}

TEST(atlas_h, CoordinatesAreVerifiedPackedAndKept)
{
  const Scene good = scene_of({square()}), bad = scene_of({square(true)});
  EXPECT_EQ(atlas_verify(good.get(), nullptr), ATLAS_OK) << atlas_error(good.get());
  EXPECT_EQ(atlas_verify(bad.get(), nullptr), ATLAS_NOT_VALID);
  EXPECT_NE(std::string(atlas_error(bad.get())), atlas_message(ATLAS_NOT_VALID)); // it says what is wrong
  EXPECT_EQ(nlohmann::json::parse(atlas_report(bad.get()))["is_valid"], false);
  atlas_result result;
  ATLAS_RESULT_INIT(&result);
  EXPECT_EQ(atlas_get_result(good.get(), 0, &result), ATLAS_INVALID_ARGUMENT);

  ASSERT_EQ(atlas_pack(good.get(), nullptr), ATLAS_OK) << atlas_error(good.get());
  EXPECT_GT(summary_of(good).efficiency, 0.9);
  EXPECT_EQ(result_of(good, 0).number_of_vertices, 4u);
  atlas_options options = defaults();
  options.keep_uvs = 1;
  EXPECT_EQ(atlas_generate(good.get(), &options), ATLAS_OK);
  EXPECT_EQ(result_of(good, 0).number_of_vertices, 4u);
  const Scene none = scene_of({box()});
  EXPECT_EQ(atlas_pack(none.get(), nullptr), ATLAS_INVALID_ARGUMENT);
  options.defragment = 1; // charts either stay or merge
  EXPECT_EQ(atlas_generate(good.get(), &options), ATLAS_INVALID_ARGUMENT);
  options.keep_uvs = 0;
  EXPECT_EQ(atlas_generate(good.get(), &options), ATLAS_OK);
  EXPECT_EQ(atlas_generate(none.get(), &options), ATLAS_INVALID_ARGUMENT);
}

TEST(atlas_h, FacesAndCornersThatStay)
{
  Mesh mesh = box();
  atlas_options options = defaults();
  options.width = options.height = 256;
  options.hard_angle = 60;
  const Scene first = scene_of({mesh});
  ASSERT_EQ(atlas_generate(first.get(), &options), ATLAS_OK);
  const float* const uv = result_of(first, 0).corner_uvs;
  mesh.corner_uvs.assign(uv, uv + 48);

  // The first face is unwrapped anew, beside others that stay on their pages.
  const unsigned char is_selected[6] = {1};
  const unsigned int pages[6] = {0, 0, 0, 0, 0, 2};
  atlas_mesh in_c = mesh.in_c();
  in_c.selected = is_selected;
  in_c.face_pages = pages;
  const Scene part(atlas_create());
  ASSERT_EQ(atlas_add_mesh(part.get(), &in_c), ATLAS_OK);
  ASSERT_EQ(atlas_generate(part.get(), &options), ATLAS_OK) << atlas_error(part.get());
  atlas_result result = result_of(part, 0);
  EXPECT_TRUE(std::equal(uv + 8, uv + 48, result.corner_uvs + 8));
  EXPECT_TRUE(std::equal(pages + 1, pages + 6, result.face_pages + 1));

  // A corner is moved, and its chart follows.
  mesh.corner_uvs[0] = mesh.corner_uvs[1] = 0.5f;
  const unsigned char is_pinned[24] = {1};
  in_c = mesh.in_c();
  in_c.pinned = is_pinned;
  const Scene pinned(atlas_create());
  ASSERT_EQ(atlas_add_mesh(pinned.get(), &in_c), ATLAS_OK);
  ASSERT_EQ(atlas_generate(pinned.get(), &options), ATLAS_OK) << atlas_error(pinned.get());
  result = result_of(pinned, 0);
  EXPECT_EQ(result.corner_uvs[0], 0.5f);
  EXPECT_EQ(result.corner_uvs[1], 0.5f);
  in_c.corner_uvs = nullptr;
  const Scene nowhere(atlas_create());
  ASSERT_EQ(atlas_add_mesh(nowhere.get(), &in_c), ATLAS_OK);
  EXPECT_EQ(atlas_generate(nowhere.get(), &options), ATLAS_INVALID_ARGUMENT);
}

TEST(atlas_h, TheListenerCancels)
{
  struct Listener
  {
    std::set<int> stages;
    bool goes_on = true;
    static int hear(void* self, int stage, double fraction)
    {
      EXPECT_TRUE(fraction >= 0 && fraction <= 1);
      static_cast<Listener*>(self)->stages.insert(stage);
      return static_cast<Listener*>(self)->goes_on;
    }
  } listener;
  const Scene scene = scene_of({box()});
  atlas_options options = defaults();
  options.progress = Listener::hear;
  options.user = &listener;
  EXPECT_EQ(atlas_generate(scene.get(), &options), ATLAS_OK);
  EXPECT_EQ(listener.stages.size(), 4u);
  listener.goes_on = false;
  EXPECT_EQ(atlas_generate(scene.get(), &options), ATLAS_CANCELLED);
  EXPECT_STREQ(atlas_error(scene.get()), atlas_message(ATLAS_CANCELLED));
  atlas_result result;
  ATLAS_RESULT_INIT(&result);
  EXPECT_EQ(atlas_get_result(scene.get(), 0, &result), ATLAS_INVALID_ARGUMENT);
  options.progress = nullptr;
  options.time_limit = 1e-9;
  EXPECT_EQ(atlas_generate(scene.get(), &options), ATLAS_OUT_OF_TIME);
  EXPECT_EQ(atlas_pack(scene_of({square()}).get(), &options), ATLAS_OUT_OF_TIME);
}

TEST(atlas_h, FaultsAreNumbersWithASentence)
{
  EXPECT_EQ(atlas_generate(nullptr, nullptr), ATLAS_INVALID_ARGUMENT);
  EXPECT_STRNE(atlas_error(nullptr), "");
  atlas_destroy(nullptr);
  const Scene scene = scene_of({});
  const auto expect_fault = [&](int status, const char* word) {
    EXPECT_EQ(status, ATLAS_INVALID_ARGUMENT) << word;
    EXPECT_NE(std::string(atlas_error(scene.get())).find(word), std::string::npos)
        << atlas_error(scene.get());
  };
  expect_fault(atlas_generate(scene.get(), nullptr), "no meshes");
  expect_fault(atlas_add_mesh(scene.get(), nullptr), "mesh");
  const Mesh arrays = box();
  atlas_mesh mesh = arrays.in_c();
  mesh.number_of_vertices = 5;
  expect_fault(atlas_add_mesh(scene.get(), &mesh),
               "vertex 5"); // the first that is not there
  mesh = arrays.in_c();
  mesh.position_type = 2;
  expect_fault(atlas_add_mesh(scene.get(), &mesh), "position_type");
  mesh = arrays.in_c();
  mesh.size = 4711;
  expect_fault(atlas_add_mesh(scene.get(), &mesh), "size");
  EXPECT_EQ(atlas_number_of_meshes(scene.get()), 0u);
  mesh = arrays.in_c();
  ASSERT_EQ(atlas_add_mesh(scene.get(), &mesh), ATLAS_OK);
  const auto with = [](auto member, auto value) {
    atlas_options options = defaults();
    options.*member = value;
    return options;
  };
  const std::array wrong = {with(&atlas_options::mode, 4),
                            with(&atlas_options::stack, -1),
                            with(&atlas_options::gutter, -1.0),
                            with(&atlas_options::width, 0u),
                            with(&atlas_options::max_distortion, 0.5),
                            with(&atlas_options::hard_angle, 200.0),
                            with(&atlas_options::min_coverage, 1.0),
                            with(&atlas_options::min_texels_per_chart, -1.0),
                            with(&atlas_options::symmetry, 5),
                            with(&atlas_options::hide_seams, 4),
                            with(&atlas_options::hide_seams, ATLAS_HIDE_DOME), // without an axis
                            with(&atlas_options::weld, 0.2),
                            with(&atlas_options::segmentation, "nobody"),
                            with(&atlas_options::packer, "Rows"),
                            with(&atlas_options::number_of_rules, std::size_t(1)),
                            with(&atlas_options::time_limit, -1.0)};
  const std::array words = {"mode",           "stack",      "gutter",       "width",
                            "max_distortion", "hard_angle", "min_coverage", "min_texels_per_chart",
                            "symmetry",       "hide_seams", "hide_seams",   "weld",
                            "'features'",     "'horizon'",  "rules",        "time_limit"};
  for (std::size_t i = 0; i < wrong.size(); ++i)
    expect_fault(atlas_generate(scene.get(), &wrong[i]), words[i]);
  atlas_result result;
  ATLAS_RESULT_INIT(&result);
  ASSERT_EQ(atlas_generate(scene.get(), nullptr), ATLAS_OK);
  expect_fault(atlas_get_result(scene.get(), 1, &result), "out of range");
}

TEST(atlas_h, OldProgramsKnowLess)
{
  const Scene scene = scene_of({box()});
  // A program from before `gutter`: what is behind is not read.
  atlas_options options = defaults();
  options.width = options.height = 128;
  options.size = offsetof(atlas_options, gutter);
  options.gutter = -1;
  EXPECT_EQ(atlas_generate(scene.get(), &options), ATLAS_OK) << atlas_error(scene.get());
  EXPECT_EQ(summary_of(scene).width, 128u);
  atlas_summary summary;
  std::memset(&summary, 0x5A, sizeof summary);
  ASSERT_EQ(atlas_init(&summary, offsetof(atlas_summary, width)), ATLAS_OK);
  const unsigned int before = summary.width;
  EXPECT_EQ(atlas_get_summary(scene.get(), &summary), ATLAS_OK);
  EXPECT_EQ(summary.number_of_pages, 1u);
  EXPECT_EQ(summary.width, before); // and what is behind is not written
}

TEST(atlas_h, NothingToMap)
{
  const Mesh flat = {{0, 0, 0, 1, 0, 0, 2, 0, 0}, {0, 1, 2}, {}, {}};
  const Scene scene = scene_of({flat});
  EXPECT_EQ(atlas_generate(scene.get(), nullptr), ATLAS_NO_SURFACE);
  EXPECT_STREQ(atlas_error(scene.get()), atlas_message(ATLAS_NO_SURFACE));
}
