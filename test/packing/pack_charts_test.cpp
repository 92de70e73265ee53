// SPDX-License-Identifier: MIT
// Repacking the coordinates of meshes, on both of CGAL's.
#include <Atlas/pack_charts.h>
#include <Atlas/packing/Horizon_packer.h>
#include <Atlas/verify_atlas.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_items_with_id_3.h>
#include <CGAL/boost/graph/graph_traits_Polyhedron_3.h>

#include "cgal_meshes.h"
#include <map>

namespace Atlas::test {
namespace {

using Polyhedron = CGAL::Polyhedron_3<Kernel>;

template <typename Mesh>
class Pack_charts_of_mesh : public testing::Test
{};
using Meshes = testing::Types<Surface_mesh, Polyhedron>;
TYPED_TEST_SUITE(Pack_charts_of_mesh, Meshes);

TYPED_TEST(Pack_charts_of_mesh, repacks_the_coordinates_of_halfedges)
{
  using Traits = boost::graph_traits<TypeParam>;
  const TypeParam mesh = mesh_of<TypeParam>(cube());
  std::map<typename Traits::halfedge_descriptor, Point_2> uv;
  std::map<typename Traits::face_descriptor, int> chart, page;
  // All faces cover the same unit square; face number k is k + 1 times as large. The first has none.
  const std::vector<Point_2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  int k = 0;
  for (const auto f : faces(mesh)) {
    int corner = 0;
    for (const auto h : CGAL::halfedges_around_face(halfedge(f, mesh), mesh)) {
      const Point_2& p = square[corner++];
      uv[h] = k == 0 ? Point_2(std::nan(""), 0) : Point_2((k + 1) * p.x(), (k + 1) * p.y());
    }
    ++k;
  }
  const auto uv_map = boost::make_assoc_property_map(uv);
  const auto pages = boost::make_assoc_property_map(page);
  const auto np = parameters::texture_size(128).gutter(3);
  const Packing packing = pack_charts(
      mesh, uv_map, np.face_chart_map(boost::make_assoc_property_map(chart)).face_page_map(pages));
  ASSERT_EQ(packing.placements.size(), 5u);
  EXPECT_EQ(packing.number_of_pages, 1u);

  k = 0;
  for (const auto f : faces(mesh)) {
    std::vector<Point_2> p;
    for (const auto h : CGAL::halfedges_around_face(halfedge(f, mesh), mesh))
      p.push_back(uv[h]);
    EXPECT_EQ(chart[f], k - 1);
    if (k++ == 0) {
      EXPECT_TRUE(std::isnan(p[0].x()));
      continue;
    }
    for (int i = 0; i < 4; ++i) // k times the unit, still a square
      EXPECT_NEAR(std::sqrt(CGAL::squared_distance(p[i], p[(i + 1) % 4])) * 128, k * packing.density,
                  1e-9 * 128);
    EXPECT_NEAR(std::sqrt(CGAL::squared_distance(p[0], p[2])) * 128, std::sqrt(2.0) * k * packing.density,
                1e-9 * 128);
  }
  const Atlas_certificate certificate = verify_atlas(mesh, uv_map, np.face_page_map(pages));
  EXPECT_EQ(certificate.overlaps_between_charts, 0u);
  EXPECT_EQ(certificate.corners_outside, 0u);
  EXPECT_GE(certificate.chart_distance, 2.99);
  EXPECT_EQ(certificate.not_finite, 2u);

  // Once more, on two pages and by another packer.
  Page_options options;
  options.width = options.height = 64;
  options.pages = 2;
  const Packing two = pack_charts(
      mesh, uv_map, parameters::page_options(options).packer(Horizon_packer()).face_page_map(pages));
  EXPECT_EQ(two.number_of_pages, 2u);
  int on_second = 0;
  for (const auto& entry : page)
    on_second += entry.second;
  EXPECT_GE(on_second, 1);
  EXPECT_EQ(
      verify_atlas(mesh, uv_map, parameters::texture_size(64).face_page_map(pages)).overlaps_between_charts,
      0u);
}

TEST(Pack_charts_of_mesh_errors, leaves_coordinates_alone_where_there_is_no_room)
{
  const Surface_mesh mesh = mesh_of<Surface_mesh>(cube());
  std::map<Surface_mesh::Halfedge_index, Point_2> uv;
  const std::vector<Point_2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const auto f : faces(mesh)) {
    int corner = 0;
    for (const auto h : CGAL::halfedges_around_face(halfedge(f, mesh), mesh))
      uv[h] = square[corner++];
  }
  const auto before = uv;
  Page_options options;
  options.width = options.height = 64;
  options.locked.resize(6);
  options.locked[0] = Placement{64, 0, 0, 0}; // the first chart covers the whole page
  const Packing packing =
      pack_charts(mesh, boost::make_assoc_property_map(uv), parameters::page_options(options));
  EXPECT_EQ(packing.number_of_pages, 0u);
  EXPECT_EQ(uv, before);
}

} // namespace
} // namespace Atlas::test
