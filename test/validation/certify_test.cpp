// SPDX-License-Identifier: MIT
#include <Atlas/validation/certify.h>

#include "test_meshes.h"
#include <gtest/gtest.h>
#include <random>

namespace Atlas {
namespace {

using test::Soup;
using test::surface_of;

/// A mesh in the plane z = 0 with its own x and y as coordinates, on a page of 100 x 100 texels.
struct Layout
{
  Surface surface;
  std::vector<Point_2> uv; ///< per input corner
  std::vector<Index> page;
  Certificate_options options;

  explicit Layout(const Soup& soup) : surface(surface_of(soup))
  {
    for (const auto& polygon : soup.polygons)
      for (const Index v : polygon)
        uv.push_back(v < soup.points.size() ? Point_2(soup.points[v].x(), soup.points[v].y())
                                            : Point_2(0, 0));
    options.width = options.height = 100;
  }

  Atlas_certificate certificate(unsigned threads = 1) const
  {
    return certify(surface, uv, page, options, Execution(threads));
  }
};

/// Squares of n x n cells, side by side with some distance, of total width 1 at most.
Soup squares(Index count, Index n, double side, double distance, bool quads = false)
{
  Soup soup;
  for (Index k = 0; k < count; ++k) {
    const Soup one = test::grid(
        n, n, [&](double x, double y) { return Point_3(k * (side + distance) + side * x, side * y, 0); },
        false, false, quads);
    const auto offset = static_cast<Index>(soup.points.size());
    soup.points.insert(soup.points.end(), one.points.begin(), one.points.end());
    for (auto polygon : one.polygons) {
      for (Index& v : polygon)
        v += offset;
      soup.polygons.push_back(polygon);
    }
  }
  return soup;
}

TEST(Certify, AValidAtlas)
{
  Layout layout(squares(3, 4, 0.25, 0.03125));
  layout.options.gutter = 3.125;
  for (Point_2& p : layout.uv)
    p = Point_2(p.x() + 0.0625, p.y() + 0.0625);
  const Atlas_certificate c = layout.certificate();
  EXPECT_TRUE(c.is_valid()) << message(c);
  EXPECT_EQ(message(c), "the atlas is valid");
  EXPECT_EQ(c.triangles, 96u);
  EXPECT_EQ(c.charts, 3u);
  EXPECT_EQ(c.pages, 1u);
  EXPECT_EQ(c.non_disc_charts, 0u);
  EXPECT_EQ(c.seam_length, 0);
  EXPECT_DOUBLE_EQ(c.chart_distance, 3.125);
  EXPECT_DOUBLE_EQ(c.page_border_distance, 6.25);
  EXPECT_DOUBLE_EQ(c.density_min, 100);
  EXPECT_DOUBLE_EQ(c.density_max, 100);
  EXPECT_TRUE(c.culprits.empty());
  EXPECT_EQ(c.face_chart[31], 0u);
  EXPECT_EQ(c.face_chart[32], 1u);
  layout.options.gutter = 3.2;
  EXPECT_FALSE(layout.certificate().is_valid());
  layout.options.gutter = 3.13; // within the tolerance
  EXPECT_TRUE(layout.certificate().is_valid());
  layout.options.gutter = 0;
  for (Point_2& p : layout.uv)
    p = Point_2(p.x() - 0.0625, p.y());
  EXPECT_TRUE(layout.certificate().is_valid()); // at the border of the page
  layout.options.gutter = 1;
  EXPECT_FALSE(layout.certificate().is_valid());
  EXPECT_NE(message(layout.certificate()).find("border of the page"), std::string::npos);
}

TEST(Certify, ListsFacesThatAreTooNearToAnotherChartOrThePageBorder)
{
  Layout layout(squares(3, 4, 0.25, 0.03125));
  for (Point_2& p : layout.uv)
    p = Point_2(p.x() + 0.0625, p.y() + 0.0625);
  EXPECT_TRUE(layout.certificate().crowded_faces.empty());
  for (const double gutter : {3.0, 3.2, 8.0, 12.4}) {
    layout.options.gutter = gutter;
    // Edges on the sides of the squares, and their distances by CGAL.
    using Segment = Kernel::Segment_2;
    struct Edge
    {
      Segment segment;
      Index square, face;
    };
    std::vector<Edge> edges;
    const auto texel = [](const Point_2& p) { return Point_2(100 * p.x(), 100 * p.y()); };
    for (Index c = 0; c < layout.uv.size(); ++c) {
      const Point_2 p = layout.uv[c], q = layout.uv[next_halfedge(c)];
      const Index square = c / 96;
      const double left = 0.0625 + square * 0.28125;
      if ((p.x() == q.x() && (p.x() == left || p.x() == left + 0.25)) ||
          (p.y() == q.y() && (p.y() == 0.0625 || p.y() == 0.3125)))
        edges.push_back({Segment(texel(p), texel(q)), square, c / 3});
    }
    ASSERT_EQ(edges.size(), 3 * 16u);
    std::set<Index> expected;
    for (const Edge& e : edges)
      for (const Edge& f : edges)
        if (e.square != f.square && CGAL::squared_distance(e.segment, f.segment) < std::pow(gutter - 0.01, 2))
          expected.insert(e.face);
    const Atlas_certificate c = layout.certificate();
    EXPECT_EQ(std::set<Index>(c.crowded_faces.begin(), c.crowded_faces.end()), expected) << gutter;
    EXPECT_TRUE(std::is_sorted(c.crowded_faces.begin(), c.crowded_faces.end()));
    EXPECT_EQ(expected.empty(), gutter < 3.125);
    EXPECT_EQ(layout.certificate(2).crowded_faces, c.crowded_faces);
    EXPECT_TRUE(c.culprits.empty());
  }
  layout = Layout(squares(1, 4, 0.5, 0));
  for (Point_2& p : layout.uv)
    p = Point_2(p.x() + 0.0625, p.y() + 0.25);
  layout.options.gutter = 13; // 6.25 texels from the left border of the page: the first column of cells
  EXPECT_EQ(layout.certificate().crowded_faces, (std::vector<Index>{0, 1, 8, 9, 16, 17, 24, 25}));
  layout.options.max_culprits = 3;
  EXPECT_EQ(layout.certificate().crowded_faces, (std::vector<Index>{0, 1, 8}));
}

TEST(Certify, FlippedFlatAndMissingTriangles)
{
  Layout layout(squares(1, 4, 0.5, 0));
  for (Index c = 15; c < 18; ++c) // face 5 keeps its corners, in the other order
    if (c == 15)
      std::swap(layout.uv[15], layout.uv[16]);
  Atlas_certificate c = layout.certificate();
  EXPECT_EQ(c.flipped, 0u); // on its own it is a chart, mirrored
  EXPECT_EQ(c.mirrored_charts, 1u);
  EXPECT_EQ(c.charts, 2u);
  EXPECT_TRUE(c.is_valid());

  layout = Layout(squares(1, 4, 0.5, 0));
  const Point_2 middle(0.25, 0.25);
  for (Point_2& p : layout.uv)
    if (p == middle)
      p = Point_2(0.45, 0.25);
  c = layout.certificate();
  EXPECT_EQ(c.flipped, 2u);
  EXPECT_EQ(c.charts, 1u);
  EXPECT_FALSE(c.is_overlap_free);
  EXPECT_FALSE(c.is_valid());

  layout = Layout(squares(1, 4, 0.5, 0));
  for (Point_2& p : layout.uv)
    if (p == middle)
      p = Point_2(0.375, 0.25); // onto its neighbour
  c = layout.certificate();
  EXPECT_EQ(c.degenerate, 2u);
  EXPECT_EQ(c.flipped, 0u);
  EXPECT_TRUE(c.is_overlap_free);
  EXPECT_EQ(c.culprits.size(), 2u);

  layout = Layout(squares(1, 4, 0.5, 0));
  layout.uv[30] = Point_2(NAN, 0);
  layout.uv[33] = Point_2(0, INFINITY);
  c = layout.certificate();
  EXPECT_EQ(c.not_finite, 2u);
  EXPECT_EQ(c.culprits, (std::vector<Index>{10, 11}));
  EXPECT_EQ(c.face_chart[10], no_index);
  EXPECT_EQ(c.face_chart[9], 0u);
}

TEST(Certify, TrianglesWithoutAreaInSpaceMayBeFlat)
{
  Soup soup;
  soup.points = {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}, {0.5, 1, 0}};
  soup.polygons = {{0, 1, 2}, {0, 2, 3}};
  Layout layout(soup);
  EXPECT_EQ(layout.certificate().degenerate, 0u);
  EXPECT_TRUE(layout.certificate().is_valid());
}

TEST(Certify, OverlapsInAndBetweenCharts)
{
  Layout layout(squares(2, 2, 0.25, 0.125));
  for (std::size_t i = 24; i < 48; ++i)
    layout.uv[i] = layout.uv[i - 24]; // the second onto the first
  Atlas_certificate c = layout.certificate();
  EXPECT_EQ(c.charts, 2u);
  EXPECT_EQ(c.overlaps_in_charts, 0u);
  EXPECT_EQ(c.overlaps_between_charts, 8u);
  EXPECT_EQ(c.chart_distance, 0);
  EXPECT_EQ(c.culprits.size(), 16u);
  // On two pages they are none, and no distance is measured.
  layout.page.assign(8, 7);
  layout.page.resize(16, no_index - 1);
  c = layout.certificate();
  EXPECT_TRUE(c.is_valid());
  EXPECT_EQ(c.pages, 2u);
  EXPECT_EQ(c.chart_distance, std::numeric_limits<double>::infinity());
  // A cap on what is counted and listed.
  layout.page.clear();
  layout.options.max_overlaps = 3;
  layout.options.max_culprits = 2;
  c = layout.certificate();
  EXPECT_EQ(c.overlaps_between_charts, 3u);
  EXPECT_FALSE(c.are_overlaps_complete);
  EXPECT_FALSE(c.are_culprits_complete);
  EXPECT_EQ(c.culprits.size(), 2u);
  EXPECT_FALSE(c.is_valid());
}

TEST(Certify, ContactOfChartsIsDistanceZeroButNoOverlap)
{
  Layout layout(squares(2, 3, 0.25, 0));
  const Atlas_certificate c = layout.certificate();
  // Equal positions in space and in the plane: one chart.
  EXPECT_EQ(c.charts, 1u);
  for (std::size_t i = layout.uv.size() / 2; i < layout.uv.size(); ++i)
    layout.uv[i] = Point_2(layout.uv[i].x(), layout.uv[i].y() + 1.0 / 64);
  const Atlas_certificate d = layout.certificate();
  EXPECT_EQ(d.charts, 2u);
  EXPECT_TRUE(d.is_overlap_free);
  EXPECT_EQ(d.chart_distance, 0);
  EXPECT_EQ(d.seam_length, 0.25);
  EXPECT_TRUE(d.is_valid());
  layout.options.gutter = 2;
  EXPECT_FALSE(layout.certificate().is_valid());
}

TEST(Certify, CornersOutsideOfThePage)
{
  Layout layout(squares(1, 1, 1, 0));
  EXPECT_EQ(layout.certificate().corners_outside, 0u);
  layout.uv[1] = Point_2(std::nextafter(1.0, 2), 0);
  Atlas_certificate c = layout.certificate();
  EXPECT_EQ(c.corners_outside, 1u);
  EXPECT_EQ(c.culprits, std::vector<Index>{0});
  layout.options.precision = Uv_precision::single_precision; // rounds it back to 1
  EXPECT_TRUE(layout.certificate().is_valid()) << message(layout.certificate());
}

TEST(Certify, RoundingComesFirst)
{
  // A triangle that is turned over by rounding to 32 bits.
  Soup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  soup.polygons = {{0, 1, 2}};
  Layout layout(soup);
  layout.uv = {{0.5, 0.5}, {0.75, 0.75 - 1e-12}, {0.625, 0.625}};
  EXPECT_EQ(layout.certificate().degenerate, 0u);
  layout.options.precision = Uv_precision::single_precision;
  EXPECT_EQ(layout.certificate().degenerate, 1u);
}

TEST(Certify, TopologyOfCharts)
{
  Soup sphere = test::sphere(1);
  Layout closed(sphere); // projected: the lower half is turned over
  EXPECT_EQ(closed.certificate().charts, 1u);
  EXPECT_EQ(closed.certificate().non_disc_charts, 1u);

  Soup ring = test::grid(
      12, 2,
      [](double x, double y) {
        return Point_3((1 + y) * std::cos(2 * M_PI * x) / 8 + 0.5, (1 + y) * std::sin(2 * M_PI * x) / 8 + 0.5,
                       0);
      },
      true);
  for (auto& polygon : ring.polygons)
    std::swap(polygon[1], polygon[2]);
  const Atlas_certificate c = Layout(ring).certificate();
  EXPECT_EQ(c.charts, 1u);
  EXPECT_EQ(c.non_disc_charts, 1u);
  EXPECT_TRUE(c.is_valid());

  // Three pages of a book, all with the same coordinates: glued along the spine, which no disc is.
  Soup book;
  book.points = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}};
  book.polygons = {{0, 2, 1}, {0, 3, 1}, {0, 4, 1}};
  Layout pages(book);
  for (std::size_t t = 0; t < 3; ++t)
    for (std::size_t i = 0; i < 3; ++i)
      pages.uv[3 * t + i] = Point_2(i == 1, i == 2);
  const Atlas_certificate b = pages.certificate();
  EXPECT_EQ(b.charts, 1u);
  EXPECT_EQ(b.non_disc_charts, 1u);
  EXPECT_EQ(b.overlaps_in_charts, 3u);
  EXPECT_EQ(b.seam_length, 0);
}

