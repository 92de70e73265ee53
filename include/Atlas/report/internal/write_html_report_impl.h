// SPDX-License-Identifier: MIT
#ifndef ATLAS_REPORT_INTERNAL_WRITE_HTML_REPORT_IMPL_H
#define ATLAS_REPORT_INTERNAL_WRITE_HTML_REPORT_IMPL_H

#include <Atlas/core/internal/library.h>
#include <Atlas/image/Image.h>
#include <Atlas/image/internal/Output_file.h>
#include <Atlas/image/internal/base64.h>
#include <Atlas/report/internal/Report_model.h>
#include <Atlas/report/internal/histogram_svg.h>
#include <Atlas/report/internal/report_page.h>
#include <Atlas/report/write_report.h>
#include <Atlas/soup/internal/face_distortion.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace Atlas {

namespace internal {

inline std::string escaped(std::string_view text)
{
  std::string result;
  for (const char c : text)
    switch (c) {
    case '<':
      result += "&lt;";
      break;
    case '>':
      result += "&gt;";
      break;
    case '&':
      result += "&amp;";
      break;
    case '"':
      result += "&quot;";
      break;
    default:
      result += c;
    }
  return result;
}

inline std::string replaced(std::string text, std::string_view what, std::string_view by)
{
  const std::size_t at = text.find(what);
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

template <typename Number>
std::string base64_of(const std::vector<Number>& numbers)
{
  return base64({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)});
}

inline std::string image_tag(const Image& image, const char* id)
{
  return std::string("<img id=\"") + id + "\" alt=\"" + id + "\" src=\"data:image/png;base64," +
         base64(png_bytes(image)) + "\">\n";
}

/// \brief Writes the page from top to bottom.
class Html_report
{
public:
  Html_report(const Polygon_soup& soup, const Atlas_report& report, const std::string& title)
      : soup_(soup), report_(report)
  {
    html_.precision(4);
    html_ << replaced(report_head, "@TITLE@", escaped(title));
    html_ << "<h1>" << escaped(title) << "</h1><p><span class=\"verdict "
          << (report.is_valid() ? "valid" : "invalid") << "\">" << (report.is_valid() ? "valid" : "not valid")
          << "</span> " << escaped(message(report.certificate)) << "</p>\n";
    write_cards();
  }

  std::string text(const Report_pictures& pictures)
  {
    const Report_model model(soup_, report_.face_chart);
    write_view(model, pictures);
    write_worst(model);
    html_ << "<div class=\"two\">";
    write_histograms();
    write_tables();
    html_ << "</div>\n";
    write_sides(pictures.view);
    write_rejected();
    html_ << "</main></body></html>\n";
    return html_.str();
  }

private:
  using Rows = std::vector<std::pair<std::string, std::string>>;

  template <typename Value>
  static std::string shown(const Value& value, const char* unit = "")
  {
    std::ostringstream stream;
    stream.precision(4);
    stream << value << unit;
    return stream.str();
  }

  /// The figures that one looks for first.
  void write_cards()
  {
    const auto card = [&](const std::string& value, const char* what) {
      html_ << "<div><strong>" << value << "</strong><span>" << what << "</span></div>";
    };
    html_ << "<div class=\"cards\">";
    card(shown(report_.charts.size()), "charts");
    card(shown(report_.area > 0 ? report_.seam_length / std::sqrt(report_.area) : 0),
         "seam length over the root of the area");
    card(shown(report_.distortion.symmetric_dirichlet_mean), "mean distortion; 1 is none");
    card(shown(report_.charts_beyond_bound), "charts beyond their bound");
    card(shown(100 * report_.packing_efficiency, " %"), "of the page is used");
    card(shown(report_.total_seconds(), " s"), "of work");
    html_ << "</div>\n";
  }

  void write_sides(const Image& view)
  {
    html_ << "<section><h2>From several sides</h2>" << image_tag(view, "sides") << "</section>\n";
  }

  void write_view(const Report_model& model, const Report_pictures& pictures)
  {
    std::ostringstream data;
    data << "{linked:" << (report_.charts.empty() ? "false" : "true")
         << ",squares:" << std::max<Index>(report_.page_width / 16, 2)
         << ",many:900000,density:" << model.density << ",positions:\"" << base64_of(model.positions)
         << "\",uv:\"" << base64_of(model.uv) << "\",charts:\"" << base64_of(model.charts) << "\",indices:\""
         << base64_of(model.indices) << "\",seams:\"" << base64_of(model.seams) << "\",about:[";
    for (const Chart_report& chart : report_.charts)
      data << "\"" << about(chart) << "\",";
    data << "]}";
    const std::string page = image_tag(pictures.page, "page") + image_tag(pictures.stretch, "stretch");
    html_ << replaced(replaced(report_view, "@PAGE@", page), "@DATA@", data.str());
  }

  static std::string about(const Chart_report& chart)
  {
    return shown(chart.triangles) + " triangles, mean distortion " +
           shown(chart.distortion.symmetric_dirichlet_mean) + ", stretch " + shown(chart.stretch) +
           (chart.is_within_bound ? "" : std::string(", beyond its bound: ") + message(chart.reason));
  }

