// SPDX-License-Identifier: MIT
// Figures 1 and 3 of the paper: iso-parameter curves.
#include <Atlas/core/build_surface.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/image/Image.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/segmentation/cut_to_discs.h>

#include <CGAL/number_utils.h>

#include "Scene.h"
#include "paper_results.h"
#include <cmath>
#include <complex>
#include <fstream>
#include <stdexcept>

namespace {

using Atlas::Chart;
using Atlas::Index;
using Atlas::Point_2;
using Atlas::Point_3;

/// \brief A texture of iso-parameter curves: u in blue, v in red.
///
/// The upper half has the plain colours of `Palette`, for lines; the lower half is for charts.
class Curves
{
public:
  /// \param spacing  between curves, in the unit of the chart's coordinates
  Curves(const Chart& chart, double spacing)
      : box_(CGAL::bbox_2(chart.uv.begin(), chart.uv.end())),
        scale_(std::min(0.96 / box_.x_span(), 0.46 / box_.y_span())), spacing_(spacing)
  {}

  /// The place in the texture of a chart's coordinates.
  Point_2 operator()(const Point_2& p) const
  {
    return Point_2(0.02 + (p.x() - box_.xmin()) * scale_, 0.02 + (p.y() - box_.ymin()) * scale_);
  }

  Atlas::Image image() const
  {
    Atlas::Image image = Palette::image();
    for (std::size_t y = image.height / 2; y < image.height; ++y)
      for (std::size_t x = 0; x < image.width; ++x) {
        const double side = static_cast<double>(image.width);
        const double u = (static_cast<double>(x) + 0.5) / side - 0.02;
        const double v = 1 - (static_cast<double>(y) + 0.5) / side - 0.02;
        image.at(x, y) = is_on_curve(u)   ? Atlas::Color{38, 70, 160}
                         : is_on_curve(v) ? Atlas::Color{190, 40, 40}
                                          : Atlas::Color{240, 238, 230};
      }
    return image;
  }

private:
  bool is_on_curve(double t) const
  {
    const double phase = t / (spacing_ * scale_);
    return phase - std::floor(phase) < 0.16;
  }

  CGAL::Bbox_2 box_;
  double scale_, spacing_;
};

/// The edges of a chart with a triangle on one side only, as pairs of its vertices.
std::vector<std::array<Index, 2>> border_edges(const Chart& chart)
{
  std::vector<std::array<Index, 3>> edges; // smaller end, larger end, halfedge
  for (Index h = 0; h < 3 * chart.number_of_triangles(); ++h) {
    const Index a = chart.triangles[h / 3][h % 3], b = chart.triangles[h / 3][(h + 1) % 3];
    edges.push_back({std::min(a, b), std::max(a, b), h});
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::array<Index, 2>> result;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto is_same = [&](std::size_t j) {
      return j < edges.size() && edges[j][0] == edges[i][0] && edges[j][1] == edges[i][1];
    };
    if (!is_same(i + 1) && (i == 0 || !is_same(i - 1)))
      result.push_back({edges[i][0], edges[i][1]});
  }
  return result;
}

/// A chart with curves and border, at its places in space or in the plane.
Atlas::Image picture(const Chart& chart, const std::vector<Point_3>& points, const Curves& curves,
                     const Atlas::View_direction& view, std::size_t size, bool has_edges = false)
{
  const CGAL::Bbox_3 box = CGAL::bbox_3(points.begin(), points.end());
  const double extent = std::max({box.x_span(), box.y_span(), box.z_span()});
  Scene scene(0.006 * extent);
  scene.set_points(points);
  for (const auto& t : chart.triangles)
    scene.add_triangle(t, {curves(chart.uv[t[0]]), curves(chart.uv[t[1]]), curves(chart.uv[t[2]])});
  for (const auto& [a, b] : border_edges(chart))
    scene.add_line(points[a], points[b], Palette::dark);
  if (has_edges)
    for (const auto& t : chart.triangles)
      for (int i = 0; i < 3; ++i)
        if (t[i] < t[(i + 1) % 3])
          scene.add_thin_line(points[t[i]], points[t[(i + 1) % 3]], Palette::grey);
  return scene.picture(view, size, curves.image());
}

std::vector<Point_3> in_the_plane(const Chart& chart)
{
  std::vector<Point_3> points;
  for (const Point_2& p : chart.uv)
    points.emplace_back(p.x(), p.y(), 0);
  return points;
}

/// Pins the chart at two opposite corners of its square, whatever its triangles: maps with other pins are
/// other maps.
struct Corner_pins
{
  using Solver = Atlas::Eigen_LSCM_traits::Solver;