TEST(Certify, AThirdTriangleAtTheEdgeOfAPair)
{
  // Two triangles share an edge by vertex number, a third one has vertices of its own at the same places.
  Soup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 0, 1}};
  soup.polygons = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}};
  Layout layout(soup);
  for (std::size_t i = 6; i < 9; ++i)
    layout.uv[i] = Point_2(0.5, 0.125 * static_cast<double>(i - 6)); // elsewhere
  Atlas_certificate c = layout.certificate();
  EXPECT_EQ(c.charts, 2u);
  EXPECT_DOUBLE_EQ(c.seam_length, std::sqrt(2.0));
  layout.uv[6] = Point_2(0, 0);
  layout.uv[7] = Point_2(1, 1);
  layout.uv[8] = Point_2(0.5, 0);
  c = layout.certificate();
  EXPECT_EQ(c.charts, 1u);
  EXPECT_EQ(c.non_disc_charts, 1u);
  EXPECT_EQ(c.seam_length, 0);
}

TEST(Certify, TwoPairsAtTheSameEdge)
{
  // Four triangles at the same edge in space, two of them on vertices of their own, each pair glued in the
  // plane.
  Soup soup;
  soup.points = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  soup.polygons = {{0, 2, 1}, {0, 1, 3}, {4, 6, 5}, {4, 5, 7}};
  Layout layout(soup);
  layout.uv = {{0, 0},     {0.25, 0},   {0.25, 0.25}, {0, 0},     {0.25, 0.25}, {0, 0.25},
               {0.5, 0.5}, {0.75, 0.5}, {0.75, 0.75}, {0.5, 0.5}, {0.75, 0.75}, {0.5, 0.75}};
  Atlas_certificate c = layout.certificate();
  EXPECT_EQ(c.charts, 2u);
  EXPECT_DOUBLE_EQ(c.seam_length, std::sqrt(2.0));
  EXPECT_TRUE(c.is_valid());
}

