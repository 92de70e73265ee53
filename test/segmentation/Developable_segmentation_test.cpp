// SPDX-License-Identifier: MIT
#include <Atlas/core/concepts.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/packing/Raster_packer.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>
#include <Atlas/parameterization/Fixed_border_parameterizer.h>
#include <Atlas/segmentation/Merged_segmentation.h>
#include <Atlas/segmentation/cut_to_discs.h>

#include "test_meshes.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace Atlas::test {
namespace {

static_assert(BoundedSegmentation<Developable_segmentation>);

/// Fails the test when it is asked to segment a triangle.
struct Nothing_left
{
  Segmentation segment(const Surface& surface, const Execution&) const
  {
    ADD_FAILURE() << surface.number_of_triangles() << " triangles are taken for curved";
    return one_chart(surface);
  }
};

Segmentation segment(const Surface& surface)
{
  return Developable_segmentation(Nothing_left(), Raster_packer()).segment(surface, Execution(1));
}

/// The length of seams inside of the surface.
double seams(const Surface& surface, const Segmentation& g)
{
  double twice = 0;
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (surface.opposite[h] != no_index && !g.is_glued(surface, h))
      twice += std::sqrt(CGAL::squared_distance(surface.point(h), surface.point(next_halfedge(h))));
  return twice / 2;
}

/// Cuts to discs, unrolls, and checks that no length has changed.
std::vector<Chart> unrolled(const Surface& surface, Segmentation g)
{
  cut_to_discs(surface, g);
  std::vector<Chart> charts = extract_charts(surface, g);
  for (Chart& chart : charts) {
    EXPECT_EQ(Isometric_parameterizer(Tutte_parameterizer()).parameterize(chart, Execution(1)),
              Chart_status::valid);
    for (const Triangle_distortion& t : triangle_distortions(chart)) {
      EXPECT_NEAR(t.largest, 1, 1e-9);
      EXPECT_NEAR(t.smallest, 1, 1e-9);
    }
  }
  return charts;
}

/// An axis-parallel box of a x b x c, each side of `n` x `n` quads.
Soup box(double a, double b, double c, Index n = 1)
{
  Soup soup;
  std::map<std::array<Index, 3>, Index> number;
  const auto point = [&](std::array<Index, 3> p) {
    const auto [it, is_new] = number.try_emplace(p, static_cast<Index>(soup.points.size()));
    if (is_new)
      soup.points.emplace_back(a * p[0] / n, b * p[1] / n, c * p[2] / n);
    return it->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const Index side : {Index(0), n})
      for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j) {
          std::vector<Index> quad;
          for (const auto& [u, v] : {std::pair{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}) {
            std::array<Index, 3> p{};
            p[axis] = side;
            p[(axis + 1) % 3] = u;
            p[(axis + 2) % 3] = v;
            quad.push_back(point(p));
          }
          if (side == 0)
            std::reverse(quad.begin(), quad.end());
          soup.polygons.push_back(quad);
        }
  return soup;
}

/// A cylinder or a cone of height 2 about the z axis, of `n` sides and `rows` rows of quads.
Soup cone(Index n, Index rows, double bottom, double top)
{
  return grid(
      n, rows,
      [=](double x, double y) {
        const double r = bottom + (top - bottom) * y, a = 2 * M_PI * x;
        return Point_3(r * std::cos(a), r * std::sin(a), 2 * y);
      },
      true, false, true);
}

/// A plane square with square holes: cells (i, j) of n x n with both odd are missing.
Soup plate(Index n)
{
  Soup soup = grid(
      n, n, [](double x, double y) { return Point_3(x, y, 0.5 * x); }, false, false, true);
  std::vector<std::vector<Index>> kept;
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i)
      if (i % 2 == 0 || j % 2 == 0)
        kept.push_back(soup.polygons[j * n + i]);
  soup.polygons = std::move(kept);
  return soup;
}

TEST(Developable_segmentation, boxes_become_nets)
{
  for (const Index n : {1, 4}) {
    const Surface surface = surface_of(box(1, 2, 3, n));
    const Segmentation g = segment(surface);
    // Six sides: a net of one piece has seven edges open, two pieces eight.
    EXPECT_LE(g.number_of_charts, 2u);
    EXPECT_LE(seams(surface, g), 16);
    EXPECT_GE(seams(surface, g), 4 * 1 + 2 * 2 + 3 - 1e-9);
    unrolled(surface, g);
  }
}

TEST(Developable_segmentation, cylinders_and_cones_open_along_one_ruling)
{
  for (const Index n : {6, 12, 32, 200})
    for (const Index rows : {1, 3})
      for (const double top : {1.0, 0.3}) {
        const Surface surface = surface_of(cone(n, rows, 1, top));
        const Segmentation g = segment(surface);
        EXPECT_EQ(g.number_of_charts, 1u) << n << " sides";
        EXPECT_NEAR(seams(surface, g), std::hypot(2, 1 - top), 1e-9) << n << " sides";
        unrolled(surface, g);
      }
}

