// SPDX-License-Identifier: MIT
// Table 1 of the LSCM paper, on any chart: the L2 stretch of harmonic maps and of LSCM before and after its
// optimisation; what the way the chart is cut open costs any conformal map; and the time and result of the
// default parameterizer.
//
// Usage: polish_benchmark CHART.obj   (a disc, such as the paper's cow head)
#include <Atlas/core/build_surface.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>
#include <Atlas/parameterization/Distortion_optimizer.h>
#include <Atlas/parameterization/Fixed_border_parameterizer.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/parameterization/Spectral_parameterizer.h>
#include <Atlas/parameterization/internal/conformal/conformal_energy.h>
#include <Atlas/parameterization/internal/distortion/distortion_energy.h>
#include <Atlas/parameterization/internal/geometry/border.h>

#include <CGAL/IO/polygon_soup_io.h>

#include <Eigen/SparseCholesky>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace Atlas;

/// L2 stretch of Sander et al. 2001 after scaling to equal areas; 1 is the least.
double l2_stretch(const Chart& chart)
{
  const internal::Chart_geometry geometry(chart);
  double sum = 0, space = 0, plane = 0;
  for (const auto& [corner, rest] : [&] {
         std::vector<std::pair<std::array<Index, 3>, internal::Rest_triangle>> both;
         const auto all = internal::rest_triangles(geometry, internal::least_relative_height);
         for (std::size_t t = 0; t < all.size(); ++t)
           both.emplace_back(chart.triangles[t], all[t]);
         return both;
       }()) {
    const auto at = [&](Index v) {
      return internal::Complex(geometry.from_model(chart.uv[v].x()), geometry.from_model(chart.uv[v].y()));
    };
    const auto [f, g] = internal::derivative(rest, at(corner[0]), at(corner[1]), at(corner[2]));
    const double det = std::norm(f) - std::norm(g);
    sum += rest.area * (std::norm(f) + std::norm(g)) / (det * det);
    space += rest.area;
    plane += rest.area * det;
  }
  return std::sqrt(sum * plane) / space;
}

/// L2 stretch of the smooth conformal map whose scale e^u is the same all along the border, from the discrete
/// Yamabe equation: Laplace u = Gauss curvature, u = 0 on the border. All other conformal maps differ by a
/// harmonic u, so this tells what the way a chart is cut open costs, whatever the pins.
double stretch_of_conformal_map(const Chart& chart)
{
  const internal::Chart_geometry geometry(chart);
  const internal::Conformal_matrix h = internal::Conformal_energy(geometry).matrix();
  const std::vector<bool> is_border = internal::border_vertices(chart);
  std::vector<double> area(h.size(), 0);
  Eigen::VectorXd curvature = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(h.size()), 2 * M_PI);
  for (Index t = 0; t < geometry.number_of_triangles(); ++t)
    for (int i = 0; i < 3; ++i) {
      const auto& corner = chart.triangles[t];
      const auto p = geometry.edge(corner[i], corner[(i + 1) % 3]),
                 q = geometry.edge(corner[i], corner[(i + 2) % 3]);
      curvature[corner[i]] -= std::atan2(geometry.double_area(t), internal::Chart_geometry::dot(p, q));
      area[corner[i]] += geometry.double_area(t) / 6;
    }
  std::vector<Eigen::Triplet<double>> entries;
  for (Index v = 0; v < h.size(); ++v) {
    if (is_border[v])
      curvature[v] = 0;
    entries.emplace_back(v, v, is_border[v] ? 1 : h.diagonal[v]);
    for (std::size_t k = h.first[v]; k < h.first[v + 1]; ++k)
      if (!is_border[v] && !is_border[h.neighbor[k]])
        entries.emplace_back(v, h.neighbor[k], h.re[k]);
  }
  Eigen::SparseMatrix<double> matrix(curvature.size(), curvature.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd factor = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(curvature);
  double sum = 0, space = 0, plane = 0;
  for (Index v = 0; v < h.size(); ++v) {
    space += area[v];
    plane += area[v] * std::exp(2 * factor[v]);
    sum += area[v] * std::exp(-2 * factor[v]);
  }
  return std::sqrt(sum * plane) / space;
}

void print_table_1(const Chart& original)
{
  std::printf("%-28s %14s %14s\n", "stretch", "before optim.", "after optim.");
  const auto row = [&](const char* name, const auto& parameterizer) {
    Chart chart = original;
    if (parameterizer.parameterize(chart, Execution()) != Chart_status::valid)
      return (void)std::printf("%-28s %14s\n", name, "-");
    const double before = l2_stretch(chart);
    const Chart_status status = Stretch_optimizer().optimize(chart, Execution());
    std::printf("%-28s %14.4g %14.4g   %s\n", name, before, l2_stretch(chart), message(status));
  };
  row("Harmonic map", Harmonic_parameterizer());
  row("LSCM", LSCM_parameterizer<>());
  row("Spectral conformal map", Spectral_parameterizer<>());
  std::printf("%-28s %14.4g\n", "conformal, equal border", stretch_of_conformal_map(original));
}

void print_default(const Chart& original)
{
  Chart chart = original;
  Flattening_record record;
  const auto start = std::chrono::steady_clock::now();
  const Chart_status status = Bijective_parameterizer().parameterize(chart, Execution(), record);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  std::printf("default: %s, %s; %zu iterations, symmetric Dirichlet %.6g -> %.6g, %.3g s\n", message(status),
              message(record.start), record.distortion.iterations, record.distortion.before,
              record.distortion.after, time.count());
}

} // namespace

int main(int argc, char** argv)
{
  std::vector<Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  if (argc != 2 || !CGAL::IO::read_polygon_soup(argv[1], points, polygons)) {
    std::fprintf(stderr, "usage: polish_benchmark CHART.obj\n");
    return 1;
  }
  std::vector<std::size_t> first{0};
  std::vector<Index> vertices;
  for (const auto& polygon : polygons) {
    vertices.insert(vertices.end(), polygon.begin(), polygon.end());
    first.push_back(vertices.size());
  }
  const Surface surface = build_surface(points, first, vertices);
  const Segmentation whole{std::vector<Index>(surface.number_of_triangles(), 0),
                           std::vector<std::uint8_t>(3 * surface.number_of_triangles(), 0), 1};
  const std::vector<Chart> charts = extract_charts(surface, whole);
  if (!topology(charts.front()).is_disc()) {
    std::fprintf(stderr, "%s is not a disc\n", argv[1]);
    return 1;
  }
  print_table_1(charts.front());
  print_default(charts.front());
}
