// SPDX-License-Identifier: MIT
#include <Atlas/core/errors.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>

#include "test_meshes.h"

namespace {

using namespace Atlas;

Chart wavy(Index m, Index n)
{
  return test::chart_of(test::grid(m, n, [](double x, double y) {
    return Point_3(x, 0.8 * y, 0.15 * std::sin(7 * x) * std::cos(5 * y + 1));
  }));
}

Chart cylinder()
{
  return test::chart_of(
      test::grid(30, 6, [](double x, double y) { return Point_3(std::cos(5 * x), std::sin(5 * x), y); }));
}

/// The largest distance between two maps over the extent of the second.
double difference(const std::vector<Point_2>& a, const std::vector<Point_2>& b)
{
  double worst = 0, extent = 0;
  for (std::size_t v = 0; v < a.size(); ++v) {
    worst = std::max(worst, (a[v] - b[v]).squared_length());
    extent = std::max(extent, (b[v] - b[0]).squared_length());
  }
  return std::sqrt(worst / extent);
}

void expect_same_as_fresh(Interactive_LSCM& interactive, const std::vector<LSCM_pin>& pins)
{
  ASSERT_EQ(interactive.solve(pins), Chart_status::valid);
  Chart fresh = interactive.chart();
  const LSCM_parameterizer<> lscm{Eigen_LSCM_traits(pins)};
  ASSERT_EQ(lscm.parameterize(fresh, Execution()), Chart_status::valid);
  EXPECT_LT(difference(interactive.chart().uv, fresh.uv), 1e-9);
  for (const LSCM_pin& pin : pins)
    EXPECT_EQ(interactive.chart().uv[pin.vertex], pin.uv);
}

TEST(Interactive_LSCM, gives_what_a_fresh_solution_gives)
{
  for (const Chart& chart : {wavy(12, 9), wavy(70, 65), cylinder()}) { // the second is for the large solver
    Interactive_LSCM interactive(chart);
    ASSERT_EQ(interactive.status(), Chart_status::valid);
    const Index n = static_cast<Index>(chart.number_of_vertices());
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-1, 1);
    for (const std::size_t count : {2u, 2u, 3u, 6u, 2u}) {
      std::vector<Index> vertices(n);
      std::iota(vertices.begin(), vertices.end(), 0);
      std::shuffle(vertices.begin(), vertices.end(), random);
      std::vector<LSCM_pin> pins;
      for (std::size_t i = 0; i < count; ++i)
        pins.push_back({vertices[i], Point_2(place(random), place(random))});
      expect_same_as_fresh(interactive, pins);
      pins.back().uv = Point_2(place(random), place(random)); // dragged
      expect_same_as_fresh(interactive, pins);
    }
  }
}

TEST(Interactive_LSCM, any_pins_will_do)
{
  const Chart chart = wavy(10, 8);
  Interactive_LSCM interactive(chart);
  LSCM_record record; // of the vertices that are held in the factorization
  Chart copy = chart;
  ASSERT_EQ(LSCM_parameterizer<>().parameterize(copy, Execution(), record), Chart_status::valid);
  const Index p = record.pins[0].vertex, q = record.pins[1].vertex;
  const Point_2 o(0, 0), x(1, 0), y(0.3, 2);
  expect_same_as_fresh(interactive, {{p, o}, {q, x}});
  expect_same_as_fresh(interactive, {{q, y}, {p, x}});
  expect_same_as_fresh(interactive, {{q, x}, {50, o}});
  expect_same_as_fresh(interactive, {{p, y}, {50, o}, {7, x}});
  const auto [a, b, c] = chart.triangles[60];
  expect_same_as_fresh(interactive, {{a, o}, {b, x}});         // neighbours
  expect_same_as_fresh(interactive, {{a, o}, {b, x}, {c, y}}); // a whole triangle
  std::vector<LSCM_pin> border;
  const std::vector<Index> opposite = internal::opposite_halfedges(chart.triangles);
  for (Index h = 0; h < opposite.size(); ++h)
    if (opposite[h] == no_index) {
      const Index v = chart.triangles[h / 3][h % 3];
      border.push_back({v, Point_2(chart.points[v].x(), chart.points[v].y())});
    }
  expect_same_as_fresh(interactive, border);
}