  static std::vector<Atlas::LSCM_pin> pins(const Chart& chart)
  {
    const auto is_before = [&](const Point_3& a, const Point_3& b) { return a.x() + a.y() < b.x() + b.y(); };
    const auto [low, high] = std::minmax_element(chart.points.begin(), chart.points.end(), is_before);
    return {{static_cast<Index>(low - chart.points.begin()), Point_2(0, 0)},
            {static_cast<Index>(high - chart.points.begin()), Point_2(1, 1)}};
  }
};

template <typename Traits>
void flatten(Chart& chart)
{
  if (Atlas::LSCM_parameterizer<Traits>().parameterize(chart, Atlas::Execution()) !=
      Atlas::Chart_status::valid)
    throw std::runtime_error("a chart of a figure cannot be flattened");
}

/// \brief A hilly square, as heights over a grid that may be graded.
///
/// \param resolution  of the left and of the right half, in cells a side; the finer is a multiple of the
/// coarser. Cells of the coarser half along the middle get the finer side's vertices as corners, so that the
/// mesh conforms.
Chart hilly_square(Index left, Index right)
{
  Atlas::Chart chart;
  const Index finest = std::max(left, right);
  std::vector<Index> number((finest + 1) * (finest + 1), Atlas::no_index);
  const auto vertex = [&](Index i, Index j) {
    Index& v = number[i * (finest + 1) + j];
    if (v == Atlas::no_index) {
      v = static_cast<Index>(chart.points.size());
      const double x = double(i) / finest, y = double(j) / finest;
      chart.points.emplace_back(x, y, 0.16 * std::sin(6 * x + 0.4) * std::cos(5 * y));
    }
    return v;
  };
  const auto add_polygon = [&](const std::vector<Index>& corners) { // a fan from its middle one
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      chart.triangles.push_back({corners[0], corners[k], corners[k + 1]});
  };
  for (const bool is_right : {false, true}) {
    const Index n = is_right ? right : left, step = finest / n, other = finest / (is_right ? left : right);
    for (Index i = is_right ? n / 2 : 0; i < (is_right ? n : n / 2); ++i)
      for (Index j = 0; j < n; ++j) {
        const Index x = i * step, y = j * step;
        const bool meets = other < step && i == (is_right ? n / 2 : n / 2 - 1);
        std::vector<Index> corners;
        if (meets && is_right) { // its left side has the vertices of the finer half
          corners = {vertex(x + step, y), vertex(x + step, y + step)};
          for (Index k = step + other; k > 0; k -= other)
            corners.push_back(vertex(x, y + k - other));
        } else if (meets) {
          corners = {vertex(x, y + step), vertex(x, y)};
          for (Index k = 0; k <= step; k += other)
            corners.push_back(vertex(x + step, y + k));
        } else
          corners = {vertex(x, y), vertex(x + step, y), vertex(x + step, y + step), vertex(x, y + step)};
        add_polygon(corners);
      }
  }
  return chart;
}

/// \brief Turns, scales and shifts the coordinates of a chart so that they come as near as they can to those
/// of another at the vertices that both have. \return the largest distance left, over the other's extent
double align(Chart& chart, const Chart& other)
{
  using Complex = std::complex<double>;
  std::vector<std::array<Index, 2>> pairs;
  std::vector<Index> by_place(other.points.size());
  for (Index v = 0; v < by_place.size(); ++v)
    by_place[v] = v;
  const auto is_before = [&](Index a, Index b) { return other.points[a] < other.points[b]; };
  std::sort(by_place.begin(), by_place.end(), is_before);
  for (Index v = 0; v < chart.points.size(); ++v) {
    const auto at = std::lower_bound(by_place.begin(), by_place.end(), v,
                                     [&](Index a, Index b) { return other.points[a] < chart.points[b]; });
    if (at != by_place.end() && other.points[*at] == chart.points[v])
      pairs.push_back({v, *at});
  }
  const auto complex = [](const Point_2& p) { return Complex(p.x(), p.y()); };
  Complex mean = 0, other_mean = 0, product = 0;
  for (const auto& [v, w] : pairs) {
    mean += complex(chart.uv[v]) / double(pairs.size());
    other_mean += complex(other.uv[w]) / double(pairs.size());
  }
  double norm = 0;
  for (const auto& [v, w] : pairs) {
    product += (complex(other.uv[w]) - other_mean) * std::conj(complex(chart.uv[v]) - mean);
    norm += std::norm(complex(chart.uv[v]) - mean);
  }
  for (Point_2& p : chart.uv) {
    const Complex moved = (complex(p) - mean) * product / norm + other_mean;
    p = Point_2(moved.real(), moved.imag());
  }
  double farthest = 0;
  for (const auto& [v, w] : pairs)
    farthest = std::max(farthest, std::abs(complex(chart.uv[v]) - complex(other.uv[w])));
  const CGAL::Bbox_2 box = CGAL::bbox_2(other.uv.begin(), other.uv.end());
  return farthest / std::max(box.x_span(), box.y_span());
}

} // namespace

