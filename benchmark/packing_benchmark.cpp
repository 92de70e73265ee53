// SPDX-License-Identifier: MIT
// Prints the table of the manual: efficiency and time of each packer on the charts of meshes.
//
// Usage: packing_benchmark [--size TEXELS] [--gutter TEXELS] [--packers NAME,...] [--pictures PREFIX]
// FILE.obj... Packers are rectangles, horizon, fast, normal and best; all of them unless some are named. A
// file with texture coordinates is packed anew as it is; the charts of any other are made by the default
// segmentation and flattening. With --pictures nothing is measured: the page of each packer for the first
// file, which needs coordinates, becomes PREFIX_rectangles.png, ..., PREFIX_best.png.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/image/Image.h>
#include <Atlas/image/pages.h>
#include <Atlas/packing/Horizon_packer.h>
#include <Atlas/packing/Raster_packer.h>
#include <Atlas/packing/pack_charts.h>
#include <Atlas/pipeline/presets.h>
#include <Atlas/segmentation/cut_to_discs.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace {

using namespace Atlas;

double area_in_plane(const Chart& chart)
{
  double sum = 0;
  for (const auto& [a, b, c] : chart.triangles)
    sum += std::abs(CGAL::area(chart.uv[a], chart.uv[b], chart.uv[c]));
  return sum;
}

/// Charts of a mesh without coordinates, each with its area in space.
std::vector<Chart> flattened_charts(const Surface& surface, const Execution& execution)
{
  const Policies policies = preset();
  Segmentation segmentation = policies.segmentation.segment(surface, execution);
  cut_to_discs(surface, segmentation, execution);
  std::vector<Chart> charts;
  for (Chart& chart : extract_charts(surface, segmentation)) {
    const Chart_status status = policies.parameterizer.parameterize(chart, execution);
    const double plane = status == Chart_status::valid ? area_in_plane(chart) : 0;
    if (!(plane > 0))
      continue;
    double space = 0;
    for (const auto& [a, b, c] : chart.triangles)
      space += std::sqrt(CGAL::squared_area(chart.points[a], chart.points[b], chart.points[c]));
    const double scale = std::sqrt(space / plane);
    for (Point_2& p : chart.uv)
      p = Point_2(scale * p.x(), scale * p.y());
    charts.push_back(std::move(chart));
  }
  return charts;
}

/// Hands over what it is given: to get at the charts of `pack_charts()`.
struct No_packer
{
  Packing pack(std::span<const Chart> charts, const Page_options&, const Execution&) const
  {
    return {std::vector<Placement>(charts.size()), 1, 1, 0};
  }
};

std::vector<Chart> charts_of_file(const std::string& file, const Execution& execution)
{
  const Polygon_soup soup = read_polygon_soup(file);
  const Surface surface = build_surface(soup.points, soup.first, soup.vertices);
  if (soup.uv.empty())
    return flattened_charts(surface, execution);
  return pack_charts(surface, soup.uv, {}, No_packer(), execution).charts;
}

using Pack =
    std::function<Packing(std::span<const Chart>, const Page_options& page, const Execution& execution)>;

template <typename Packer>
Pack pack_by(const Packer& packer)
{
  return [packer](auto... arguments) { return packer.pack(arguments...); };
}

struct Named_packer
{
  std::string name;
  Pack pack;
};

std::vector<Named_packer> all_packers()
{
  return {{"rectangles", pack_by(Rectangle_packer())},
          {"horizon", pack_by(Horizon_packer())},
          {"fast", pack_by(Raster_packer(Packing_effort::fast))},
          {"normal", pack_by(Raster_packer(Packing_effort::normal))},
          {"best", pack_by(Raster_packer(Packing_effort::best))}};
}

