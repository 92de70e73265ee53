// SPDX-License-Identifier: MIT
// What pages are asked for, through the whole pipeline: weights of faces, stacked copies, several meshes.
#include <Atlas/core/build_surface.h>
#include <Atlas/generate_atlas.h>
#include <Atlas/pack_charts.h>
#include <Atlas/packing/Horizon_packer.h>

#include <CGAL/Surface_mesh.h>

#include "test_meshes.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace Atlas::test {
namespace {

using Mesh = CGAL::Surface_mesh<Point_3>;

/// Adds a flat rectangle of n squares in a row, its lower left corner at a point.
std::vector<Mesh::Face_index> add_row(Mesh& mesh, int n, const Point_3& at)
{
  std::vector<Mesh::Vertex_index> v;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j < 2; ++j)
      v.push_back(mesh.add_vertex(at + Vector_3(i, j, 0)));
  std::vector<Mesh::Face_index> faces;
  for (int i = 0; i < n; ++i)
    faces.push_back(mesh.add_face(v[2 * i], v[2 * i + 2], v[2 * i + 3], v[2 * i + 1]));
  return faces;
}

/// The side of each face in texels: faces are squares of side 1.
struct Textured
{
  Atlas_report report;
  std::vector<double> sides;
};

template <typename NamedParameters>
Textured run(Mesh& mesh, const NamedParameters& np, double texels)
{
  const auto uv = mesh.add_property_map<Mesh::Halfedge_index, Point_2>("h:uv").first;
  Textured result;
  result.report = generate_atlas(mesh, uv, np);
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    result.sides.push_back(texels * std::sqrt(CGAL::squared_distance(uv[h], uv[mesh.next(h)])));
  }
  return result;
}

TEST(FaceWeights, AChartHasTheMeanWeightOfItsFaces)
{
  Mesh mesh;
  const auto a = add_row(mesh, 1, Point_3(0, 0, 0)), b = add_row(mesh, 2, Point_3(0, 0, 1)),
             c = add_row(mesh, 1, Point_3(0, 0, 2));
  const auto weight = mesh.add_property_map<Mesh::Face_index, double>("f:weight", 1).first;
  weight[b[0]] = 2;
  weight[b[1]] = 3;
  weight[c[0]] = 0.5;
  const Textured r = run(mesh, parameters::texture_size(256).face_weight_map(weight), 256);
  ASSERT_TRUE(r.report.is_valid());
  ASSERT_EQ(r.report.charts.size(), 3u);
  const double expected[] = {1, 2.5, 2.5, 0.5};
  for (int f = 0; f < 4; ++f)
    EXPECT_NEAR(r.sides[f], expected[f] * r.report.density, 1e-3) << f;
}

TEST(FaceWeights, PatchesKeepEachWeight)
{
  Mesh mesh;
  add_row(mesh, 4, Point_3(0, 0, 0));
  const auto weight = mesh.add_property_map<Mesh::Face_index, double>("f:weight", 1).first;
  const auto patch = mesh.add_property_map<Mesh::Face_index, int>("f:patch", 0).first;
  weight[Mesh::Face_index(0)] = 4;
  patch[Mesh::Face_index(0)] = 1;
  Page_options page;
  page.width = page.height = 256;
  page.density = 10;
  const Textured r =
      run(mesh, parameters::page_options(page).face_weight_map(weight).face_patch_map(patch), 256);
  ASSERT_TRUE(r.report.is_valid());
  EXPECT_EQ(r.report.charts.size(), 2u);
  EXPECT_NEAR(r.sides[0], 40, 1e-3);
  for (int f = 1; f < 4; ++f)
    EXPECT_NEAR(r.sides[f], 10, 1e-3);
}

TEST(FaceWeights, NoChartVanishes)
{
  Mesh mesh;
  add_row(mesh, 4, Point_3(0, 0, 0));
  const auto small = add_row(mesh, 1, Point_3(0, 0, 1));
  const auto weight = mesh.add_property_map<Mesh::Face_index, double>("f:weight", 1).first;
  weight[small[0]] = 1e-30;
  const Textured r = run(mesh, parameters::texture_size(64).face_weight_map(weight), 64);
  EXPECT_TRUE(r.report.is_valid());
  EXPECT_GT(r.sides[4], 0.25);
  EXPECT_LT(r.sides[4], 2);
}

