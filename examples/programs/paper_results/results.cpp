// SPDX-License-Identifier: MIT
// Figures 7 to 10 of the paper: the page and its horizon, model and page, histograms, a painted model.
#include <Atlas/image/Image.h>
#include <Atlas/image/pages.h>
#include <Atlas/image/render_model.h>
#include <Atlas/report/internal/histogram_svg.h>
#include <Atlas/soup/internal/face_distortion.h>

#include "paper_results.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numeric>

namespace {

using Atlas::Color;
using Atlas::Index;
using Atlas::Point_2;

constexpr Color grey = {205, 205, 200}, green = {120, 190, 110}, black = {20, 20, 20}, blue = {30, 80, 200},
                red = {214, 40, 30}, pink = {240, 130, 190};

/// The bottom and the top of a chart in each column of the page, in pixels; an empty column has bottom > top.
struct Horizons
{
  std::vector<double> bottom, top;
  double highest = 0, lowest = 0;
};

/// The horizons of all charts.
std::vector<Horizons> horizons_of(const Named_mesh& mesh, const std::vector<Point_2>& uv,
                                  const std::vector<Index>& face_chart, std::size_t size)
{
  const auto number =
      std::accumulate(face_chart.begin(), face_chart.end(), Index(0), [](Index most, Index c) {
        return c == Atlas::no_index ? most : std::max(most, c + 1);
      });
  const double side = static_cast<double>(size);
  std::vector<Horizons> result(number,
                               {std::vector<double>(size, side), std::vector<double>(size, -1.), 0, side});
  for (std::size_t h = 0; h < mesh.surface.opposite.size(); ++h) {
    const Index chart = face_chart[mesh.surface.face[h / 3]];
    if (chart == Atlas::no_index)
      continue;
    const Point_2 &p = uv[mesh.surface.corner[h]], &q = uv[mesh.surface.corner[h - h % 3 + (h + 1) % 3]];
    const auto [left, right] = p.x() < q.x() ? std::pair(p, q) : std::pair(q, p);
    Horizons& here = result[chart];
    const auto last = std::min(size - 1, static_cast<std::size_t>(right.x() * side));
    for (auto x = static_cast<std::size_t>(left.x() * side); x <= last; ++x) {
      const double at = std::clamp((static_cast<double>(x) + 0.5) / side, left.x(), right.x());
      const double t = right.x() > left.x() ? (at - left.x()) / (right.x() - left.x()) : 0;
      const double y = side * (left.y() + t * (right.y() - left.y()));
      here.bottom[x] = std::min(here.bottom[x], y);
      here.top[x] = std::max(here.top[x], y);
    }
    here.highest = std::max({here.highest, side * p.y(), side * q.y()});
    here.lowest = std::min({here.lowest, side * p.y(), side * q.y()});
  }
  return result;
}

/// Fills a column of a picture whose y axis points up between two heights.
void fill(Atlas::Image& image, std::size_t x, double from, double to, const Color& color)
{
  const double height = static_cast<double>(image.height);
  for (double y = std::max(std::floor(from), 0.); y < std::min(to, height); ++y)
    image.at(x, image.height - 1 - static_cast<std::size_t>(y)) = color;
}

/// \brief Figure 7 A: a chart falls on the horizon of those that came before it, the longer ones.
///
/// The chart that is shown is the one that loses most space below it, of those behind the first few.
Atlas::Image draw_horizon(const std::vector<Horizons>& charts, std::size_t size)
{
  std::vector<Index> order(charts.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return charts[a].highest - charts[a].lowest > charts[b].highest - charts[b].lowest;
  });
  const auto raise = [&](std::vector<double>& horizon, const Horizons& chart) {
    for (std::size_t x = 0; x < size; ++x)
      horizon[x] = std::max(horizon[x], chart.top[x]);
  };
  std::vector<double> horizon(size, 0);
  std::size_t shown = 0;
  double most = -1;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Horizons& chart = charts[order[k]];
    double lost = 0;
    for (std::size_t x = 0; x < size; ++x)
      if (chart.bottom[x] <= chart.top[x])
        lost += std::max(chart.bottom[x] - horizon[x], 0.);
    if (k >= std::min<std::size_t>(8, order.size() / 2) && lost > most) {
      most = lost;
      shown = k;
    }
    raise(horizon, chart);
  }
  Atlas::Image image(size, size);
  horizon.assign(size, 0);
  for (std::size_t k = 0; k < shown; ++k) {
    for (std::size_t x = 0; x < size; ++x)
      fill(image, x, charts[order[k]].bottom[x], charts[order[k]].top[x], grey);
    raise(horizon, charts[order[k]]);
  }
  const Horizons& chart = charts.at(order.at(shown));
  for (std::size_t x = 0; x < size; ++x) {
    fill(image, x, horizon[x], horizon[x] + 3, blue);
    if (chart.bottom[x] > chart.top[x])
      continue;
    fill(image, x, horizon[x], chart.bottom[x], black);
    fill(image, x, chart.bottom[x], chart.top[x], green);
    fill(image, x, chart.bottom[x], chart.bottom[x] + 3, pink);
    fill(image, x, chart.top[x] - 3, chart.top[x], red);
  }
  return image;
}