TEST(Certify, AnEdgeWithoutLengthIsNoSeam)
{
  // Two quads whose common edge has two vertices at one place. Found by fuzzing.
  const Soup soup{{{0, 0, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, -1, 0}, {1, -1, 0}},
                  {{0, 1, 2, 3}, {1, 0, 4, 5}}};
  Layout layout(soup);
  layout.options.gutter = 1;
  layout.uv = {{.25, .5}, {.5, .5}, {.5, .75}, {.25, .75}, {.5, .5}, {.25, .5}, {.25, .25}, {.5, .25}};
  const Atlas_certificate whole = layout.certificate();
  EXPECT_TRUE(whole.is_valid()) << message(whole);
  EXPECT_EQ(whole.charts, 1u);
  EXPECT_EQ(whole.non_disc_charts, 0u);
  for (std::size_t c = 4; c < 8; ++c)
    layout.uv[c] = layout.uv[c] + Vector_2(0, -.125);
  EXPECT_EQ(layout.certificate().charts, 2u);
}

TEST(Certify, PolygonsAreTriangulated)
{
  const Atlas_certificate c = Layout(squares(2, 3, 0.25, 0.125, true)).certificate();
  EXPECT_EQ(c.faces, 18u);
  EXPECT_EQ(c.triangles, 36u);
  EXPECT_EQ(c.charts, 2u);
  EXPECT_TRUE(c.is_valid());
}