TEST(FaceWeights, HoldForChartsThatExist)
{
  Mesh mesh;
  add_row(mesh, 2, Point_3(0, 0, 0));
  const auto other = add_row(mesh, 1, Point_3(0, 0, 1));
  const auto uv = mesh.add_property_map<Mesh::Halfedge_index, Point_2>("h:uv").first;
  for (const auto h : mesh.halfedges())
    uv[h] = Point_2(mesh.point(mesh.target(h)).x(), mesh.point(mesh.target(h)).y());
  const auto weight = mesh.add_property_map<Mesh::Face_index, double>("f:weight", 2).first;
  weight[other[0]] = 6;
  const Packing packing =
      pack_charts(mesh, uv, parameters::texture_size(128).packer(Horizon_packer()).face_weight_map(weight));
  ASSERT_EQ(packing.number_of_pages, 1u);
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const double side = 128 * std::sqrt(CGAL::squared_distance(uv[h], uv[mesh.next(h)]));
    EXPECT_NEAR(side, weight[f] * packing.density, 1e-6 * side);
  }
}

/// A right triangle with sides 2 and 1, or its mirror image, in some place.
Soup triangle(double x, bool is_mirrored, double side = 2)
{
  Soup soup;
  soup.points = {Point_3(x, 0, 0), Point_3(x + side, 0, 0), Point_3(x, 1, 0)};
  if (is_mirrored)
    soup.points = {Point_3(x, 0, 0), Point_3(x + 1, 0, 0), Point_3(x, side, 0)};
  soup.polygons = {{0, 1, 2}};
  return soup;
}

TEST(StackedCharts, CopiesShareAPlaceAndTheAtlasIsProvedValid)
{
  const std::vector<Surface> parts = {surface_of(triangle(0, false)), surface_of(triangle(5, true)),
                                      surface_of(triangle(9, false)), surface_of(triangle(12, true)),
                                      surface_of(triangle(15, false, 3))};
  const Surface surface = join_surfaces(parts);
  for (const auto stacking :
       {Chart_stacking::none, Chart_stacking::copies, Chart_stacking::copies_and_mirrored}) {
    Page_options page;
    page.width = page.height = 256;
    page.stacking = stacking;
    std::vector<Point_2> uv;
    const Atlas_report report = generate_atlas(surface, uv, parameters::page_options(page));
    EXPECT_TRUE(report.is_valid()) << message(report.certificate);
    EXPECT_EQ(report.pages, 1u);
    EXPECT_EQ(report.certificate.pages, 1u);
    EXPECT_EQ(report.split_charts, 0u);
    const std::size_t stacked = stacking == Chart_stacking::none     ? 0
                                : stacking == Chart_stacking::copies ? 2
                                                                     : 3;
    EXPECT_EQ(report.stacked_charts, stacked);
    // Which triangles have the same right angle, up to rounding.
    const auto is_at_one_place = [&](int i, int j) {
      return CGAL::squared_distance(uv[3 * i], uv[3 * j]) < 1e-12;
    };
    EXPECT_EQ(is_at_one_place(0, 2), stacked > 0);
    EXPECT_EQ(is_at_one_place(1, 3), stacked > 0);
    EXPECT_EQ(is_at_one_place(0, 1), stacked == 3);
    EXPECT_FALSE(is_at_one_place(0, 4));
    double area = 0;
    for (const int i : {0, 1, 2, 3, 4})
      if (i == 0 || i == 4 || stacked == 0 || (i == 1 && stacked == 2))
        area += std::abs(CGAL::area(uv[3 * i], uv[3 * i + 1], uv[3 * i + 2]));
    EXPECT_NEAR(report.packing_efficiency, area, 1e-6);
  }
}

