// SPDX-License-Identifier: MIT
// Tables 1 and 2 of the paper.
#include <Atlas/generate_atlas.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/packing/Horizon_packer.h>
#include <Atlas/packing/internal/pages/least_page.h>
#include <Atlas/packing/pack_charts.h>
#include <Atlas/parameterization/Distortion_optimizer.h>
#include <Atlas/parameterization/Fixed_border_parameterizer.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/validation/Stencil_validator.h>

#include "paper_results.h"
#include <algorithm>
#include <array>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>

namespace {

using Atlas::Point_2;

/// A row of cells of an HTML table.
template <typename... Cells>
void write_row(std::ostream& html, const Cells&... cells)
{
  html << "<tr>";
  ((html << "<td>" << cells << "</td>"), ...);
  html << "</tr>\n";
}

std::string shown(double value, int decimals = 2)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals) << value;
  return text.str();
}

/// What one pipeline made of a mesh: a column of Table 2.
struct Column
{
  std::string title;
  std::size_t charts = 0;
  std::optional<std::size_t> small_charts;       ///< of less than 20 triangles
  double segmentation = 0, parameterization = 0; ///< seconds
  double rectangles = 0, horizon = 0;            ///< packing ratios
  double stretch_before = 0, stretch_after = 0;
  std::string verdict;
};

/// The numbers that the paper prints.
const std::map<std::string, Column> printed = {
    {"dinosaur", {"paper", 43, {}, 8, 10, 0.48, 0.55, 2.9, 1.26, "-"}},
    {"skull", {"paper", 40, {}, 17, 23, 0.51, 0.55, 2.5, 1.55, "-"}},
    {"bunny", {"paper", 23, {}, 30, 95, 0.43, 0.6, 1.16, 1.14, "-"}},
    {"horse", {"paper", 44, {}, 43, 190, 0.37, 0.58, 1.14, 1.12, "-"}}};

/// The part of the enclosing rectangle that the charts cover.
double packing_ratio(const Atlas::Surface& surface, const std::vector<Point_2>& uv)
{
  double area = 0;
  std::optional<CGAL::Bbox_2> box;
  for (std::size_t t = 0; t < surface.number_of_triangles(); ++t) {
    const Point_2 &a = uv[surface.corner[3 * t]], &b = uv[surface.corner[3 * t + 1]],
                  &c = uv[surface.corner[3 * t + 2]];
    area += std::abs(CGAL::area(a, b, c));
    const CGAL::Bbox_2 here = a.bbox() + b.bbox() + c.bbox();
    box = box ? *box + here : here;
  }
  return box ? area / (box->x_span() * box->y_span()) : 0;
}

/// The same charts in the enclosing rectangle of least area that a packer finds.
double ratio_of(const Atlas::Surface& surface, const std::vector<Point_2>& uv,
                const Atlas::Any_packer& packer)
{
  const Atlas::Execution execution;
  Atlas::Page_options page;
  const std::vector<Atlas::Chart> charts = Atlas::pack_charts(surface, uv, page, packer).charts;
  page = Atlas::internal::least_page(charts, page, packer, execution);
  return packing_ratio(surface, Atlas::pack_charts(surface, uv, page, packer).uv);
}

/// What a pipeline with the optimisation of stretch makes of a mesh.
template <typename Parameters>
Column run(const std::string& title, const Atlas::Surface& surface, const Parameters& with,
           std::vector<Point_2>& uv, Atlas::Atlas_report& report)
{
  report = generate_atlas(surface, uv, with.optimizer(Atlas::Stretch_optimizer()));
  Column column{title, report.charts.size(), 0, 0, 0, 0, 0, 0, 0, message(report.certificate)};
  for (const Atlas::Chart_report& chart : report.charts)
    *column.small_charts += chart.triangles < 20;
  column.segmentation = report.seconds[static_cast<std::size_t>(Atlas::Stage::segmentation)];
  column.parameterization = report.seconds[static_cast<std::size_t>(Atlas::Stage::parameterization)];
  column.rectangles = ratio_of(surface, uv, Atlas::Row_packer());
  column.horizon = ratio_of(surface, uv, Atlas::Horizon_packer());
  column.stretch_before = report.unoptimized.l2_stretch;
  column.stretch_after = report.distortion.l2_stretch;
  std::cerr << title << ": " << column.charts << " charts\n";
  return column;
}

