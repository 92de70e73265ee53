// SPDX-License-Identifier: MIT
// Size x stage x threads: whole runs of generate_atlas() on closed surfaces, and CGAL's LSCM of one disc with
// as many triangles beside them, in the same run. The columns named after stages are their seconds.
#include <Atlas/core/build_surface.h>
#include <Atlas/generate_atlas.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include <benchmark/benchmark.h>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <vector>

namespace {

using namespace Atlas;

/// A ring with bumps, of a grid of 2n by n squares.
Point_3 on_ring(double x, double y)
{
  const double a = 2 * std::numbers::pi * x, b = 2 * std::numbers::pi * y;
  const double tube = 0.4 + 0.06 * std::sin(5 * a) * std::cos(2 * b) + 0.02 * std::sin(14 * a + 3 * b);
  return Point_3((1 + tube * std::cos(b)) * std::cos(a), (1 + tube * std::cos(b)) * std::sin(a),
                 tube * std::sin(b));
}

/// How many squares are around the tube, for so many triangles in all.
std::size_t squares_around(std::int64_t triangles)
{
  return static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(triangles) / 4)));
}

Surface ring(std::int64_t triangles)
{
  const std::size_t n = squares_around(triangles);
  std::vector<Point_3> points;
  std::vector<std::vector<std::size_t>> faces;
  for (std::size_t i = 0; i < 2 * n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      points.push_back(on_ring(double(i) / double(2 * n), double(j) / double(n)));
      const std::size_t right = (i + 1) % (2 * n), up = (j + 1) % n;
      faces.push_back({i * n + j, right * n + j, right * n + up});
      faces.push_back({i * n + j, right * n + up, i * n + up});
    }
  return build_surface(std::move(points), faces);
}

/// Arguments: triangles, threads.
void atlas(benchmark::State& state)
{
  const Surface surface = ring(state.range(0));
  Atlas_report report;
  std::vector<Point_2> uv;
  std::vector<double> seconds(std::size(all_stages), 0);
  for (auto _ : state) {
    report =
        generate_atlas(surface, uv, parameters::number_of_threads(static_cast<unsigned>(state.range(1))));
    if (!report.is_valid())
      state.SkipWithError(message(report.status));
    for (std::size_t k = 0; k < seconds.size(); ++k)
      seconds[k] += report.seconds[k];
  }
  for (const Stage stage : all_stages)
    state.counters[name(stage)] =
        benchmark::Counter(seconds[static_cast<std::size_t>(stage)], benchmark::Counter::kAvgIterations);
  state.counters["charts"] = static_cast<double>(report.charts.size());
}

/// Half of the ring's outside: a disc.
void lscm_of_cgal(benchmark::State& state)
{
  using Mesh = CGAL::Surface_mesh<Point_3>;
  namespace SMP = CGAL::Surface_mesh_parameterization;
  const std::size_t n = squares_around(state.range(0));
  Mesh mesh;
  std::vector<Mesh::Vertex_index> vertices;
  for (std::size_t i = 0; i <= 2 * n; ++i)
    for (std::size_t j = 0; j <= n; ++j)
      vertices.push_back(
          mesh.add_vertex(on_ring(0.5 * double(i) / double(2 * n), 0.5 * double(j) / double(n) - 0.25)));
  for (std::size_t i = 0; i < 2 * n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t a = i * (n + 1) + j, b = a + n + 1;
      mesh.add_face(vertices[a], vertices[b], vertices[b + 1]);
      mesh.add_face(vertices[a], vertices[b + 1], vertices[a + 1]);
    }
  Mesh::Halfedge_index border;
  for (const auto h : mesh.halfedges())
    if (mesh.is_border(h))
      border = h;
  auto uv = mesh.add_property_map<Mesh::Vertex_index, Point_2>("v:uv", Point_2(0, 0)).first;
  for (auto _ : state)
    if (SMP::parameterize(mesh, SMP::LSCM_parameterizer_3<Mesh>(), border, uv) != SMP::OK)
      state.SkipWithError("no solution");
}

void sizes_and_threads(benchmark::internal::Benchmark* b)
{
  for (const std::int64_t triangles : {100, 1'000, 10'000, 100'000, 1'000'000})
    for (const std::int64_t threads : {1, 2, 4})
      b->Args({triangles, threads});
  b->ArgNames({"triangles", "threads"})->Unit(benchmark::kSecond)->MeasureProcessCPUTime()->UseRealTime();
}

BENCHMARK(atlas)->Apply(sizes_and_threads);
BENCHMARK(lscm_of_cgal)
    ->ArgName("triangles")
    ->RangeMultiplier(10)
    ->Range(100, 100'000)
    ->Unit(benchmark::kSecond);

} // namespace

BENCHMARK_MAIN();
