// SPDX-License-Identifier: MIT
// Chart size x solver: time, memory, residual and energy of LSCM, beside CGAL's in the same run.
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/parameterization/internal/conformal/conformal_energy.h>
#include <Atlas/parameterization/internal/conformal/hermitian_ldlt.h>
#include <Atlas/parameterization/internal/conformal/hermitian_multifrontal.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <utility>
#include <vector>
#ifdef ATLAS_WITH_CHOLMOD
#include <Atlas/parameterization/Cholmod_LSCM_traits.h>
#endif

namespace {

using namespace Atlas;

/// A wavy height field of n vertices or a few more.
Chart wavy_chart(std::int64_t n)
{
  const Index side = static_cast<Index>(std::ceil(std::sqrt(static_cast<double>(n))));
  Chart chart;
  for (Index j = 0; j < side; ++j)
    for (Index i = 0; i < side; ++i) {
      const double x = static_cast<double>(i) / (side - 1), y = static_cast<double>(j) / (side - 1);
      chart.points.emplace_back(x, y, 0.1 * std::sin(9 * x) * std::cos(7 * y));
    }
  for (Index j = 0; j + 1 < side; ++j)
    for (Index i = 0; i + 1 < side; ++i) {
      const Index a = j * side + i, b = a + 1, c = a + side, d = c + 1;
      chart.triangles.push_back({a, b, d});
      chart.triangles.push_back({a, d, c});
    }
  return chart;
}

/// A line of /proc/self/status in MB; 0 where there is no such file.
double memory(const std::string& name)
{
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == name + ":") {
      double kilobytes = 0;
      status >> kilobytes;
      return kilobytes / 1024;
    }
  return 0;
}

/// Peak memory above what there was at construction. Linux resets the peak on request.
class Peak_memory
{
public:
  Peak_memory()
  {
    std::ofstream("/proc/self/clear_refs") << 5;
    before_ = memory("VmRSS");
  }
  double megabytes() const { return memory("VmHWM") - before_; }

private:
  double before_;
};

/// Conformal energy, in the unit of the chart's geometry, and over the area in the plane.
std::pair<double, double> energies(const Chart& chart)
{
  const internal::Chart_geometry geometry(chart);
  std::vector<internal::Complex> u;
  for (const Point_2& p : chart.uv)
    u.emplace_back(geometry.from_model(p.x()), geometry.from_model(p.y()));
  const double energy = internal::Conformal_energy(geometry).value(u);
  return {energy, energy / internal::area_in_plane(chart, u)};
}

template <typename Traits>
void lscm(benchmark::State& state)
{
  Chart chart = wavy_chart(state.range(0));
  LSCM_record record;
  const Peak_memory memory;
  for (auto _ : state)
    if (LSCM_parameterizer<Traits>().parameterize(chart, Execution(), record) != Chart_status::valid)
      state.SkipWithError("no solution");
  state.counters["vertices"] = static_cast<double>(chart.number_of_vertices());
  state.counters["MB"] = memory.megabytes();
  state.counters["residual"] = record.residual;
  state.counters["energy"] = energies(chart).second;
}

void lscm_of_cgal(benchmark::State& state)
{
  using Mesh = CGAL::Surface_mesh<Point_3>;
  namespace SMP = CGAL::Surface_mesh_parameterization;
  Chart chart = wavy_chart(state.range(0));
  Mesh mesh;
  for (const Point_3& p : chart.points)
    mesh.add_vertex(p);
  for (const auto& [a, b, c] : chart.triangles)
    mesh.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(c));
  Mesh::Halfedge_index border;
  for (const auto h : mesh.halfedges())
    if (mesh.is_border(h))
      border = h;
  auto uv = mesh.add_property_map<Mesh::Vertex_index, Point_2>("v:uv", Point_2(0, 0)).first;
  const Peak_memory memory;
  for (auto _ : state)
    if (SMP::parameterize(mesh, SMP::LSCM_parameterizer_3<Mesh>(), border, uv) != SMP::OK)
      state.SkipWithError("no solution");
  state.counters["MB"] = memory.megabytes();
  for (const auto v : mesh.vertices())
    chart.uv.push_back(uv[v]);
  state.counters["vertices"] = static_cast<double>(chart.number_of_vertices());
  const auto [energy, relative_energy] = energies(chart);
  state.counters["energy"] = relative_energy;
  // Ours with two vertices held where CGAL has put them cannot be worse.
  const Index last = static_cast<Index>(chart.number_of_vertices() - 1);
  const LSCM_parameterizer<> ours(Eigen_LSCM_traits({{0, chart.uv[0]}, {last, chart.uv[last]}}));
  if (ours.parameterize(chart, Execution()) != Chart_status::valid)
    state.SkipWithError("no solution");
  state.counters["over_ours_with_its_pins"] = energy / energies(chart).first;
}

using Eigen_LDLT = Basic_LSCM_traits<internal::Hermitian_LDLT>;
using Multifrontal = Basic_LSCM_traits<internal::Hermitian_multifrontal>;

BENCHMARK(lscm_of_cgal)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(lscm, Conjugate_gradient_LSCM_traits)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(lscm, Eigen_LDLT)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(lscm, Multifrontal)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(lscm, Eigen_LSCM_traits)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMillisecond);
#ifdef ATLAS_WITH_CHOLMOD
BENCHMARK_TEMPLATE(lscm, Cholmod_LSCM_traits)
    ->RangeMultiplier(10)
    ->Range(1000, 100000)
    ->Unit(benchmark::kMillisecond);
#endif

} // namespace

BENCHMARK_MAIN();
