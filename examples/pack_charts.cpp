// SPDX-License-Identifier: MIT
// Packing alone: charts that were flattened elsewhere, here regular polygons of many sizes, find their places
// on a page.
#include <Atlas/packing/Horizon_packer.h>

#include <cmath>
#include <iostream>
#include <vector>

/// A fan of n triangles; only `uv` and `triangles` matter to a packer.
Atlas::Chart regular_polygon(Atlas::Index n, double radius)
{
  Atlas::Chart chart;
  chart.uv.emplace_back(0, 0);
  for (Atlas::Index i = 0; i < n; ++i) {
    const double angle = 2 * CGAL_PI * i / n;
    chart.uv.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    chart.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  return chart;
}

template <Atlas::ChartPacker Packer>
double pack_and_report(const char* name, const Packer& packer, const std::vector<Atlas::Chart>& charts)
{
  Atlas::Page_options page;
  page.width = page.height = 512;
  page.gutter = 4;
  const Atlas::Packing packing = packer.pack(charts, page, Atlas::Execution());
  const Atlas::Point_2 centre = packing.placements[0](Atlas::Point_2(0, 0));
  std::cout << name << ": " << packing.number_of_pages << " page, " << packing.density
            << " texels per unit, the first chart is centred at texel " << centre << '\n';
  return packing.density;
}

int main()
{
  std::vector<Atlas::Chart> charts;
  for (Atlas::Index i = 0; i < 40; ++i)
    charts.push_back(regular_polygon(3 + i % 5, 1 + i % 7));
  const double rectangles = pack_and_report("bounding rectangles", Atlas::Rectangle_packer(), charts);
  const double horizon = pack_and_report("horizon", Atlas::Horizon_packer(), charts);
  return rectangles > 0 && horizon > 0 ? 0 : 1;
}