/// A pattern as a painter may want it: rows of scales.
Atlas::Image scales(std::size_t size)
{
  Atlas::Image image(size, size);
  const double width = static_cast<double>(size) / 56;
  for (std::size_t y = 0; y < size; ++y)
    for (std::size_t x = 0; x < size; ++x) {
      const double row = std::floor(static_cast<double>(y) / width * 2);
      double nearest = 4;
      for (double r = row; r >= row - 1; --r) { // the scale of the row above lies on top
        const double offset = std::fmod(r, 2) / 2, u = static_cast<double>(x) / width + offset;
        const double du = u - std::floor(u) - 0.5, dv = static_cast<double>(y) / width - r / 2;
        const double distance = std::hypot(du, dv);
        if (distance < 0.56)
          nearest = std::min(nearest, distance + (row - r));
      }
      const double shade = nearest < 0.5 ? 1 - 0.5 * nearest : nearest < 0.56 ? 0.25 : 0.6;
      image.at(x, y) = {static_cast<std::uint8_t>(90 + 130 * shade),
                        static_cast<std::uint8_t>(40 + 170 * shade),
                        static_cast<std::uint8_t>(30 + 60 * shade)};
    }
  return image;
}

/// Figure 9, left: the angles between the gradients of u and v; right: areas on the page over their share.
void write_histograms(const Named_mesh& mesh, const Atlas::Polygon_soup& soup,
                      const Atlas::Atlas_report& report, const Paper_options& options)
{
  // Nearly all angles are near 90 degrees: half of the range shows them.
  const auto& angles = report.gradient_angles;
  const auto middle = static_cast<std::ptrdiff_t>(angles.size() / 4);
  const Atlas::Histogram shown{45, 135, {angles.begin() + middle, angles.end() - middle}};
  std::ofstream(options.folder / ("figure_9_" + mesh.name + ".html"))
      << "<div class=\"two\"><div><p>Angle between the gradients of u and v, degrees</p>"
      << Atlas::internal::histogram_svg(shown, {"45", "90", "135"})
      << "</div><div><p>Area on the page over its share</p>"
      << Atlas::internal::histogram_svg(area_histogram(Atlas::measure_distortion(soup)),
                                        {"1/4", "1/2", "1", "2", "4"})
      << "</div></div>\n";
}

} // namespace

void draw_results(const Named_mesh& mesh, const std::vector<Point_2>& uv, const Atlas::Atlas_report& report,
                  const Paper_options& options)
{
  const std::vector<Index>& face_chart = report.face_chart;
  Atlas::Polygon_soup soup = mesh.soup;
  soup.uv = uv;
  const auto write = [&](int figure, const char* what, const Atlas::Image& image) {
    const std::string name = "figure_" + std::to_string(figure) + "_" + mesh.name + what + ".png";
    write_png(options.folder / name, image);
  };
  write(7, "_horizon", draw_horizon(horizons_of(mesh, uv, face_chart, options.size), options.size));
  const Atlas::Image page = draw_atlas(soup, face_chart, options.size);
  write(7, "_page", page);
  constexpr std::size_t texture = 2048;
  write(8, "_model", render_model(soup, draw_atlas(soup, face_chart, texture), options.size, {mesh.view}));
  write(10, "", render_model(soup, scales(texture), options.size, {mesh.view}));
  write_histograms(mesh, soup, report, options);
}
