// SPDX-License-Identifier: MIT
// A packer of one's own: an engine that stands the bounding boxes of pieces side by side on shelves. Pages,
// the gutter, a density, groups and locked charts are the library's.
#include <Atlas/packing/Page_packer.h>
#include <Atlas/packing/pack_charts.h>

#include <algorithm>
#include <complex>
#include <cstddef>
#include <iostream>
#include <optional>
#include <vector>

using Complex = std::complex<double>;

/// A model of `PageEngine`: tries smaller and smaller scales.
struct Shelf_engine
{
  std::optional<Atlas::Page_layout> lay_out(const Atlas::Page_task& task, const Atlas::Execution&) const
  {
    const Complex gap(task.margin, task.margin);
    const std::vector<Complex> upright(task.pieces.size(), 1), nowhere;
    Atlas::Page_layout layout{task.largest_scale(), task.margin, upright, nowhere};
    for (; layout.scale > 1e-6; layout.scale *= 0.99, layout.positions.clear()) {
      Complex corner = 0;
      double top = 0, right = 0; // what the shelves take
      for (const Atlas::Page_piece& piece : task.pieces) {
        const auto [low, high] = piece.box();
        const Complex size = layout.scale * (high - low) + 2.0 * gap;
        corner = corner.real() + size.real() > task.width ? Complex(0, top) : corner;
        layout.positions.push_back(corner + gap - layout.scale * low);
        corner += size.real();
        top = std::max(top, corner.imag() + size.imag());
        right = std::max(right, corner.real());
      }
      if (right <= task.width && top <= task.height)
        return layout;
    }
    return std::nullopt;
  }
};

/// A triangle; only `uv` and `triangles` matter to a packer.
Atlas::Chart triangle(double width, double height)
{
  Atlas::Chart chart;
  chart.uv = {{0, 0}, {width, 0}, {0, height}};
  chart.triangles = {{0, 1, 2}};
  return chart;
}

int main()
{
  std::vector<Atlas::Chart> charts;
  for (int i = 0; i < 60; ++i)
    charts.push_back(triangle(1 + i % 4, 1 + i % 7));
  Atlas::Page_options page;
  page.width = page.height = 128;
  page.density = 12; // on as many pages as that takes
  page.locked.resize(charts.size());
  page.locked[0] = Atlas::Placement{30, 0, 2, 2}; // stays in the corner of the first page
  page.groups.assign(charts.size(), Atlas::no_index);
  page.groups[1] = page.groups[2] = 0; // lie on top of each other, and go on doing so
  const Atlas::Packing packing = Atlas::Page_packer(Shelf_engine()).pack(charts, page, Atlas::Execution());

  charts.erase(charts.begin() + 2);
  Atlas::Packing apart = packing;
  apart.placements.erase(apart.placements.begin() + 2);
  const Atlas::Packing_clearance clearance = Atlas::packing_clearance(charts, apart, page, 8);
  std::cout << packing.number_of_pages << " pages, " << packing.density << " texels per unit, charts are "
            << clearance.charts << " texels apart\n";
  return packing.number_of_pages > 1 && clearance.charts >= page.gutter && clearance.border >= page.gutter / 2
             ? 0
             : 1;
}