TEST(JoinedSurfaces, ShareADensityAndNoChart)
{
  // Two halves of a sheet that would be one if they were glued, and a mesh with a face that is none.
  Soup left = planar_grid(2, 2), right = left, broken = cube();
  for (Point_3& p : right.points)
    p = p + Vector_3(1, 0, 0);
  broken.polygons.insert(broken.polygons.begin(), {0, 1});
  std::vector<Surface> parts = {surface_of(left), surface_of(right), surface_of(broken)};
  parts[2].density_weight.assign(parts[2].number_of_triangles(), 2);
  const Surface surface = join_surfaces(parts);
  std::size_t triangles = 0, corners = 0;
  for (const Surface& part : parts) {
    for (Index t = 0; t < part.number_of_triangles(); ++t)
      for (Index i = 0; i < 3; ++i) {
        const Index h = static_cast<Index>(3 * triangles) + 3 * t + i;
        EXPECT_EQ(surface.point(h), part.point(3 * t + i));
        EXPECT_EQ(surface.corner[h], part.corner[3 * t + i] + corners);
        const Index o = part.opposite[3 * t + i];
        EXPECT_EQ(surface.opposite[h], o == no_index ? o : o + 3 * triangles);
      }
    triangles += part.number_of_triangles();
    corners += part.number_of_corners;
  }
  EXPECT_EQ(surface.number_of_triangles(), triangles);
  EXPECT_EQ(surface.number_of_corners, corners);
  ASSERT_EQ(surface.rejected.size(), 1u);
  EXPECT_EQ(surface.rejected[0].face, parts[0].number_of_faces + parts[1].number_of_faces);

  std::vector<Point_2> uv;
  const Atlas_report report = generate_atlas(surface, uv, parameters::texture_size(256));
  ASSERT_TRUE(report.is_valid());
  std::array<std::set<Index>, 3> charts;
  for (Index t = 0; t < surface.number_of_triangles(); ++t) {
    const Index f = surface.face[t];
    const int part = f < parts[0].number_of_faces ? 0 : f < 2 * parts[0].number_of_faces ? 1 : 2;
    charts[part].insert(report.face_chart[f]);
    const double in_plane = std::sqrt(
                     CGAL::squared_distance(uv[surface.corner[3 * t]], uv[surface.corner[3 * t + 1]])),
                 in_space = std::sqrt(CGAL::squared_distance(surface.point(3 * t), surface.point(3 * t + 1)));
    EXPECT_NEAR(256 * in_plane / in_space, (part == 2 ? 2 : 1) * report.density, 0.02 * report.density);
  }
  EXPECT_EQ(charts[0].size() + charts[1].size(), 2u);
  std::set<Index> all;
  for (const auto& numbers : charts)
    all.insert(numbers.begin(), numbers.end());
  EXPECT_EQ(all.size(), charts[0].size() + charts[1].size() + charts[2].size());
}

TEST(JoinedSurfaces, ListsThatOnePartHasAreFilledForTheOthers)
{
  std::vector<Surface> parts(3, surface_of(cube()));
  parts[0].patch.assign(12, 3);
  parts[1].constraint.assign(36, Edge_constraint::seam);
  parts[2].seam_cost.assign(36, 5);
  const Surface surface = join_surfaces(parts);
  ASSERT_EQ(surface.patch.size(), 36u);
  EXPECT_EQ(std::set<Index>(surface.patch.begin(), surface.patch.end()).size(), 3u);
  ASSERT_EQ(surface.constraint.size(), 108u);
  ASSERT_EQ(surface.seam_cost.size(), 108u);
  for (std::size_t h = 0; h < 108; ++h) {
    EXPECT_EQ(surface.constraint[h] == Edge_constraint::seam, h / 36 == 1);
    EXPECT_EQ(surface.seam_cost[h], h / 36 == 2 ? 5 : 1);
  }
  EXPECT_TRUE(surface.density_weight.empty());
  EXPECT_EQ(join_surfaces(std::span<const Surface>()).number_of_triangles(), 0u);
}

} // namespace
} // namespace Atlas::test