TEST(Certify, FacesThatTakeNoPart)
{
  Soup soup = squares(1, 1, 0.5, 0);
  soup.polygons.push_back({0, 0, 1});
  soup.polygons.push_back({0, 1, 99});
  const Atlas_certificate c = Layout(soup).certificate();
  EXPECT_EQ(c.rejected_faces, 2u);
  EXPECT_EQ(c.faces, 4u);
  EXPECT_TRUE(c.is_valid());
  EXPECT_TRUE(Layout(Soup()).certificate().is_valid());
}

/// The smallest distance of two charts by looking at all pairs of edges.
double distance_by_all_pairs(const Layout& layout, const Atlas_certificate& c)
{
  double best = INFINITY;
  const auto corner = [&](Index h) {
    const Point_2 p = layout.uv[layout.surface.corner[h]];
    return Point_2(100 * p.x(), 100 * p.y());
  };
  for (Index g = 0; g < layout.surface.corner.size(); ++g)
    for (Index h = 0; h < g; ++h)
      if (c.face_chart[layout.surface.face[g / 3]] != c.face_chart[layout.surface.face[h / 3]])
        best = std::min(
            best, std::sqrt(CGAL::squared_distance(Kernel::Segment_2(corner(g), corner(next_halfedge(g))),
                                                   Kernel::Segment_2(corner(h), corner(next_halfedge(h))))));
  return best;
}

