// SPDX-License-Identifier: MIT
// The whole pipeline, on both of CGAL's meshes.
#include <Atlas/core/build_surface.h>
#include <Atlas/generate_atlas.h>
#include <Atlas/packing/Horizon_packer.h>
#include <Atlas/parameterization/Existing_uv_parameterizer.h>
#include <Atlas/pipeline/internal/round_coordinates.h>
#include <Atlas/pipeline/internal/separate_cut_sides.h>
#include <Atlas/segmentation/Patch_segmentation.h>
#include <Atlas/segmentation/cut_to_discs.h>
#include <Atlas/validation/Exact_validator.h>
#include <Atlas/validation/certify.h>
#include <Atlas/verify_atlas.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_items_with_id_3.h>
#include <CGAL/boost/graph/graph_traits_Polyhedron_3.h>

#include "cgal_meshes.h"
#include "segmentation_shapes.h"
#include <array>
#include <cmath>
#include <map>

namespace Atlas::test {
namespace {

using Polyhedron = CGAL::Polyhedron_3<Kernel>;

template <typename Mesh>
class GenerateAtlas : public testing::Test
{};
using Meshes = testing::Types<Surface_mesh, Polyhedron>;
TYPED_TEST_SUITE(GenerateAtlas, Meshes);

template <typename Mesh>
struct Result
{
  using Halfedge = typename boost::graph_traits<Mesh>::halfedge_descriptor;
  using Face = typename boost::graph_traits<Mesh>::face_descriptor;
  using Edge = typename boost::graph_traits<Mesh>::edge_descriptor;
  std::map<Halfedge, Point_2> uv;
  std::map<Face, int> chart;
  std::map<Edge, bool> seam;
  Atlas_report report;
};

template <typename Mesh>
Result<Mesh> atlas_of(const Mesh& mesh)
{
  Result<Mesh> r;
  r.report = generate_atlas(mesh, boost::make_assoc_property_map(r.uv),
                            parameters::texture_size(256)
                                .gutter(2)
                                .face_chart_map(boost::make_assoc_property_map(r.chart))
                                .edge_seam_map(boost::make_assoc_property_map(r.seam)));
  return r;
}

/// What every atlas has to be, checked on the user's mesh with nothing of the library.
template <typename Mesh>
void expect_complete(const Mesh& mesh, const Result<Mesh>& r)
{
  EXPECT_TRUE(r.report.is_valid()) << message(r.report.status);
  for (const auto f : faces(mesh)) {
    std::vector<Point_2> corners;
    for (const auto h : CGAL::halfedges_around_face(halfedge(f, mesh), mesh)) {
      ASSERT_TRUE(r.uv.contains(h));
      const Point_2 p = r.uv.at(h);
      EXPECT_TRUE(p.x() >= 0 && p.x() <= 1 && p.y() >= 0 && p.y() <= 1);
      EXPECT_EQ(p.x(), double(float(p.x())));
      EXPECT_EQ(p.y(), double(float(p.y())));
      corners.push_back(p);
    }
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      EXPECT_EQ(CGAL::orientation(corners[0], corners[i], corners[i + 1]), CGAL::LEFT_TURN);
    EXPECT_GE(r.chart.at(f), 0);
    EXPECT_LT(r.chart.at(f), int(r.report.charts.size()));
  }
  for (const auto e : edges(mesh)) {
    const auto h = halfedge(e, mesh), o = opposite(h, mesh);
    if (is_border(e, mesh)) {
      EXPECT_FALSE(r.seam.at(e));
      continue;
    }
    const bool same = r.uv.at(h) == r.uv.at(prev(o, mesh)) && r.uv.at(o) == r.uv.at(prev(h, mesh));
    EXPECT_EQ(r.seam.at(e), !same);
  }
}

Soup wavy_sheet(bool quads)
{
  return grid(
      12, 9, [](double x, double y) { return Point_3(x, y, 0.2 * std::sin(7 * x) * std::cos(5 * y)); }, false,
      false, quads);
}

TYPED_TEST(GenerateAtlas, MapsClosedOpenAndPolygonMeshes)
{
  Soup two = sphere(3);
  for (const auto& p : torus(20, 12).points)
    two.points.push_back(p + Vector_3(5, 0, 0));
  for (auto polygon : torus(20, 12).polygons) {
    for (Index& v : polygon)
      v += static_cast<Index>(sphere(3).points.size());
    two.polygons.push_back(polygon);
  }
  for (const Soup& soup : {wavy_sheet(false), wavy_sheet(true), cube(), sphere(3), torus(24, 16), two}) {
    const TypeParam mesh = mesh_of<TypeParam>(soup);
    expect_complete(mesh, atlas_of(mesh));
  }
}

TYPED_TEST(GenerateAtlas, CertificateHoldsOnTheUsersMeshAndFailsOnADamagedOne)
{
  const TypeParam mesh = mesh_of<TypeParam>(sphere(3));
  Result<TypeParam> r = atlas_of(mesh);
  const auto certificate = [&] {
    return verify_atlas(mesh, boost::make_assoc_property_map(r.uv), parameters::texture_size(256).gutter(2));
  };
  EXPECT_TRUE(certificate().is_valid()) << message(certificate());
  EXPECT_EQ(certificate().charts, r.report.charts.size());
  EXPECT_NEAR(certificate().seam_length, r.report.seam_length, 1e-9);
  const auto h = halfedge(*faces(mesh).begin(), mesh);
  std::swap(r.uv.at(h), r.uv.at(next(h, mesh)));
  EXPECT_FALSE(certificate().is_valid());
}

TYPED_TEST(GenerateAtlas, DevelopableSheetIsMappedWithoutDistortion)
{
  const TypeParam mesh = mesh_of<TypeParam>(
      grid(20, 10, [](double x, double y) { return Point_3(std::cos(2 * x), std::sin(2 * x), y); }));
  const Result<TypeParam> r = atlas_of(mesh);
  EXPECT_EQ(r.report.charts.size(), 1u);
  EXPECT_EQ(r.report.seam_length, 0);
  EXPECT_NEAR(r.report.distortion.symmetric_dirichlet_mean, 1, 1e-5);
  EXPECT_NEAR(r.report.distortion.l2_stretch, 1, 1e-5);
  EXPECT_NEAR(r.report.area, 2 * 40 * std::sin(0.05) / 2, 1e-9);
}

TYPED_TEST(GenerateAtlas, HonoursSeamsAndPatches)
{
  const TypeParam mesh =
      mesh_of<TypeParam>(grid(10, 10, [](double x, double y) { return Point_3(x, y, 0); }));
  using Edge = typename boost::graph_traits<TypeParam>::edge_descriptor;
  using Face = typename boost::graph_traits<TypeParam>::face_descriptor;
  std::map<Edge, bool> wanted;
  std::map<Face, int> patch;
  const auto points = get(CGAL::vertex_point, mesh);
  for (const auto e : edges(mesh))
    wanted[e] = get(points, source(e, mesh)).y() == 0.5 && get(points, target(e, mesh)).y() == 0.5;
  for (const auto f : faces(mesh))
    patch[f] =
        get(points, target(halfedge(f, mesh), mesh)).x() + get(points, source(halfedge(f, mesh), mesh)).x() >
        1;
  Result<TypeParam> r;
  r.report = generate_atlas(mesh, boost::make_assoc_property_map(r.uv),
                            parameters::face_chart_map(boost::make_assoc_property_map(r.chart))
                                .edge_seam_map(boost::make_assoc_property_map(r.seam))
                                .edge_is_constrained_map(boost::make_assoc_property_map(wanted))
                                .face_patch_map(boost::make_assoc_property_map(patch)));
  expect_complete(mesh, r);
  for (const auto& [e, is_seam] : wanted)
    EXPECT_TRUE(!is_seam || r.seam.at(e));
  std::map<int, int> patch_of_chart;
  for (const auto f : faces(mesh))
    EXPECT_EQ(patch_of_chart.try_emplace(r.chart.at(f), patch.at(f)).first->second, patch.at(f));
}

TYPED_TEST(GenerateAtlas, KeepsSeamsAwayFromForbiddenAndDearEdges)
{
  const TypeParam mesh = mesh_of<TypeParam>(sphere(3));
  using Edge = typename boost::graph_traits<TypeParam>::edge_descriptor;
  using Vertex = typename boost::graph_traits<TypeParam>::vertex_descriptor;
  const auto points = get(CGAL::vertex_point, mesh);
  const auto is_in_cap = [&](Vertex v) { return get(points, v).z() > 0.3; };
  std::map<Edge, bool> forbidden;
  std::map<Vertex, double> cost;
  for (const auto e : edges(mesh))
    forbidden[e] = is_in_cap(source(e, mesh)) && is_in_cap(target(e, mesh));
  for (const auto v : vertices(mesh))
    cost[v] = is_in_cap(v) ? 50 : 1;
  const auto seam_length_in_cap = [&](const auto& np) {
    Result<TypeParam> r;
    r.report = generate_atlas(mesh, boost::make_assoc_property_map(r.uv),
                              np.face_chart_map(boost::make_assoc_property_map(r.chart))
                                  .edge_seam_map(boost::make_assoc_property_map(r.seam)));
    expect_complete(mesh, r);
    double length = 0;
    for (const auto& [e, is_seam] : r.seam)
      if (is_seam && forbidden.at(e))
        length +=
            std::sqrt(CGAL::squared_distance(get(points, source(e, mesh)), get(points, target(e, mesh))));
    return length;
  };
  const double usual = seam_length_in_cap(parameters::texture_size(256));
  EXPECT_GT(usual, 0.5);
  EXPECT_LT(
      seam_length_in_cap(parameters::texture_size(256).seam_cost_map(boost::make_assoc_property_map(cost))),
      0.7 * usual);
  EXPECT_EQ(seam_length_in_cap(
                parameters::texture_size(256).forbidden_seam_map(boost::make_assoc_property_map(forbidden))),
            0);
}

TYPED_TEST(GenerateAtlas, HardEdgesBecomeSeams)
{
  const TypeParam mesh = mesh_of<TypeParam>(cube());
  const auto charts = [&](double degrees) {
    Result<TypeParam> r;
    r.report = generate_atlas(mesh, boost::make_assoc_property_map(r.uv), parameters::hard_angle(degrees));
    EXPECT_TRUE(r.report.is_valid());
    return r.report.charts.size();
  };
  EXPECT_EQ(charts(89), 6u);
  EXPECT_LT(charts(91), 6u);
}

TEST(GenerateAtlasOnSurface, ModesTradeSeamsForDistortionAndTellTheirBound)
{
  const Surface surface = surface_of(torus(60, 40));
  const auto atlas = [&](Atlas_mode mode) {
    std::vector<Point_2> uv;
    Atlas_report report = generate_atlas(surface, uv, parameters::mode(mode));
    EXPECT_TRUE(report.is_valid()) << name(mode);
    for (const Chart_report& chart : report.charts)
      EXPECT_EQ(chart.is_within_bound, value(chart.distortion, report.bound.measure) <= report.bound.max);
    return report;
  };
  const Atlas_report standard = atlas(Atlas_mode::standard), few = atlas(Atlas_mode::few_seams),
                     conformal = atlas(Atlas_mode::conformal);
  EXPECT_LE(few.seam_length, standard.seam_length);
  EXPECT_LE(few.charts.size(), standard.charts.size());
  EXPECT_LT(conformal.distortion.quasi_conformal_mean, 0.3 + 0.7 * standard.distortion.quasi_conformal_mean);
  EXPECT_EQ(standard.bound.measure, Distortion_measure::symmetric_dirichlet);
  EXPECT_EQ(standard.bound.max, Merge_options().max_distortion);
  EXPECT_EQ(conformal.bound.measure, Distortion_measure::area_ratio_quantiles);
  EXPECT_EQ(conformal.bound.max, 2);
  EXPECT_EQ(conformal.charts_beyond_bound, 0u) << "it is validated, not only hoped for";
  for (const Chart_report& chart : conformal.charts) {
    // Only what least squares conformal maps do not map one-to-one is repaired.
    EXPECT_EQ(chart.flattening.is_optimized, chart.flattening.flips > 0 || chart.flattening.was_overlapping);
    EXPECT_EQ(chart.status, Chart_status::valid);
  }
  for (const Chart_report& chart : standard.charts)
    EXPECT_TRUE(chart.flattening.is_optimized);
}

/// With their positions multiplied, and then moved along each axis.
Soup changed(Soup soup, double factor, double shift)
{
  for (Point_3& p : soup.points)
    p = Point_3(factor * p.x() + shift, factor * p.y() + shift, factor * p.z() + shift);
  return soup;
}

TEST(GenerateAtlasOnSurface, TheAtlasDoesNotDependOnTheScaleAndThePlaceOfTheModel)
{
  // Symmetric shapes, where much is equal but for rounding, and a ribbon that is cut for its page. That hangs
  // on trial packings, and these on the last digits of all coordinates.
  const Soup ribbon = grid(
      60, 2,
      [](double x, double y) {
        return Point_3((1 + 0.1 * y) * std::cos(5 * x), (1 + 0.1 * y) * std::sin(5 * x), x + 0.02 * y * y);
      },
      false, false, false);
  std::size_t pieces = 0;
  for (const Soup& soup : {sphere(4), torus(60, 40), cube(), ribbon}) {
    std::vector<Point_2> uv, other_uv;
    const Atlas_report one = generate_atlas(surface_of(soup), uv);
    pieces += one.pieces_cut_for_pages;
    const auto check = [&](double factor, double shift) {
      const Atlas_report other = generate_atlas(surface_of(changed(soup, factor, shift)), other_uv);
      EXPECT_EQ(one.face_chart, other.face_chart) << factor << " " << shift;
      EXPECT_EQ(uv, other_uv) << factor << " " << shift;
      EXPECT_NEAR(other.seam_length / factor, one.seam_length, 1e-9 * one.seam_length) << factor;
      EXPECT_NEAR(other.density * factor, one.density, 1e-9 * one.density) << factor;
      EXPECT_NEAR(other.certificate.density_min * factor, one.certificate.density_min, 1e-9 * one.density);
    };
    for (const double factor : {1e-6, 1e-3, 1 / 3.0, 0.7, 3.0, 1e3, 1e6})
      check(factor, 0);
    check(1, 2.1);
  }
  EXPECT_GT(pieces, 0u);
}

TEST(GenerateAtlasOnSurface, SmallPartsOfALargeModelKeepTheirShape)
{
  // Beside a twin so far away that both are specks, and beside a very large sheet: positions are rounded by
  // the size of the parts, not by that of the model.
  const Soup small = sphere(3);
  std::vector<Point_2> uv;
  const Atlas_report alone = generate_atlas(surface_of(small), uv);
  const Soup sheet = grid(
      4, 4, [](double x, double y) { return Point_3(1e8 * x, 1e8 * y, 0); }, false, false, false);
  for (const Soup& other : {changed(small, 1, 1e9), sheet}) {
    Soup both = other;
    append(both, small);
    const Atlas_report report = generate_atlas(surface_of(both), uv);
    EXPECT_TRUE(report.is_valid());
    for (const Chart_report& chart : report.charts)
      EXPECT_LT(chart.distortion.stretch_p99, alone.distortion.stretch_p99 + 0.1);
  }
}

TEST(GenerateAtlasOnSurface, OneChartOfASphereIsNotSplitForItsDistortion)
{
  const Surface surface = surface_of(sphere(4));
  std::vector<Point_2> uv;
  EXPECT_GT(generate_atlas(surface, uv).charts.size(), 1u);
  // With a loose bound on single places, and flattened for the mean alone: the mode evens them out.
  Merge_options loose;
  loose.max_stretch = 2.5;
  const Atlas_report one = generate_atlas(
      surface, uv, parameters::merge_options(loose).max_charts(1).parameterizer(Bijective_parameterizer()));
  ASSERT_EQ(one.charts.size(), 1u);
  EXPECT_TRUE(one.is_valid());
  EXPECT_GT(one.charts[0].distortion.area_p99 / one.charts[0].distortion.area_p1, default_density_ratio)
      << "the safety net would have caught it";
  EXPECT_FALSE(one.charts[0].is_within_bound);
}

TEST(GenerateAtlasOnSurface, ChartsAreFewAndLargeOnRequest)
{
  const Surface surface = surface_of(torus(60, 40));
  std::vector<Point_2> uv;
  const std::size_t usual = generate_atlas(surface, uv).charts.size();
  ASSERT_GT(usual, 1u);
  Merge_options tight;
  tight.max_distortion = 1.01;
  const Atlas_report many = generate_atlas(surface, uv, parameters::merge_options(tight));
  EXPECT_GT(many.charts.size(), usual);
  EXPECT_EQ(many.bound.max, 1.01);
  const Atlas_report few = generate_atlas(surface, uv, parameters::merge_options(tight).max_charts(usual));
  EXPECT_TRUE(few.is_valid());
  EXPECT_LE(few.charts.size(), usual);
  EXPECT_GT(few.charts_beyond_bound, 0u);
  const double least = 0.4 * default_texture_size * default_texture_size;
  const Atlas_report large = generate_atlas(surface, uv, parameters::min_chart_texels(least));
  EXPECT_TRUE(large.is_valid());
  EXPECT_LT(large.charts.size(), usual);
}

TEST(GivenParameterizer, KeepsShapesOfChartsThatAreOneToOneAndMendsTheOthers)
{
  // Two strips: the first lies well, the second folds back on itself in the plane.
  Soup soup = grid(8, 4, [](double x, double y) { return Point_3(4 * x, 2 * y, 0); });
  const std::size_t half = soup.polygons.size(), n = soup.points.size();
  const Soup other = grid(8, 4, [](double x, double y) { return Point_3(4 * x, 2 * y + 5, 0.3 * x * x); });
  soup.points.insert(soup.points.end(), other.points.begin(), other.points.end());
  for (auto polygon : other.polygons) {
    for (Index& v : polygon)
      v += static_cast<Index>(n);
    soup.polygons.push_back(polygon);
  }
  Surface surface = surface_of(soup);
  std::vector<Point_2> old(surface.number_of_corners);
  for (Index h = 0; h < surface.opposite.size(); ++h) {
    const Point_3& p = surface.point(h);
    const double x = p.y() < 4 || p.x() < 2 ? p.x() : 4 - p.x();
    old[surface.corner[h]] = Point_2(x + 0.5 * p.y(), p.y()); // sheared, which no flattening here would do
  }
  constrain_to_uv(surface, old);
  std::vector<Point_2> uv;
  const Atlas_report report = generate_atlas(surface, uv,
                                             parameters::segmentation(Patch_segmentation())
                                                 .parameterizer(Existing_uv_parameterizer(surface, old))
                                                 .validator(Exact_validator(1e9, 0)));
  EXPECT_TRUE(report.is_valid());
  EXPECT_EQ(report.charts.size(), 3u);
  for (Index t = 0; t < half; ++t) { // squared lengths keep their ratios
    const auto lengths = [&](const std::vector<Point_2>& at) {
      const auto p = [&](Index i) { return at[surface.corner[3 * t + i]]; };
      return CGAL::squared_distance(p(0), p(1)) / CGAL::squared_distance(p(1), p(2));
    };
    EXPECT_NEAR(lengths(uv) / lengths(old), 1, 1e-3);
  }
}

TEST(GenerateAtlasOnSurface, SameBytesForAnyNumberOfThreadsAndAnyPowerOfTwoScale)
{
  const Surface surface = surface_of(torus(40, 24));
  std::vector<Point_2> reference;
  ASSERT_TRUE(generate_atlas(surface, reference, parameters::number_of_threads(1)).is_valid());
  for (unsigned threads : {2u, 4u}) {
    std::vector<Point_2> uv;
    ASSERT_TRUE(generate_atlas(surface, uv, parameters::number_of_threads(threads)).is_valid());
    EXPECT_EQ(uv, reference);
  }
  for (int exponent : {-300, -20, 20, 300}) {
    Surface scaled = surface;
    for (Point_3& p : scaled.points)
      p = Point_3(std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent));
    std::vector<Point_2> uv;
    ASSERT_TRUE(generate_atlas(scaled, uv).is_valid());
    EXPECT_EQ(uv, reference);
  }
}

TEST(GenerateAtlasOnSurface, FillsAsManyPagesAsADensityTakes)
{
  for (const double scale : {1.0, 3.0, 1e-3}) {
    Surface surface = surface_of(sphere(3));
    for (Point_3& p : surface.points)
      p = Point_3(scale * p.x(), scale * p.y(), scale * p.z());
    Page_options page;
    page.width = page.height = 256;
    page.density = 70 / scale;
    Merge_options small; // charts must fit a page
    small.max_distortion = 1.003;
    std::vector<Point_2> uv;
    const Atlas_report report =
        generate_atlas(surface, uv, parameters::page_options(page).merge_options(small));
    EXPECT_TRUE(report.is_valid());
    EXPECT_NEAR(report.density * scale, 70, 1e-9);
    EXPECT_GE(report.pages, 2u);
    // The texels that charts cover are those of the sphere.
    EXPECT_NEAR(report.packing_efficiency * 256 * 256 * double(report.pages),
                report.area / scale / scale * 70 * 70, 1e-2 * 256 * 256);
    for (const Index p : report.face_page)
      EXPECT_LT(p, report.pages);
  }
}

TEST(GenerateAtlasOnSurface, ReportsProgressAndStopsWhenAsked)
{
  const Surface surface = surface_of(sphere(4));
  std::vector<Point_2> uv;
  std::vector<Stage> stages;
  const Atlas_report whole =
      generate_atlas(surface, uv, parameters::progress([&](Stage stage, double fraction) {
                       EXPECT_GE(fraction, 0);
                       EXPECT_LE(fraction, 1);
                       if (stages.empty() || stages.back() != stage)
                         stages.push_back(stage);
                       return true;
                     }));
  EXPECT_TRUE(whole.is_valid());
  EXPECT_EQ(stages, std::vector<Stage>(std::begin(all_stages), std::end(all_stages)));
  for (const Stage last : all_stages) {
    std::vector<Point_2> untouched;
    const Atlas_report report = generate_atlas(
        surface, untouched, parameters::progress([&](Stage stage, double) { return stage != last; }));
    EXPECT_EQ(report.status, Atlas_status::cancelled);
    EXPECT_TRUE(untouched.empty());
  }
}

TEST(SlitOpener, FlatRingIsADiscForWhoeverReadsTheCoordinates)
{
  const Surface ring = surface_of(grid(
      24, 3,
      [](double x, double y) {
        const double r = 1 + y, a = -2 * M_PI * x;
        return Point_3(r * std::cos(a), r * std::sin(a), 0);
      },
      true));
  Segmentation segmentation = one_chart(ring);
  cut_to_discs(ring, segmentation, Execution());
  Chart chart = extract_charts(ring, segmentation).at(0);
  for (const Point_3& p : chart.points)
    chart.uv.emplace_back(0.5 + p.x() / 8, 0.5 + p.y() / 8);
  EXPECT_TRUE(internal::Grid_rounding(chart)().empty());

  const auto certificate = [&] {
    std::vector<Point_2> corner_uv(ring.number_of_corners);
    for (Index t = 0; t < chart.triangles.size(); ++t)
      for (Index i = 0; i < 3; ++i)
        corner_uv[ring.corner[3 * chart.source[t] + i]] = chart.uv[chart.triangles[t][i]];
    return certify(ring, corner_uv, {}, Certificate_options(), Execution());
  };
  EXPECT_TRUE(certificate().is_valid());
  EXPECT_EQ(certificate().non_disc_charts, 1u);
  const std::vector<Point_2> before = chart.uv;
  internal::Cut_side_separator(ring, segmentation, chart)();
  EXPECT_TRUE(certificate().is_valid());
  EXPECT_EQ(certificate().charts, 1u);
  EXPECT_EQ(certificate().non_disc_charts, 0u);
  for (std::size_t v = 0; v < before.size(); ++v)
    EXPECT_LT(CGAL::squared_distance(before[v], chart.uv[v]), 1e-11);
}

TEST(GenerateAtlasOnSurface, ListsFacesThatCannotBeMapped)
{
  Soup soup = planar_grid(4, 4);
  soup.polygons.insert(soup.polygons.begin() + 3, {0, 1, 1});
  std::vector<Point_2> uv;
  const Atlas_report report = generate_atlas(surface_of(soup), uv);
  EXPECT_TRUE(report.is_valid());
  ASSERT_EQ(report.rejected.size(), 1u);
  EXPECT_EQ(report.rejected[0].face, 3u);
  EXPECT_EQ(report.face_chart[3], no_index);
  EXPECT_EQ(uv.size(), 99u);
}

TEST(GenerateAtlasOnSurface, NoSurfaceIsNoCrash)
{
  for (const Soup& soup : {Soup(), Soup{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}}) {
    std::vector<Point_2> uv;
    EXPECT_EQ(generate_atlas(surface_of(soup), uv).status, Atlas_status::no_surface);
    EXPECT_TRUE(uv.empty());
  }
}

/// Faces of up to eight corners among points of a small grid, some of them bent off it. Found by fuzzing.
TEST(GenerateAtlas, AFaceThatRoundingFoldsIsDrawnOnAGrid)
{
  const std::vector<std::array<int, 4>> grid{
      {1, 3, 2, -1}, {3, 1, 2, -1}, {2, 3, 2, -1}, {2, 0, 1, -1}, {0, 1, 3, 4},  {1, 3, 3, -1}, {1, 3, 3, -1},
      {1, 3, 3, -1}, {1, 3, 3, -1}, {1, 3, 3, -1}, {1, 3, 3, -1}, {1, 3, 3, -1}, {1, 3, 3, -1}, {1, 3, 3, -1},
      {1, 3, 3, -1}, {1, 3, 3, -1}, {1, 3, 3, -1}, {1, 3, 3, -1}, {1, 3, 3, -1}, {1, 3, 3, -1}, {1, 3, 3, -1},
      {1, 3, 3, -1}, {1, 3, 3, -1}, {1, 3, 3, -1}, {1, 3, 3, -1}, {1, 3, 3, -1}, {1, 3, 3, -1}, {0, 3, 3, -1},
      {2, 1, 1, -1}, {3, 2, 3, -1}, {3, 0, 1, -1}};
  Soup soup;
  for (const auto& [x, y, z, number] : grid) {
    const double bend = number < 0 ? 0 : std::sin(double(number));
    soup.points.emplace_back(0.1 * (x + bend), 0.1 * (y - bend), 0.1 * (z + bend * bend));
  }
  soup.polygons = {{12, 6, 23}, {11, 23, 7, 6},
                   {3, 14, 14}, {17, 0, 29},
                   {25, 22, 0}, {30, 31, 31},
                   {},          {0, 0, 22},
                   {30, 6, 16}, {2, 26, 20},
                   {},          {5, 11, 23, 7, 6, 24, 3, 14},
                   {23, 17, 0}, {22, 21, 5, 30, 31, 0},
                   {6, 16}};
  std::vector<Point_2> uv;
  const Atlas_report report =
      generate_atlas(surface_of(soup), uv, parameters::texture_size(32).gutter(1).packer(Horizon_packer()));
  EXPECT_TRUE(report.is_valid()) << message(report.certificate);
}

} // namespace
} // namespace Atlas::test
