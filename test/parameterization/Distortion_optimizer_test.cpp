// SPDX-License-Identifier: MIT
#include <Atlas/core/concepts.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>
#include <Atlas/parameterization/Distortion_optimizer.h>
#include <Atlas/parameterization/Fixed_border_parameterizer.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/parameterization/internal/distortion/chart_hierarchy.h>
#include <Atlas/parameterization/internal/distortion/distortion_minimizer.h>
#include <Atlas/parameterization/internal/geometry/border.h>

#include <CGAL/Polygon_2_algorithms.h>

#include "flattening_checks.h"
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace Atlas;
using test::height_field;
using test::is_one_to_one;
using test::mean_energy;
using test::spiral;

static_assert(UVOptimizer<Symmetric_dirichlet_optimizer>);

TEST(Distortion_minimizer, takes_fewer_steps_with_large_charts)
{
  EXPECT_EQ(internal::affordable_steps(0, 60), 60u);
  EXPECT_EQ(internal::affordable_steps(1000, 60), 60u);
  EXPECT_EQ(internal::affordable_steps(50'000, 60), 20u);
  EXPECT_EQ(internal::affordable_steps(10'000'000, 60), 8u);
  EXPECT_EQ(internal::affordable_steps(10'000'000, 3), 3u);
}

TEST(Symmetric_dirichlet_optimizer, reaches_the_isometry_where_there_is_one)
{
  Chart chart = test::chart_of(
      test::grid(24, 6, [](double x, double y) { return Point_3(std::cos(4 * x), std::sin(4 * x), y); }));
  ASSERT_EQ(Tutte_parameterizer().parameterize(chart, Execution()), Chart_status::valid);
  Distortion_options options;
  options.tolerance = 1e-12;
  Distortion_record record;
  ASSERT_EQ(Symmetric_dirichlet_optimizer(options).optimize(chart, Execution(), record), Chart_status::valid);
  EXPECT_GT(record.before, 1.2);
  EXPECT_NEAR(mean_energy(chart), 1, 1e-9);
  EXPECT_LT(record.iterations, 30u);
}

TEST(Symmetric_dirichlet_optimizer, reports_the_energy_and_ends_at_a_stationary_point)
{
  Chart chart = height_field(12, 0.8, 3);
  ASSERT_EQ(Tutte_parameterizer().parameterize(chart, Execution()), Chart_status::valid);
  Distortion_options options;
  options.tolerance = 1e-13;
  options.max_iterations = 200;
  Distortion_record record;
  const Symmetric_dirichlet_optimizer optimizer(options);
  ASSERT_EQ(optimizer.optimize(chart, Execution(), record), Chart_status::valid);
  EXPECT_NEAR(record.after, mean_energy(chart), 1e-9);
  // Scale to the best size, then no vertex can lower the energy to first order.
  const double least = mean_energy(chart);
  double best = least;
  for (double s = 0.99; s < 1.01; s += 1e-4) {
    Chart scaled = chart;
    for (Point_2& p : scaled.uv)
      p = Point_2(s * p.x(), s * p.y());
    if (mean_energy(scaled) < best) {
      best = mean_energy(scaled);
      chart.uv = scaled.uv;
    }
  }
  for (const Index v : {0, 7, 80, 120, 168})
    for (const Vector_2& d : {Vector_2(1e-5, 0), Vector_2(0, 1e-5), Vector_2(-1e-5, 1e-5)}) {
      Chart moved = chart;
      moved.uv[v] = moved.uv[v] + d;
      EXPECT_GT(mean_energy(moved), best - 1e-9);
    }
}

/// What of a sphere is below the given height; the more, the stronger conformal maps vary in scale.
Chart bowl(double height)
{
  return test::chart_of(test::grid(40, 80, [=](double x, double y) {
    const double polar = y * std::acos(-height), around = 2 * M_PI * x;
    const double r = std::sin(polar + 1e-3), angle = 0.98 * around;
    return Point_3(r * std::cos(angle), r * std::sin(angle), -std::cos(polar));
  }));
}

std::vector<internal::Complex> coordinates(const Chart& chart)
{
  std::vector<internal::Complex> u;
  for (const Point_2& p : chart.uv)
    u.emplace_back(p.x(), p.y());
  return u;
}

TEST(Stretch_optimizer, lowers_stretch_with_the_border_where_it_is)
{
  Chart chart = height_field(12, 0.8, 3);
  ASSERT_EQ(Harmonic_parameterizer().parameterize(chart, Execution()), Chart_status::valid);
  const Chart before = chart;
  Distortion_options options;
  options.keeps_border = true;
  ASSERT_EQ(Stretch_optimizer(options).optimize(chart, Execution()), Chart_status::valid);
  const double kept = measure_distortion(chart).l2_stretch;
  EXPECT_LT(kept, 0.98 * measure_distortion(before).l2_stretch);
  // Up to one scale and a shift, the border is where it was; the inside is not.
  const std::vector<bool> is_on_border = internal::border_vertices(chart);
  Index origin = 0;
  while (!is_on_border[origin])
    ++origin;
  const double scale = std::sqrt(area_uv(chart) / area_uv(before));
  double moved = 0;
  for (Index v = 0; v < chart.uv.size(); ++v) {
    const Vector_2 off = (chart.uv[v] - chart.uv[origin]) - scale * (before.uv[v] - before.uv[origin]);
    if (is_on_border[v])
      EXPECT_LT(std::sqrt(off.squared_length()), 1e-6) << v;
    else
      moved = std::max(moved, std::sqrt(off.squared_length()));
  }
  EXPECT_GT(moved, 1e-3);
  // A free border can only do better.
  Chart free = before;
  ASSERT_EQ(Stretch_optimizer().optimize(free, Execution()), Chart_status::valid);
  EXPECT_LT(measure_distortion(free).l2_stretch, kept);
}

TEST(Chart_hierarchy, thins_out_discs_without_flips)
{
  Chart chart = height_field(60, 0.5, 1);
  ASSERT_EQ(LSCM_parameterizer<>().parameterize(chart, Execution()), Chart_status::valid);
  const std::vector<internal::Complex> u = coordinates(chart);
  const internal::Chart_geometry geometry(chart);
  internal::Chart_hierarchy hierarchy(geometry, u);
  hierarchy.coarsen(100);
  ASSERT_GE(hierarchy.levels().size(), 3u);
  EXPECT_LE(hierarchy.levels().back().vertices.size(), 300u);
  for (std::size_t level = 0; level < hierarchy.levels().size(); ++level) {
    const Chart coarse = hierarchy.chart(level);
    EXPECT_TRUE(topology(coarse).is_disc());
    std::vector<internal::Complex> part;
    for (const Index v : hierarchy.levels()[level].vertices) {
      part.push_back(u[v]);
      EXPECT_TRUE(hierarchy.has(level, v));
    }
    EXPECT_TRUE(internal::Injectivity_checker(coarse).is_one_to_one(part));
  }
}

TEST(Chart_hierarchy, brings_affine_maps_back_to_the_finest_mesh)
{
  Chart chart = test::chart_of(test::grid(50, 50, [](double x, double y) {
    return Point_3(x + 0.05 * std::sin(7 * y), y + 0.05 * std::cos(9 * x), 0);
  }));
  std::vector<internal::Complex> u, mapped;
  for (const Point_3& p : chart.points) {
    u.emplace_back(p.x(), p.y());
    mapped.emplace_back(3 * p.x() + p.y(), 0.2 * p.y());
  }
  const internal::Chart_geometry geometry(chart);
  internal::Chart_hierarchy hierarchy(geometry, u);
  hierarchy.coarsen(100);
  const std::size_t top = hierarchy.levels().size() - 1;
  ASSERT_GE(top, 2u);
  std::vector<internal::Complex> back(u.size(), -1), inside = back;
  for (const Index v : hierarchy.levels()[top].vertices)
    back[v] = inside[v] = mapped[v];
  for (std::size_t level = top; level-- > 0;) {
    ASSERT_TRUE(hierarchy.refine(level, back, false));
    ASSERT_TRUE(hierarchy.refine(level, inside, true));
  }
  for (std::size_t v = 0; v < u.size(); ++v)
    EXPECT_NEAR(std::abs(back[v] - mapped[v]), 0, 1e-12);
  // Inside: valid too, and nothing sticks out of the coarse mesh.
  internal::Injectivity_checker checker(chart);
  EXPECT_TRUE(checker.is_one_to_one(inside));
  std::vector<Index> loop = checker.borders().front();
  std::erase_if(loop, [&](Index v) { return !hierarchy.has(top, v); });
  std::vector<Point_2> polygon;
  for (const Index v : loop)
    polygon.push_back(internal::to_point(inside[v]));
  for (const internal::Complex& z : inside)
    EXPECT_NE(CGAL::bounded_side_2(polygon.begin(), polygon.end(), internal::to_point(z), Kernel()),
              CGAL::ON_UNBOUNDED_SIDE);
}

TEST(Symmetric_dirichlet_optimizer, needs_few_iterations_at_full_size)
{
  const std::pair<Chart, std::size_t> charts[] = {{bowl(0.99), 2}, {spiral(1.2, 150, 16), 8}};
  for (auto [chart, most] : charts) {
    Flattening_record record;
    ASSERT_EQ(Bijective_parameterizer().parameterize(chart, Execution(), record), Chart_status::valid);
    EXPECT_TRUE(is_one_to_one(chart));
    EXPECT_LE(record.distortion.iterations, most); // without coarser meshes 4 and 11
    Distortion_options options;
    options.tolerance = 1e-8;
    options.max_iterations = 500;
    Chart best = chart;
    ASSERT_EQ(Symmetric_dirichlet_optimizer(options).optimize(best, Execution()), Chart_status::valid);
    EXPECT_LE(mean_energy(chart), 1.002 * mean_energy(best));
  }
}

/// Of the values of the chart's triangles: the mean of the power of the energy, 1 for an isometry, and the
/// largest stretch.
std::pair<double, double> tail_of(const Chart& chart, int exponent)
{
  double sum = 0, area = 0;
  const std::vector<Triangle_distortion> measured = triangle_distortions(chart);
  for (const Triangle_distortion& m : measured) {
    const double a = m.largest * m.largest, b = m.smallest * m.smallest;
    sum += m.area_3d * std::pow((a + b + 1 / a + 1 / b) / 4, exponent);
    area += m.area_3d;
  }
  return {sum / area, summarize_distortion(measured).stretch_max};
}

TEST(Symmetric_dirichlet_optimizer, trades_mean_for_tail_by_its_exponent)
{
  for (const Chart& start : {height_field(12, 0.8, 3), bowl(0.9)}) {
    Chart mean = start;
    ASSERT_EQ(Tutte_parameterizer().parameterize(mean, Execution()), Chart_status::valid);
    ASSERT_EQ(Symmetric_dirichlet_optimizer().optimize(mean, Execution()), Chart_status::valid);
    double largest = tail_of(mean, 1).second;
    for (const unsigned exponent : {3u, 6u}) {
      Distortion_options options;
      options.tail_exponent = exponent;
      Chart chart = start;
      ASSERT_EQ(Tutte_parameterizer().parameterize(chart, Execution()), Chart_status::valid);
      Distortion_record record;
      ASSERT_EQ(Symmetric_dirichlet_optimizer(options).optimize(chart, Execution(), record),
                Chart_status::valid);
      EXPECT_TRUE(is_one_to_one(chart));
      EXPECT_NEAR(record.after, mean_energy(chart), 1e-3);
      const int power = static_cast<int>(exponent);
      EXPECT_LT(tail_of(chart, power).first, tail_of(mean, power).first);
      EXPECT_GT(mean_energy(chart), mean_energy(mean));
      EXPECT_LT(mean_energy(chart), 1 + 1.5 * (mean_energy(mean) - 1));
      EXPECT_LT(tail_of(chart, 1).second, largest);
      largest = tail_of(chart, 1).second;
    }
  }
}

TEST(Symmetric_dirichlet_optimizer, goes_straight_back_to_a_minimum_that_is_near)
{
  Distortion_options options;
  options.tail_exponent = 4;
  options.tolerance = 1e-6;
  Chart best = height_field(48, 0.8, 3); // enough vertices for coarse meshes
  ASSERT_EQ(Tutte_parameterizer().parameterize(best, Execution()), Chart_status::valid);
  ASSERT_EQ(Symmetric_dirichlet_optimizer(options).optimize(best, Execution()), Chart_status::valid);
  std::array<double, 2> tail{};
  std::array<std::size_t, 2> steps{};
  for (const bool is_near : {false, true}) {
    Chart chart = best;
    for (std::size_t v = 0; v < chart.uv.size(); v += 7)
      chart.uv[v] = Point_2(chart.uv[v].x() + 1e-3, chart.uv[v].y());
    options.starts_near_minimum = is_near;
    Distortion_record record;
    ASSERT_EQ(Symmetric_dirichlet_optimizer(options).optimize(chart, Execution(), record),
              Chart_status::valid);
    tail[is_near] = tail_of(chart, 4).first;
    steps[is_near] = record.iterations;
  }
  EXPECT_NEAR(tail[0], tail_of(best, 4).first, 1e-4);
  EXPECT_NEAR(tail[1], tail_of(best, 4).first, 1e-4);
  EXPECT_LT(steps[1], steps[0]);
}

TEST(Symmetric_dirichlet_optimizer, asks_at_every_step_whether_to_go_on)
{
  const Chart start = height_field(12, 0.8, 3);
  for (const int last : {1, 3, 1000}) {
    Chart chart = start;
    ASSERT_EQ(Tutte_parameterizer().parameterize(chart, Execution()), Chart_status::valid);
    int asked = 0;
    std::set<double> fractions;
    const Execution execution(1, [&](double fraction) {
      fractions.insert(fraction);
      return ++asked < last;
    });
    ASSERT_TRUE(last == 1 || execution.proceed(0.25));
    Distortion_record record;
    const Chart_status status = Symmetric_dirichlet_optimizer().optimize(chart, execution, record);
    EXPECT_EQ(status, last == 1000 ? Chart_status::valid : Chart_status::cancelled);
    if (last == 1000)
      EXPECT_GE(asked, static_cast<int>(record.iterations));
    else
      EXPECT_EQ(asked, last);
    EXPECT_EQ(fractions, std::set<double>{last == 1 ? 0 : 0.25}); // asking is no news
  }
}

TEST(Symmetric_dirichlet_optimizer, stops_at_its_target_and_its_limit)
{
  Chart chart = height_field(12, 0.8, 3);
  ASSERT_EQ(Tutte_parameterizer().parameterize(chart, Execution()), Chart_status::valid);
  const Chart start = chart;
  Distortion_record full, limited, early;
  Distortion_options options;
  ASSERT_EQ(Symmetric_dirichlet_optimizer(options).optimize(chart, Execution(), full), Chart_status::valid);
  options.max_iterations = 2;
  chart = start;
  ASSERT_EQ(Symmetric_dirichlet_optimizer(options).optimize(chart, Execution(), limited),
            Chart_status::valid);
  EXPECT_EQ(limited.iterations, 2u);
  options = {};
  options.target = 1 + 1.5 * (full.after - 1);
  chart = start;
  ASSERT_EQ(Symmetric_dirichlet_optimizer(options).optimize(chart, Execution(), early), Chart_status::valid);
  EXPECT_LT(early.iterations, full.iterations);
  EXPECT_LE(early.after, options.target * 1.001);
  EXPECT_GT(early.after, full.after);
}

TEST(Symmetric_dirichlet_optimizer, leaves_flipped_charts_alone)
{
  Chart chart = test::chart_of(test::planar_grid(3, 3));
  for (const Point_3& p : chart.points)
    chart.uv.emplace_back(-p.x(), p.y());
  const std::vector<Point_2> before = chart.uv;
  EXPECT_EQ(Symmetric_dirichlet_optimizer().optimize(chart, Execution()), Chart_status::flipped);
  EXPECT_EQ(chart.uv, before);
}

TEST(Symmetric_dirichlet_optimizer, checks_its_arguments)
{
  for (const double bad : {-1e-9, std::nan("")}) {
    Distortion_options tolerance, target;
    tolerance.tolerance = target.target = bad;
    EXPECT_THROW((void)Symmetric_dirichlet_optimizer(tolerance), Invalid_argument);
    EXPECT_THROW((void)Symmetric_dirichlet_optimizer(target), Invalid_argument);
  }
  Distortion_options exponent;
  exponent.tail_exponent = 0;
  EXPECT_THROW((void)Symmetric_dirichlet_optimizer(exponent), Invalid_argument);
  Chart chart = test::chart_of(test::planar_grid(2, 2)); // without coordinates
  EXPECT_THROW((void)Symmetric_dirichlet_optimizer().optimize(chart, Execution()), Invalid_argument);
}

} // namespace