TEST(Developable_segmentation, cylinder_is_an_exact_rectangle_along_the_axes)
{
  const Surface surface = surface_of(cone(32, 4, 1, 1));
  const Chart chart = unrolled(surface, segment(surface)).at(0);
  const CGAL::Bbox_2 box = CGAL::bbox_2(chart.uv.begin(), chart.uv.end());
  const double width = 32 * 2 * std::sin(M_PI / 32);
  const double w = box.xmax() - box.xmin(), h = box.ymax() - box.ymin();
  EXPECT_NEAR(std::min(w, h), 2, 1e-12);
  EXPECT_NEAR(std::max(w, h), width, 1e-12);
}

/// A cone of `n` triangles around an apex.
Soup cone_with_apex(Index n, double height)
{
  Soup soup;
  soup.points.emplace_back(0, 0, height);
  for (Index i = 0; i < n; ++i) {
    const double a = 2 * M_PI * i / n;
    soup.points.emplace_back(std::cos(a), std::sin(a), 0);
    soup.polygons.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  return soup;
}

TEST(Developable_segmentation, cones_open_from_the_border_to_the_apex)
{
  for (const Index n : {6, 8, 16, 40, 100})
    for (const double height : {0.3, 2.0}) {
      const Surface surface = surface_of(cone_with_apex(n, height));
      const Segmentation g = segment(surface);
      EXPECT_EQ(g.number_of_charts, 1u) << n << " sides, height " << height;
      EXPECT_NEAR(seams(surface, g), std::hypot(1, height), 1e-9) << n << " sides, height " << height;
      unrolled(surface, g);
    }
}

/// A prism of height `z` over a star-shaped polygon around the origin, which has corners at `radius` in turn.
Soup prism(const std::vector<double>& radius, double z)
{
  Soup soup;
  const Index n = static_cast<Index>(radius.size());
  for (const double level : {0.0, z})
    for (Index i = 0; i < n; ++i) {
      const double a = 2 * M_PI * i / n;
      soup.points.emplace_back(radius[i] * std::cos(a), radius[i] * std::sin(a), level);
    }
  soup.points.emplace_back(0, 0, 0);
  soup.points.emplace_back(0, 0, z);
  for (Index i = 0; i < n; ++i) {
    const Index k = (i + 1) % n;
    soup.polygons.push_back({i, k, n + k, n + i});
    soup.polygons.push_back({2 * n, k, i});
    soup.polygons.push_back({2 * n + 1, n + i, n + k});
  }
  return soup;
}

TEST(Developable_segmentation, prisms_of_any_kind_unroll_at_any_scale_and_angle)
{
  for (const std::vector<double>& radius :
       {std::vector<double>(6, 1), std::vector<double>(200, 1), std::vector<double>{1, 2, 1, 2, 1, 2, 1, 2},
        std::vector<double>{3, 3, 3, 1, 3, 3, 3, 1}})
    for (const double scale : {1e-3, 1e3}) {
      Soup soup = prism(radius, 1.7);
      for (Point_3& p : soup.points) // an orthogonal matrix
        p = Point_3(scale * (0.36 * p.x() + 0.48 * p.y() - 0.8 * p.z()), scale * (-0.8 * p.x() + 0.6 * p.y()),
                    scale * (0.48 * p.x() + 0.64 * p.y() + 0.6 * p.z()));
      const Surface surface = surface_of(soup);
      const Segmentation g = segment(surface);
      EXPECT_LE(g.number_of_charts, 4u) << radius.size() << " sides";
      unrolled(surface, g);
    }
}

TEST(Developable_segmentation, chamfers_are_belts_not_teeth)
{
  const Index n = 24;
  const Surface surface = surface_of(grid(
      n, 2,
      [](double x, double y) {
        const double r = y > 0.75 ? 0.9 : 1, z = y > 0.75 ? 2.1 : 4 * y, a = 2 * M_PI * x;
        return Point_3(r * std::cos(a), r * std::sin(a), z);
      },
      true, false, true));
  const Segmentation g = segment(surface);
  Index open = 0;
  for (Index h = 0; h < surface.opposite.size(); ++h) {
    const Index o = surface.opposite[h];
    const bool is_in_belt = surface.point(h).z() > 1.9 && surface.point(next_halfedge(h)).z() > 1.9;
    open += o != no_index && surface.point(h).z() != surface.point(next_halfedge(h)).z() && is_in_belt &&
            !g.is_glued(surface, h);
  }
  EXPECT_LE(open, 2u) << "both sides of the one ruling at which the belt opens";
  unrolled(surface, g);
}

TEST(Developable_segmentation, holes_need_no_seam)
{
  const Surface surface = surface_of(plate(7));
  const Segmentation g = segment(surface);
  EXPECT_EQ(g.number_of_charts, 1u);
  EXPECT_EQ(seams(surface, g), 0);
  // Cut to a disc, both sides of each cut get the same coordinates.
  Segmentation discs = g;
  cut_to_discs(surface, discs);
  EXPECT_GT(seams(surface, discs), 0);
  const Chart chart = unrolled(surface, g).at(0);
  for (Index h = 0; h < surface.opposite.size(); ++h) {
    const Index o = surface.opposite[h];
    if (o != no_index && discs.cut[h]) {
      EXPECT_EQ(chart.uv[chart.triangles[h / 3][h % 3]],
                chart.uv[chart.triangles[o / 3][next_halfedge(o) % 3]]);
    }
  }
}

/// A box of 3 x 2 x 1 with round edges and corners, in `n` steps: its six faces are two triangles each.
Soup round_box(int n)
{
  Soup soup;
  std::map<std::array<long, 3>, Index> number;
  const auto point = [&](int row, int column) {
    const int quarter = column / (n + 1) % 4;
    const double r = 0.1, a = M_PI / 2 * (quarter + double(column % (n + 1)) / n),
                 b = M_PI / 2 * (row <= n ? double(row) / n - 1 : double(row - n - 1) / n);
    const double x = (quarter == 0 || quarter == 3 ? 1.4 : -1.4) + r * std::cos(b) * std::cos(a),
                 y = (quarter < 2 ? 0.9 : -0.9) + r * std::cos(b) * std::sin(a),
                 z = (row <= n ? -0.4 : 0.4) + r * std::sin(b);
    const auto [it, is_new] =
        number.try_emplace({std::lround(1e9 * x), std::lround(1e9 * y), std::lround(1e9 * z)},
                           static_cast<Index>(soup.points.size()));
    if (is_new)
      soup.points.emplace_back(x, y, z);
    return it->second;
  };
  const auto triangle = [&](Index a, Index b, Index c) {
    if (a != b && b != c && c != a)
      soup.polygons.push_back({a, b, c});
  };
  for (int row = 0; row < 2 * n + 1; ++row)
    for (int column = 0; column < 4 * (n + 1); ++column) {
      const Index a = point(row, column), b = point(row, column + 1), c = point(row + 1, column + 1),
                  d = point(row + 1, column);
      triangle(a, b, c);
      triangle(a, c, d);
    }
  for (const int row : {0, 2 * n + 1}) { // bottom and top
    const std::array corners{point(row, 0), point(row, n + 1), point(row, 2 * n + 2), point(row, 3 * n + 3)};
    const Index b = corners[row == 0 ? 3 : 1], d = corners[row == 0 ? 1 : 3];
    triangle(corners[0], b, corners[2]);
    triangle(corners[0], corners[2], d);
  }
  return soup;
}

TEST(Developable_segmentation, plane_faces_stay_between_round_edges)
{
  struct Rest
  {
    double* area;
    Segmentation segment(const Surface& surface, const Execution&) const
    {
      *area = 0;
      for (Index t = 0; t < surface.number_of_triangles(); ++t)
        *area += std::sqrt(
            CGAL::squared_area(surface.point(3 * t), surface.point(3 * t + 1), surface.point(3 * t + 2)));
      return one_chart(surface);
    }
  };
  for (const int n : {2, 4, 8}) {
    const Surface surface = surface_of(round_box(n));
    double rest = 0;
    (void)Developable_segmentation(Rest{&rest}, Raster_packer()).segment(surface, Execution(1));
    const double faces = 2 * (2.8 * 1.8 + 2.8 * 0.8 + 1.8 * 0.8), whole = area_3d(surface);
    EXPECT_GT(rest, 0) << "the corners are curved";
    EXPECT_LE(rest, whole - faces + 1e-9) << "the faces are plane";
  }
}

TEST(Developable_segmentation, wanted_seams_and_patches_are_not_glued)
{
  Surface surface = surface_of(box(1, 1, 1, 2));
  surface.patch.resize(surface.number_of_triangles());
  for (Index t = 0; t < surface.patch.size(); ++t)
    surface.patch[t] = surface.face[t] / 4 % 2;
  const Segmentation g = segment(surface);
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (surface.patch[h / 3] != surface.patch[surface.opposite[h] / 3]) {
      EXPECT_FALSE(g.is_glued(surface, h));
    }
}

TEST(Developable_segmentation, nets_do_not_depend_on_scale_and_place)
{
  const Soup soup = box(1, 2, 3, 2);
  const Segmentation g = segment(surface_of(soup));
  for (const double scale : {1.0 / 1024, 4096.0}) {
    Soup other = soup;
    for (Point_3& p : other.points)
      p = Point_3(scale * p.x(), scale * p.y(), scale * p.z());
    EXPECT_EQ(segment(surface_of(other)).chart, g.chart);
    EXPECT_EQ(segment(surface_of(other)).cut, g.cut);
  }
}

} // namespace
} // namespace Atlas::test