void write_columns(std::ostream& html, const Named_mesh& mesh, const std::vector<Column>& columns)
{
  html << "<h3>" << mesh.name << ": " << mesh.surface.points.size() << " vertices, "
       << mesh.surface.number_of_faces << " facets</h3>\n<table>";
  const auto row = [&](const char* title, const auto& cell) {
    html << "<tr><th>" << title << "</th>";
    for (const Column& c : columns)
      html << "<td>" << cell(c) << "</td>";
    html << "</tr>\n";
  };
  row("", [](const Column& c) { return c.title; });
  row("charts", [](const Column& c) { return c.charts; });
  row("of less than 20 triangles",
      [](const Column& c) { return c.small_charts ? std::to_string(*c.small_charts) : std::string("-"); });
  row("segmentation time (s)", [](const Column& c) { return shown(c.segmentation); });
  row("parameterization time (s)", [](const Column& c) { return shown(c.parameterization); });
  row("packing ratio (rectangles)", [](const Column& c) { return shown(c.rectangles); });
  row("packing ratio (horizon)", [](const Column& c) { return shown(c.horizon); });
  row("stretch (before optim.)", [](const Column& c) { return shown(c.stretch_before, 3); });
  row("stretch (after optim.)", [](const Column& c) { return shown(c.stretch_after, 3); });
  row("certificate", [](const Column& c) { return c.verdict; });
  html << "</table>\n";
}

std::string stretch_of(const Atlas::Chart& chart, Atlas::Chart_status status)
{
  const std::string text = shown(measure_distortion(chart).l2_stretch, 3);
  return status == Atlas::Chart_status::valid ? text : text + " (" + message(status) + ")";
}

/// A row of Table 1: a map, and its stretch before and after the optimisation with its border fixed and free.
template <typename Parameterizer>
void write_map(std::ostream& html, const char* title, Atlas::Chart chart, const Parameterizer& parameterizer)
{
  const Atlas::Execution execution;
  const Atlas::Chart_status status = parameterizer.parameterize(chart, execution);
  const std::string before = stretch_of(chart, status);
  Atlas::Chart fixed = chart;
  Atlas::Distortion_options keeping;
  keeping.keeps_border = true;
  const Atlas::Chart_status fixed_status = Atlas::Stretch_optimizer(keeping).optimize(fixed, execution);
  const Atlas::Chart_status free_status = Atlas::Stretch_optimizer().optimize(chart, execution);
  write_row(html, title, before, stretch_of(fixed, fixed_status), stretch_of(chart, free_status));
}

} // namespace

void write_table_1(const Named_mesh& mesh, const std::vector<double>& ball, const Paper_options& options)
{
  const Atlas::Chart chart = chart_of_part(mesh.surface, ball);
  std::ofstream html(options.folder / "table_1.html");
  html << "<p>" << mesh.name << ": one chart of " << chart.number_of_triangles()
       << " triangles. Printed: harmonic maps 3.2 before and 1.65 after, LSCM 3.5 and 1.52.</p>\n<table>";
  write_row(html, "", "stretch (before optim.)", "after, border fixed", "after, border free");
  write_map(html, "Harmonic maps", chart, Atlas::Harmonic_parameterizer());
  write_map(html, "Mean value coordinates", chart, Atlas::Mean_value_parameterizer());
  write_map(html, "LSCM", chart, Atlas::LSCM_parameterizer<>());
  html << "</table>\n";
}

void write_table_2(const std::vector<Named_mesh>& meshes, const Paper_options& options)
{
  using namespace Atlas;
  std::ofstream html(options.folder / "table_2.html");
  for (const Named_mesh& mesh : meshes) {
    std::vector<Column> columns;
    // NAME_STANDIN has the numbers of NAME beside its own.
    if (const auto at = printed.find(mesh.name.substr(0, mesh.name.find('_'))); at != printed.end())
      columns.push_back(at->second);
    std::vector<Point_2> uv;
    Atlas_report report;
    const auto letter = parameters::mode(Atlas_mode::paper).number_of_threads(options.threads);
    const auto standard = parameters::number_of_threads(options.threads);
    const Column last = run("Atlas, default", mesh.surface, standard, uv, report);
    const Column any_areas =
        run("letter, without the rule on areas", mesh.surface,
            letter.validator(Stencil_validator(default_stencil_resolution, 0)), uv, report);
    columns.push_back(run("letter", mesh.surface, letter.validator(Stencil_validator()), uv, report));
    columns.push_back(any_areas);
    columns.push_back(last);
    write_columns(html, mesh, columns);
    draw_results(mesh, uv, report, options);
  }
}
