// SPDX-License-Identifier: MIT
// The whole pipeline, on both of CGAL's meshes.
#include <Atlas/generate_atlas.h>
#include <Atlas/verify_atlas.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_items_with_id_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/graph_traits_Polyhedron_3.h>
#include <CGAL/boost/graph/graph_traits_Surface_mesh.h>

#include "test_meshes.h"
#include <map>

namespace Atlas::test {
namespace {

using Surface_mesh = CGAL::Surface_mesh<Point_3>;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;

Surface_mesh surface_mesh_of(const Soup& soup)
{
  Surface_mesh mesh;
  std::vector<Surface_mesh::Vertex_index> v;
  for (const Point_3& p : soup.points)
    v.push_back(mesh.add_vertex(p));
  for (const auto& polygon : soup.polygons) {
    std::vector<Surface_mesh::Vertex_index> corners;
    for (const Index i : polygon)
      corners.push_back(v[i]);
    EXPECT_NE(mesh.add_face(corners), Surface_mesh::null_face());
  }
  return mesh;
}

template <typename Mesh>
Mesh mesh_of(const Soup& soup)
{
  Mesh mesh;
  CGAL::copy_face_graph(surface_mesh_of(soup), mesh);
  return mesh;
}

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
  internal::Slit_opener(ring, segmentation, chart)();
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

TEST(GenerateAtlasOnSurface, WrongParametersViolatePreconditions)
{
  const Surface surface = surface_of(cube());
  std::vector<Point_2> uv;
  const auto before = CGAL::set_error_behaviour(CGAL::THROW_EXCEPTION);
  EXPECT_THROW((void)generate_atlas(surface, uv, parameters::gutter(-1)), CGAL::Precondition_exception);
  EXPECT_THROW((void)generate_atlas(surface, uv, parameters::texture_size(0)), CGAL::Precondition_exception);
  CGAL::set_error_behaviour(before);
}

} // namespace
} // namespace Atlas::test
