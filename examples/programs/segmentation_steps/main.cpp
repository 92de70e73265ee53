// SPDX-License-Identifier: MIT
// Draws what the segmentation of the LSCM paper does, step by step, as its figures 4 to 6 do: the feature
// curves, the distance to them, the charts; and a chart that covers itself in the plane, before and after it
// is split.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/image/Image.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/segmentation/Feature_segmentation.h>
#include <Atlas/segmentation/cut_to_discs.h>
#include <Atlas/validation/Culprit_splitter.h>
#include <Atlas/validation/Exact_validator.h>

#include "Scene.h"
#include "stand_up.h"
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

namespace {

using Atlas::Index;

struct Arguments
{
  std::string mesh, prefix;
  std::size_t size = 720;
  Atlas::View_direction view{30, 15};
  std::string up = "y";
  std::vector<double> ball; ///< centre and radius
  Atlas::Feature_segmentation segmentation;
};

/// Draws one surface in many ways.
class Illustrator
{
public:
  Illustrator(const Atlas::Surface& surface, const Arguments& arguments)
      : surface_(surface), arguments_(arguments)
  {
    const CGAL::Bbox_3 box = CGAL::bbox_3(surface.points.begin(), surface.points.end());
    thickness_ = 0.006 * std::max({box.x_span(), box.y_span(), box.z_span()});
  }

  /// \param color per triangle, as Palette::plain() takes it; \param is_line per halfedge
  void draw(const std::string& name, const std::vector<int>& color, const std::vector<std::uint8_t>& is_line,
            int line_color) const
  {
    draw(name, is_line, line_color, [&](Index h) { return Palette::plain(color[h / 3]); });
  }

  /// \param value per triangle
  void draw_scale(const std::string& name, const std::vector<double>& value,
                  const std::vector<std::uint8_t>& is_line, int line_color) const
  {
    std::vector<double> sum(surface_.points.size(), 0), count(sum.size(), 0);
    for (Index h = 0; h < surface_.opposite.size(); ++h) {
      sum[surface_.triangles[h / 3][h % 3]] += value[h / 3];
      ++count[surface_.triangles[h / 3][h % 3]];
    }
    const double largest = *std::max_element(value.begin(), value.end());
    draw(name, is_line, line_color, [&](Index h) {
      const Index v = surface_.triangles[h / 3][h % 3];
      return Palette::on_scale(sum[v] / count[v] / largest);
    });
  }

private:
  template <typename Color_of_corner>
  void draw(const std::string& name, const std::vector<std::uint8_t>& is_line, int line_color,
            Color_of_corner color) const
  {
    Scene scene(thickness_);
    scene.set_points(surface_.points);
    for (Index t = 0; t < surface_.number_of_triangles(); ++t)
      scene.add_triangle(surface_.triangles[t], {color(3 * t), color(3 * t + 1), color(3 * t + 2)});
    for (Index h = 0; h < is_line.size(); ++h)
      if (is_line[h] && (surface_.opposite[h] == Atlas::no_index || h < surface_.opposite[h]))
        scene.add_line(surface_.point(h), surface_.point(Atlas::next_halfedge(h)), line_color);
    Atlas::write_png(arguments_.prefix + "_" + name + ".png",
                     scene.picture(arguments_.view, arguments_.size));
  }