/// Packs and prints two columns: efficiency, seconds; a mark where the gutter is not kept.
double run(const Pack& pack, const std::vector<Chart>& charts, const Page_options& page,
           const Execution& execution)
{
  const auto start = std::chrono::steady_clock::now();
  const Packing packing = pack(charts, page, execution);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  double area = 0;
  for (const Chart& chart : charts)
    area += area_in_plane(chart);
  const double efficiency = area * packing.density * packing.density / (double(page.width) * page.height);
  const Packing_clearance clearance = packing_clearance(charts, packing, page, page.gutter);
  const bool is_kept = clearance.charts >= page.gutter && clearance.border >= page.gutter / 2;
  std::printf(" | %.3f %6.2f s%s", efficiency, seconds.count(), is_kept ? " " : "!");
  std::fflush(stdout);
  return efficiency;
}

/// Draws the page that a packer makes of the coordinates of a mesh.
template <typename Packer>
void draw(const Packer& packer, Polygon_soup soup, const Surface& surface, const Page_options& page,
          const std::string& picture, const Execution& execution)
{
  const Repacked_charts repacked = pack_charts(surface, soup.uv, page, packer, execution);
  soup.uv = repacked.uv;
  std::vector<Index> face_chart(soup.number_of_faces(), no_index);
  for (std::size_t t = 0; t < surface.number_of_triangles(); ++t)
    face_chart[surface.face[t]] = repacked.segmentation.chart[t];
  write_png(picture, draw_atlas(soup, face_chart, 512));
}

void draw_all(const std::string& file, const std::string& prefix, const Page_options& page,
              const Execution& execution)
{
  const Polygon_soup soup = read_polygon_soup(file);
  const Surface surface = build_surface(soup.points, soup.first, soup.vertices);
  const auto draw_one = [&](const auto& packer, const char* name) {
    draw(packer, soup, surface, page, prefix + "_" + name + ".png", execution);
  };
  draw_one(Rectangle_packer(), "rectangles");
  draw_one(Horizon_packer(), "horizon");
  draw_one(Raster_packer(Packing_effort::fast), "fast");
  draw_one(Raster_packer(Packing_effort::best), "best");
}

/// Packer x input, and the means over all files.
void print_table(const std::vector<std::string>& files, const std::vector<Named_packer>& packers,
                 const Page_options& page, const Execution& execution)
{
  std::printf("%-24s charts", "input");
  for (const Named_packer& packer : packers)
    std::printf(" | %-16s", packer.name.c_str());
  std::vector<double> sums(packers.size(), 0);
  for (const std::string& file : files) {
    const std::vector<Chart> charts = charts_of_file(file, execution);
    std::printf("\n%-24s %6zu", std::filesystem::path(file).stem().string().c_str(), charts.size());
    for (std::size_t k = 0; k < packers.size(); ++k)
      sums[k] += run(packers[k].pack, charts, page, execution);
  }
  std::printf("\n%-31s", "mean");
  for (const double sum : sums)
    std::printf(" | %.3f           ", sum / static_cast<double>(files.size()));
  std::printf("\n");
}

} // namespace

int main(int argc, char** argv)
try {
  Page_options page;
  std::vector<std::string> files;
  std::string pictures, names;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--size" && i + 1 < argc)
      page.width = page.height = static_cast<Index>(std::strtoul(argv[++i], nullptr, 10));
    else if (argument == "--gutter" && i + 1 < argc)
      page.gutter = std::strtod(argv[++i], nullptr);
    else if (argument == "--packers" && i + 1 < argc)
      names = "," + std::string(argv[++i]) + ",";
    else if (argument == "--pictures" && i + 1 < argc)
      pictures = argv[++i];
    else
      files.push_back(argument);
  }
  if (files.empty()) {
    std::fprintf(stderr, "usage: packing_benchmark [--size TEXELS] [--gutter TEXELS] [--packers NAME,...] "
                         "[--pictures PREFIX] FILE...\n");
    return 2;
  }
  const Execution execution(0);
  if (!pictures.empty()) {
    draw_all(files.front(), pictures, page, execution);
    return 0;
  }
  std::vector<Named_packer> packers = all_packers();
  if (!names.empty())
    std::erase_if(packers, [&](const Named_packer& packer) {
      return names.find("," + packer.name + ",") == std::string::npos;
    });
  print_table(files, packers, page, execution);
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "packing_benchmark: %s\n", e.what());
  return 2;
}