TEST(Interactive_LSCM, keeps_the_unit_of_the_model)
{
  for (const double scale : {1e-6, 1e6}) {
    Chart chart = wavy(9, 9);
    for (Point_3& p : chart.points)
      p = Point_3(scale * p.x() + 3 * scale, scale * p.y(), scale * p.z());
    Interactive_LSCM interactive(chart);
    expect_same_as_fresh(interactive, {{4, Point_2(0, 0)}, {60, Point_2(scale, 2 * scale)}});
  }
}

/// Counts what is asked of the solver inside.
class Counting_solver : public Direct_LSCM_solver
{
public:
  bool factorize(const LSCM_system& system, const Execution& execution)
  {
    ++factorizations;
    return Direct_LSCM_solver::factorize(system, execution);
  }
  bool solve(std::span<std::complex<double>> b)
  {
    ++solves;
    return Direct_LSCM_solver::solve(b);
  }
  static inline int factorizations = 0, solves = 0;
};

TEST(Interactive_LSCM, factorizes_once_and_remembers_pinned_vertices)
{
  Interactive_LSCM interactive = Interactive_LSCM::with_solver<Counting_solver>(wavy(12, 9));
  EXPECT_EQ(Counting_solver::factorizations, 1);
  Counting_solver::solves = 0;
  const std::vector<LSCM_pin> pins{{30, Point_2(0, 0)}, {70, Point_2(1, 0)}};
  ASSERT_EQ(interactive.solve(pins), Chart_status::valid);
  const int first = Counting_solver::solves;
  EXPECT_EQ(first, 3); // one for each vertex, and refinement
  const std::vector<LSCM_pin> dragged{{30, Point_2(0, 0)}, {70, Point_2(1, 2)}};
  ASSERT_EQ(interactive.solve(dragged), Chart_status::valid);
  EXPECT_EQ(Counting_solver::solves, first + 1);
  EXPECT_EQ(Counting_solver::factorizations, 1);
}

TEST(Interactive_LSCM, says_what_is_wrong)
{
  EXPECT_EQ(Interactive_LSCM(Chart()).status(), Chart_status::not_a_disc);
  Execution cancelled;
  cancelled.cancel();
  EXPECT_EQ(Interactive_LSCM(wavy(5, 5), cancelled).status(), Chart_status::cancelled);
  Chart bad = wavy(5, 5);
  bad.triangles.push_back({0, 1, 1000});
  EXPECT_THROW((void)Interactive_LSCM(bad), Invalid_argument);

  Interactive_LSCM interactive(wavy(5, 5));
  const Point_2 o(0, 0), x(1, 0);
  EXPECT_THROW((void)interactive.solve(std::vector<LSCM_pin>{}), Invalid_argument);
  EXPECT_THROW((void)interactive.solve(std::vector<LSCM_pin>{{0, o}}), Invalid_argument);
  EXPECT_THROW((void)interactive.solve(std::vector<LSCM_pin>{{0, o}, {1, o}}), Invalid_argument);
  EXPECT_THROW((void)interactive.solve(std::vector<LSCM_pin>{{0, o}, {0, x}}), Invalid_argument);
  EXPECT_THROW((void)interactive.solve(std::vector<LSCM_pin>{{0, o}, {36, x}}), Invalid_argument);

  Chart loose = wavy(5, 5); // with a vertex that no triangle has
  loose.points.emplace_back(5, 5, 5);
  Interactive_LSCM with_loose(loose);
  EXPECT_EQ(with_loose.solve(std::vector<LSCM_pin>{{0, o}, {36, x}}), Chart_status::solver_failed);
  EXPECT_EQ(with_loose.solve(std::vector<LSCM_pin>{{0, o}, {7, x}, {36, x}}), Chart_status::valid);
  EXPECT_EQ(with_loose.chart().uv[36], x);
}

} // namespace