  const Atlas::Surface& surface_;
  const Arguments& arguments_;
  double thickness_;
};

/// The borders of charts, per halfedge: also those of a chart with itself.
std::vector<std::uint8_t> borders(const Atlas::Surface& surface, const Atlas::Segmentation& segmentation)
{
  std::vector<std::uint8_t> result(surface.opposite.size());
  for (Index h = 0; h < result.size(); ++h)
    result[h] = surface.opposite[h] != Atlas::no_index && !segmentation.is_glued(surface, h);
  return result;
}

/// Figures 4 and 5 of the paper.
void draw_segmentation(const Atlas::Surface& surface, const Atlas::Feature_segmentation& model,
                       const Illustrator& illustrator)
{
  const std::vector<std::uint8_t> is_feature = Atlas::detect_features(surface, model.features);
  illustrator.draw("features", std::vector<int>(surface.number_of_triangles(), Palette::white), is_feature,
                   Palette::red);
  const std::vector<double> distance = Atlas::distance_to_features(surface, is_feature);
  illustrator.draw_scale("distance", distance, is_feature, Palette::dark);

  const Atlas::Segmentation grown = Atlas::expand_charts(surface, distance, model.growth);
  std::vector<Index> seed(grown.number_of_charts, Atlas::no_index); // the highest place of each chart
  for (Index t = 0; t < distance.size(); ++t)
    if (Index& s = seed[grown.chart[t]]; s == Atlas::no_index || distance[t] > distance[s])
      s = t;
  std::vector<std::uint8_t> is_source(surface.opposite.size(), 0);
  for (const Index s : seed)
    is_source[3 * s] = is_source[3 * s + 1] = is_source[3 * s + 2] = 1;
  illustrator.draw_scale("seeds", Atlas::distance_to_features(surface, is_source), is_source, Palette::dark);

  const Atlas::Segmentation charts = model.segment(surface);
  illustrator.draw("charts", {charts.chart.begin(), charts.chart.end()}, borders(surface, charts),
                   Palette::dark);
  std::cout << grown.number_of_charts << " charts grown, " << charts.number_of_charts << " in the end\n";
}

/// One chart and its borders, per corner.
struct Framed_chart
{
  Atlas::Chart chart;
  std::vector<std::uint8_t> is_border;
};

/// The charts of those triangles of a segmentation whose part is not 0, made discs.
std::vector<Framed_chart> charts_of_parts(const Atlas::Surface& surface, Atlas::Segmentation& segmentation,
                                          const std::vector<Index>& part)
{
  segmentation.chart = part;
  segmentation.number_of_charts = *std::max_element(part.begin(), part.end()) + 1;
  cut_to_discs(surface, segmentation);
  std::vector<Framed_chart> result;
  for (Atlas::Chart& chart : extract_charts(surface, segmentation)) {
    if (part[chart.source[0]] == 0)
      continue;
    std::vector<std::uint8_t> is_border;
    for (const Index t : chart.source)
      for (Index h = 3 * t; h < 3 * t + 3; ++h)
        is_border.push_back(!segmentation.is_glued(surface, h));
    result.push_back({std::move(chart), std::move(is_border)});
  }
  return result;
}

/// Flattens charts, lays them out side by side, and draws them, red where they cover themselves. Returns what
/// the validator says of each.
std::vector<Atlas::Chart_verdict> draw_flat(const Arguments& arguments, const std::string& name,
                                            std::vector<Framed_chart>& framed)
{
  double left = 0, height = 0;
  std::vector<Atlas::Chart_verdict> verdicts;
  std::vector<Atlas::Point_3> points;
  for (auto& [chart, is_border] : framed) {
    (void)Atlas::LSCM_parameterizer<>().parameterize(chart, Atlas::Execution());
    verdicts.push_back(Atlas::Exact_validator(0).validate(chart, Atlas::Execution()));
    const CGAL::Bbox_2 box = CGAL::bbox_2(chart.uv.begin(), chart.uv.end());
    for (const Atlas::Point_2& p : chart.uv)
      points.emplace_back(p.x() - box.xmin() + left, p.y() - box.ymin(), 0);
    left += 1.1 * box.x_span();
    height = std::max(height, box.y_span());
  }
  Scene scene(0.006 * std::max(left, height));
  scene.set_points(points);
  Index first = 0;
  for (std::size_t c = 0; c < framed.size(); ++c) {
    const auto& [chart, is_border] = framed[c];
    for (Index t = 0; t < chart.number_of_triangles(); ++t) {
      const auto& zone = verdicts[c].culprits;
      const bool is_in_zone = std::binary_search(zone.begin(), zone.end(), t);
      const Atlas::Point_2 color = Palette::plain(is_in_zone ? Palette::red : int(c) + 1);
      std::array<Index, 3> corners = chart.triangles[t];
      for (Index& v : corners)
        v += first;
      scene.add_triangle(corners, {color, color, color});
      for (Index i = 0; i < 3; ++i)
        if (is_border[3 * t + i])
          scene.add_line(points[corners[i]], points[corners[(i + 1) % 3]], Palette::dark);
    }
    first += static_cast<Index>(chart.number_of_vertices());
  }
  Atlas::write_png(arguments.prefix + "_" + name + ".png", scene.picture({0, 0}, arguments.size));
  return verdicts;
}

/// Figure 6: what lies in a ball, and hangs together with the triangle nearest to its centre, is one chart.
void draw_overlap(const Atlas::Surface& surface, const Arguments& arguments, const Illustrator& illustrator)
{
  const Atlas::Point_3 centre(arguments.ball[0], arguments.ball[1], arguments.ball[2]);
  const auto distance = [&](Index t) { return CGAL::squared_distance(surface.point(3 * t), centre); };
  std::vector<Index> part(surface.number_of_triangles());
  Index nearest = 0;
  for (Index t = 0; t < part.size(); ++t) {
    part[t] = distance(t) < arguments.ball[3] * arguments.ball[3];
    nearest = distance(t) < distance(nearest) ? t : nearest;
  }
  Atlas::Segmentation segmentation{part, std::vector<std::uint8_t>(surface.opposite.size(), 0), 2};
  cut_to_discs(surface, segmentation);
  for (Index t = 0; t < part.size(); ++t)
    part[t] = segmentation.chart[t] == segmentation.chart[nearest];

  const auto draw_in_space = [&](const std::string& name) {
    std::vector<int> color;
    for (const Index p : part)
      color.push_back(p == 0 ? Palette::white : int(p));
    std::vector<std::uint8_t> is_line(surface.opposite.size());
    for (Index h = 0; h < is_line.size(); ++h)
      is_line[h] = !segmentation.is_glued(surface, h) &&
                   (part[h / 3] != 0 ||
                    (surface.opposite[h] != Atlas::no_index && part[surface.opposite[h] / 3] != 0));
    illustrator.draw(name, color, is_line, Palette::dark);
  };
  std::vector<Framed_chart> whole = charts_of_parts(surface, segmentation, part);
  draw_in_space("one_chart");
  const Atlas::Chart_verdict verdict = draw_flat(arguments, "overlap", whole).at(0);
  std::cout << "one chart: " << message(verdict.status) << '\n';
  if (verdict.is_valid())
    return;

  const std::vector<Index> parts = Atlas::Culprit_splitter().split(whole[0].chart, verdict);
  for (std::size_t t = 0; t < parts.size(); ++t)
    part[whole[0].chart.source[t]] = 1 + parts[t];
  std::vector<Framed_chart> split = charts_of_parts(surface, segmentation, part);
  draw_in_space("parts");
  for (const Atlas::Chart_verdict& v : draw_flat(arguments, "split", split))
    std::cout << "after the split: " << message(v.status) << '\n';
}

} // namespace