TEST(Certify, SmallestDistanceAgreesWithAllPairs)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.009, 0.009);
  for (int trial = 0; trial < 30; ++trial) {
    const auto count = static_cast<Index>(2 + trial % 5);
    Layout layout(squares(count, 3, 0.12, 0.05));
    std::map<Point_2, Point_2> moved;
    for (Point_2& p : layout.uv) {
      const auto [it, is_new] = moved.try_emplace(p, p.x() + shift(random), p.y() + shift(random));
      p = it->second;
    }
    const Atlas_certificate c = layout.certificate();
    ASSERT_EQ(c.charts, count);
    ASSERT_NEAR(c.chart_distance, distance_by_all_pairs(layout, c), 1e-9);
  }
}

TEST(Certify, DoesNotDependOnThreads)
{
  Layout layout(squares(5, 20, 0.15, 0.01));
  std::mt19937 random(9);
  for (int i = 0; i < 300; ++i)
    std::swap(layout.uv[random() % layout.uv.size()], layout.uv[random() % layout.uv.size()]);
  const Atlas_certificate a = layout.certificate(1), b = layout.certificate(4);
  EXPECT_FALSE(a.is_overlap_free);
  EXPECT_EQ(a.culprits, b.culprits);
  EXPECT_EQ(a.overlaps_in_charts, b.overlaps_in_charts);
  EXPECT_EQ(a.overlaps_between_charts, b.overlaps_between_charts);
  EXPECT_EQ(message(a), message(b));
}

} // namespace
} // namespace Atlas