Atlas::Chart chart_of_part(const Atlas::Surface& surface, const std::vector<double>& ball)
{
  Atlas::Segmentation parts{std::vector<Index>(surface.number_of_triangles(), 0),
                            std::vector<std::uint8_t>(surface.opposite.size(), 0), 1};
  Index nearest = 0;
  if (!ball.empty()) {
    const Point_3 centre(ball[0], ball[1], ball[2]);
    const auto distance = [&](Index t) { return CGAL::squared_distance(surface.point(3 * t), centre); };
    for (Index t = 0; t < parts.chart.size(); ++t) {
      parts.chart[t] = distance(t) < ball[3] * ball[3];
      nearest = distance(t) < distance(nearest) ? t : nearest;
    }
    parts.number_of_charts = 2;
  }
  cut_to_discs(surface, parts);
  return extract_charts(surface, parts).at(parts.chart[nearest]);
}

void draw_large_chart(const Named_mesh& mesh, const std::vector<double>& ball, const Paper_options& options)
{
  Chart chart = chart_of_part(mesh.surface, ball);
  flatten<Atlas::Eigen_LSCM_traits>(chart);
  const CGAL::Bbox_2 box = CGAL::bbox_2(chart.uv.begin(), chart.uv.end());
  const Curves curves(chart, std::max(box.x_span(), box.y_span()) / 40);
  const auto write = [&](const char* name, const std::vector<Point_3>& points, Atlas::View_direction view) {
    write_png(options.folder / (std::string("figure_1_") + name + ".png"),
              picture(chart, points, curves, view, options.size));
  };
  write("model", chart.points, mesh.view);
  write("back", chart.points, {mesh.view.azimuth + 180, mesh.view.elevation});
  write("plane", in_the_plane(chart), {0, 0});
  std::ofstream(options.folder / "figure_1.html")
      << "<p>" << mesh.name << ": one chart of " << chart.number_of_triangles() << " triangles.</p>\n";
}

void draw_resolutions(const Paper_options& options)
{
  const std::array<const char*, 4> names = {"coarse", "fine", "graded_left", "graded_right"};
  std::array<Chart, 4> charts = {hilly_square(24, 24), hilly_square(96, 96), hilly_square(24, 96),
                                 hilly_square(96, 24)};
  std::ofstream html(options.folder / "figure_3.html");
  html << "<table><tr><th>mesh</th><th>triangles</th><th>farthest vertex from its place in the fine map, "
          "% of its extent</th></tr>\n";
  for (Chart& chart : charts)
    flatten<Corner_pins>(chart);
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const double off = align(charts[i], charts[1]);
    html << "<tr><td>" << names[i] << "</td><td>" << charts[i].number_of_triangles() << "</td><td>"
         << 100 * off << "</td></tr>\n";
    const Curves curves(charts[i], 1. / 24);
    write_png(options.folder / (std::string("figure_3_") + names[i] + ".png"),
              picture(charts[i], charts[i].points, curves, {20, 50}, options.size, true));
  }
  html << "</table>\n";
}