int main(int argc, char** argv)
try {
  CLI::App app("Draws how the segmentation of the LSCM paper works on a mesh");
  Arguments arguments;
  app.add_option("MESH", arguments.mesh, "The mesh: .obj, .off, .ply, .stl, .gltf or .glb")->required();
  app.add_option("-o,--output", arguments.prefix, "Pictures are named so, and after what they show")
      ->required();
  app.add_option("--size", arguments.size, "Side of the pictures in pixels")->capture_default_str();
  app.add_option("--up", arguments.up, "The axis that points up")
      ->check(CLI::IsMember({"x", "y", "z", "-x", "-y", "-z"}))
      ->capture_default_str();
  app.add_option("--azimuth", arguments.view.azimuth, "Where the camera stands, degrees");
  app.add_option("--elevation", arguments.view.elevation, "How high it stands, degrees");
  app.add_option("--ball", arguments.ball, "x y z radius, after turning up: the part to be one chart")
      ->expected(4);
  app.add_option("--sharp-edges", arguments.segmentation.features.sharp_edge_share, "Share of sharp edges")
      ->capture_default_str();
  app.add_option("--contrast", arguments.segmentation.features.min_contrast,
                 "Sharp edges are so many times as sharp as the median")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  Atlas::Polygon_soup soup = Atlas::read_polygon_soup(arguments.mesh);
  soup.points = stand_up(std::move(soup.points), arguments.up);
  const Atlas::Surface surface = Atlas::build_surface(soup.points, soup.first, soup.vertices);
  const Illustrator illustrator(surface, arguments);
  if (arguments.ball.empty())
    draw_segmentation(surface, arguments.segmentation, illustrator);
  else
    draw_overlap(surface, arguments, illustrator);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
