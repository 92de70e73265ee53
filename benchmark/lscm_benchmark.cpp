// SPDX-License-Identifier: MIT
// Chart size x solver: time, memory, residual and energy of LSCM, beside CGAL's in the same run.
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/parameterization/internal/conformal/conformal_energy.h>
#include <Atlas/parameterization/internal/conformal/hermitian_ldlt.h>
#include <Atlas/parameterization/internal/conformal/hermitian_multifrontal.h>
#include <Atlas/parameterization/internal/conformal/pins.h>
#include <Atlas/parameterization/internal/conformal/preconditioned_iteration.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include <array>
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <random>
#include <string>
#include <utility>
#include <vector>
#ifdef ATLAS_WITH_CHOLMOD
#include <Atlas/parameterization/Cholmod_LSCM_traits.h>
#endif

namespace {

using namespace Atlas;

enum class Shape { wavy, rough, graded, terrain };

const char* name(Shape shape)
{
  switch (shape) {
  case Shape::wavy:
    return "wavy: a smooth height field on a regular grid";
  case Shape::rough:
    return "rough: a round disc, vertices moved at random in all directions";
  case Shape::graded:
    return "graded: triangles of very different sizes";
  case Shape::terrain:
    return "terrain: bumps at all scales";
  }
  return "";
}

/// A point of the unit square in space.
Point_3 in_space(Shape shape, double x, double y, double h, double noise)
{
  switch (shape) {
  case Shape::wavy:
    return Point_3(x, y, 0.1 * std::sin(9 * x) * std::cos(7 * y));
  case Shape::rough:
    x = 2 * x - 1;
    y = 2 * y - 1;
    return Point_3(x * std::sqrt(1 - y * y / 2), y * std::sqrt(1 - x * x / 2),
                   0.3 * std::sin(5 * x) * std::cos(4 * y) + 0.3 * h * noise);
  case Shape::graded:
    return Point_3(std::pow(x, 2.5), y * y * (3 - 2 * y), 0.2 * std::cos(6 * x + 3 * y));
  case Shape::terrain: {
    double z = 0.2 * h * noise;
    for (double f = 3; f < 0.3 / h; f *= 2)
      z += 0.3 / f * std::sin(f * x + 3 * f * y) * std::cos(2 * f * x - f * y + f);
    return Point_3(x, y, z);
  }
  }
  return Point_3(0, 0, 0);
}

/// A disc of n vertices or a few more, from a grid; but for the first shape with vertices moved at random
/// and random diagonals.
Chart disc(Shape shape, std::int64_t n)
{
  const Index side = static_cast<Index>(std::ceil(std::sqrt(static_cast<double>(n))));
  const double h = 1. / (side - 1);
  std::mt19937 random(7);
  const auto noise = [&] { return static_cast<double>(random()) / 4294967296. - 0.5; };
  const bool is_regular = shape == Shape::wavy;
  Chart chart;
  for (Index j = 0; j < side; ++j)
    for (Index i = 0; i < side; ++i) {
      const double dx = 0.5 * h * noise(), dy = 0.5 * h * noise();
      const bool is_border = i == 0 || j == 0 || i + 1 == side || j + 1 == side;
      const double share = is_regular || is_border ? 0 : 1;
      chart.points.push_back(in_space(shape, i * h + share * dx, j * h + share * dy, h, noise()));
    }
  for (Index j = 0; j + 1 < side; ++j)
    for (Index i = 0; i + 1 < side; ++i) {
      const Index a = j * side + i, b = a + 1, c = a + side, d = c + 1;
      const bool is_falling = !is_regular && random() % 2 == 0;
      chart.triangles.push_back(is_falling ? std::array{a, b, c} : std::array{a, b, d});
      chart.triangles.push_back(is_falling ? std::array{b, d, c} : std::array{a, d, c});
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
  const auto shape = static_cast<Shape>(state.range(1));
  state.SetLabel(name(shape));
  Chart chart = disc(shape, state.range(0));
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

/// One right-hand side alone, that of LSCM's default pins: the time to prepare and to solve, memory beyond
/// the matrix, and |b - H x| / |b|.
template <typename Traits>
void system(benchmark::State& state)
{
  const auto shape = static_cast<Shape>(state.range(1));
  state.SetLabel(name(shape));
  const Chart chart = disc(shape, state.range(0));
  const internal::Chart_geometry geometry(chart);
  const internal::Conformal_energy energy(geometry);
  const std::vector<LSCM_pin> pins = internal::default_pins(geometry);
  const LSCM_system system = internal::lscm_system(energy, pins);
  std::vector<internal::Complex> right;
  energy.residual(internal::pinned(geometry, pins), right);
  const std::vector<internal::Complex> b = internal::gather(system, right);
  std::vector<internal::Complex> x, r;
  const Peak_memory memory;
  double iterations = 0;
  for (auto _ : state) {
    typename Traits::Solver solver;
    x = b;
    if (!solver.factorize(system, Execution()) || !solver.solve(x))
      state.SkipWithError("no solution");
    if constexpr (requires { solver.record(); })
      iterations = static_cast<double>(solver.record().iterations);
  }
  state.counters["MB"] = memory.megabytes();
  r = b;
  internal::subtract_product(system, x, b, r);
  state.counters["residual"] = internal::norm(r) / internal::norm(b);
  state.counters["iterations"] = iterations;
}

void lscm_of_cgal(benchmark::State& state)
{
  using Mesh = CGAL::Surface_mesh<Point_3>;
  namespace SMP = CGAL::Surface_mesh_parameterization;
  Chart chart = disc(Shape::wavy, state.range(0));
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

void sizes(benchmark::internal::Benchmark* b)
{
  for (std::int64_t n = 1000; n <= 1000000; n *= 10)
    b->Args({n, static_cast<std::int64_t>(Shape::wavy)});
  b->Unit(benchmark::kMillisecond);
}

void sizes_up_to_100000(benchmark::internal::Benchmark* b)
{
  for (std::int64_t n = 1000; n <= 100000; n *= 10)
    b->Args({n, static_cast<std::int64_t>(Shape::wavy)});
  b->Unit(benchmark::kMillisecond);
}

/// All shapes with a million vertices.
void large_discs(benchmark::internal::Benchmark* b)
{
  for (const Shape shape : {Shape::wavy, Shape::rough, Shape::graded, Shape::terrain})
    b->Args({1000000, static_cast<std::int64_t>(shape)});
  b->Unit(benchmark::kMillisecond)->Iterations(1);
}

BENCHMARK(lscm_of_cgal)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(lscm, Conjugate_gradient_LSCM_traits)
    ->Args({1000, static_cast<std::int64_t>(Shape::wavy)})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(lscm, Eigen_LDLT)->Apply(sizes_up_to_100000);
BENCHMARK_TEMPLATE(lscm, Multifrontal)->Apply(sizes);
BENCHMARK_TEMPLATE(lscm, Eigen_LSCM_traits)->Apply(sizes);
BENCHMARK_TEMPLATE(lscm, Preconditioned_CG_LSCM_traits)->Apply(sizes);
BENCHMARK_TEMPLATE(lscm, Multigrid_LSCM_traits)->Apply(sizes_up_to_100000);
BENCHMARK_TEMPLATE(lscm, Out_of_core_LSCM_traits)->Apply(sizes);
BENCHMARK_TEMPLATE(system, Eigen_LSCM_traits)->Apply(large_discs);
BENCHMARK_TEMPLATE(system, Preconditioned_CG_LSCM_traits)->Apply(large_discs);
#ifdef ATLAS_WITH_CHOLMOD
BENCHMARK_TEMPLATE(lscm, Cholmod_LSCM_traits)->Apply(sizes_up_to_100000);
#endif

} // namespace

BENCHMARK_MAIN();