  /// The charts with the worst spots; a click shows them.
  void write_worst(const Report_model& model)
  {
    constexpr std::size_t shown_at_most = 12;
    const std::vector<Worst_spot> spots = worst_spots(model, soup_, report_, shown_at_most);
    if (spots.empty())
      return;
    html_ << "<section><h2>Where it is stretched most</h2><table><tr><th>chart</th>"
             "<th class=\"number\">triangles</th><th class=\"number\">mean distortion</th>"
             "<th class=\"number\">stretch</th><th>bound</th></tr>";
    for (const Worst_spot& spot : spots)
      write_spot(spot, report_.charts[spot.chart]);
    html_ << "</table><p class=\"note\">Click a chart to look at its worst spot. Its stretch is that of "
          << 100 * std::min(report_.bound.stretch_share, 1.0) << " % of its area.</p></section>\n";
  }

  void write_spot(const Worst_spot& spot, const Chart_report& chart)
  {
    html_ << "<tr class=\"chart\" data-chart=\"" << spot.chart << "\" data-place=\"[";
    for (const auto& vector : {spot.center, spot.normal})
      for (const double x : vector)
        html_ << x << ',';
    html_ << std::max(spot.radius, 1e-3) << "]\"><td>" << spot.chart << "</td>";
    for (const std::string& number :
         {shown(chart.triangles), shown(chart.distortion.symmetric_dirichlet_mean), shown(chart.stretch)})
      html_ << "<td class=\"number\">" << number << "</td>";
    html_ << "<td>" << (chart.is_within_bound ? "kept" : message(chart.reason)) << "</td></tr>";
  }

  void write_histograms()
  {
    const Soup_distortion distortion = measure_distortion(soup_);
    if (distortion.face.empty())
      return;
    html_ << "<section><h2>Angles: by how much right angles are off, degrees</h2>"
          << histogram_svg(angle_histogram(distortion), {"0", "15", "30", "45"})
          << "<h2>Areas: area on the page over its fair share</h2>"
          << histogram_svg(area_histogram(distortion), {"1/4", "1/2", "1", "2", "4"})
          << "<p class=\"note\">Bars are shares of the area of the surface.</p></section>\n";
  }

  void write_table(const Rows& rows)
  {
    html_ << "<table class=\"figures\">";
    for (const auto& [name, value] : rows)
      html_ << "<tr><td>" << name << "</td><td>" << value << "</td></tr>";
    html_ << "</table>\n";
  }

  void write_tables()
  {
    const Distortion& d = report_.distortion;
    const Atlas_certificate& c = report_.certificate;
    Rows rows = {
        {"vertices", shown(soup_.points.size())},
        {"faces", shown(report_.faces)},
        {"charts", shown(report_.charts.size())},
        {"pages", shown(report_.pages)},
        {"page, texels", shown(report_.page_width) + " &times; " + shown(report_.page_height)},
        {"stretch L<sub>2</sub>, L<sub>&infin;</sub>", shown(d.l2_stretch) + ", " + shown(d.linf_stretch)},
        {"mean &sigma;<sub>1</sub>/&sigma;<sub>2</sub>", shown(d.quasi_conformal_mean)},
        {"mean change of area", shown(d.area_mean)},
        {"page covered", shown(100 * report_.packing_efficiency, " %")},
        {"flipped triangles", shown(c.flipped)},
        {"flat triangles", shown(c.degenerate)},
        {"overlapping pairs", shown(c.overlaps_in_charts + c.overlaps_between_charts)},
        {"charts apart, texels", report_.charts.size() > 1 ? shown(c.chart_distance) : "one chart"},
        {"from the border, texels", shown(c.page_border_distance)}};
    for (const Stage stage : all_stages)
      if (report_.total_seconds() > 0) // else no time has been taken
        rows.emplace_back(name(stage), shown(report_.seconds[static_cast<std::size_t>(stage)], " s"));
    html_ << "<section><h2>Figures</h2>";
    write_table(rows);
    html_ << "</section>";
  }

  void write_rejected()
  {
    if (report_.rejected.empty())
      return;
    constexpr std::size_t shown_at_most = 1000;
    html_ << "<section><h2>Faces that take no part (" << report_.rejected.size() << ", counting from 0)</h2>";
    Rows rows;
    for (std::size_t i = 0; i < std::min(report_.rejected.size(), shown_at_most); ++i)
      rows.emplace_back("face " + shown(report_.rejected[i].face), message(report_.rejected[i].reason));
    write_table(rows);
    html_ << "</section>\n";
  }

  const Polygon_soup& soup_;
  const Atlas_report& report_;
  std::ostringstream html_;
};

} // namespace internal

ATLAS_INLINE std::string html_report(const Polygon_soup& soup, const Atlas_report& report,
                                     const Report_pictures& pictures, const std::string& title)
{
  return internal::Html_report(soup, report, title).text(pictures);
}

ATLAS_INLINE void write_html_report(const std::filesystem::path& path, const Polygon_soup& soup,
                                    const Atlas_report& report, const Report_pictures& pictures,
                                    const std::string& title)
{
  internal::write_whole_file(path, html_report(soup, report, pictures, title));
}

} // namespace Atlas

#endif
