// SPDX-License-Identifier: MIT
// The properties that section 2.6 and the appendix of the LSCM paper prove, on the code.
#include <Atlas/core/concepts.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/parameterization/internal/conformal/hermitian_ldlt.h>
#include <Atlas/parameterization/internal/conformal/hermitian_multifrontal.h>
#include <Atlas/parameterization/internal/geometry/border.h>

#include <Eigen/Dense>

#include "test_meshes.h"

namespace {

using namespace Atlas;
using Complex = std::complex<double>;

static_assert(LSCMTraits<Eigen_LSCM_traits>);
static_assert(LSCMTraits<Conjugate_gradient_LSCM_traits>);
static_assert(ChartParameterizer<LSCM_parameterizer<>>);

struct Traits_without_pins
{
  using Solver = Eigen_LSCM_traits::Solver;
};
struct Traits_with_a_wrong_solver
{
  using Solver = int;
  std::vector<LSCM_pin> pins(const Chart&) const { return {}; }
};
static_assert(!LSCMTraits<Traits_without_pins>);
static_assert(!LSCMTraits<Traits_with_a_wrong_solver>);

Complex complex(const Point_2& p)
{
  return {p.x(), p.y()};
}

Chart wavy(Index m = 12, Index n = 9, double height = 0.1)
{
  return test::chart_of(test::grid(m, n, [=](double x, double y) {
    return Point_3(x, 0.8 * y, height * std::sin(7 * x) * std::cos(5 * y + 1));
  }));
}

Chart flattened(Chart chart, std::vector<LSCM_pin> pins = {})
{
  const LSCM_parameterizer<> lscm{Eigen_LSCM_traits(std::move(pins))};
  EXPECT_EQ(lscm.parameterize(chart, Execution()), Chart_status::valid);
  return chart;
}

/// The paper's matrix M, section 2.5, from local frames made by Gram-Schmidt.
Eigen::MatrixXcd matrix_m(const Chart& chart)
{
  Eigen::MatrixXcd m = Eigen::MatrixXcd::Zero(static_cast<Eigen::Index>(chart.triangles.size()),
                                              static_cast<Eigen::Index>(chart.points.size()));
  for (Index t = 0; t < chart.triangles.size(); ++t) {
    const auto [a, b, c] = chart.triangles[t];
    const Vector_3 p = chart.points[b] - chart.points[a], q = chart.points[c] - chart.points[a];
    const Vector_3 x = p / std::sqrt(p.squared_length());
    const Vector_3 rest = q - (q * x) * x;
    const Vector_3 y = rest / std::sqrt(rest.squared_length());
    const std::array<Complex, 3> z{Complex(0), Complex(p * x, 0), Complex(q * x, q * y)};
    const double d = z[1].real() * z[2].imag();
    m(t, a) = (z[2] - z[1]) / std::sqrt(d);
    m(t, b) = (z[0] - z[2]) / std::sqrt(d);
    m(t, c) = (z[1] - z[0]) / std::sqrt(d);
  }
  return m;
}

/// Dirichlet energy by cotangents from edge lengths, minus the area in the plane: the conformal energy.
double energy_by_definition(const Chart& chart)
{
  double dirichlet = 0, area = 0;
  for (const auto& t : chart.triangles) {
    for (int i = 0; i < 3; ++i) {
      const Index a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
      const double bc = (chart.points[b] - chart.points[c]).squared_length(),
                   ca = (chart.points[c] - chart.points[a]).squared_length(),
                   ab = (chart.points[a] - chart.points[b]).squared_length();
      const double four_areas = std::sqrt(4 * bc * ca - (bc + ca - ab) * (bc + ca - ab));
      const double cotangent = (bc + ca - ab) / four_areas; // at c
      dirichlet += cotangent / 4 * (chart.uv[a] - chart.uv[b]).squared_length();
    }
    area += CGAL::area(chart.uv[t[0]], chart.uv[t[1]], chart.uv[t[2]]);
  }
  return dirichlet - area;
}

TEST(LSCM, the_matrix_has_full_rank_and_the_minimum_is_the_least_squares_solution)
{
  const Chart chart = flattened(wavy(5, 4), {{0, Point_2(0, 0)}, {29, Point_2(1, 0.5)}, {5, Point_2(1, 0)}});
  const Eigen::MatrixXcd m = matrix_m(chart);
  const std::vector<Index> pinned{0, 5, 29};
  std::vector<Index> free;
  for (Index v = 0; v < chart.points.size(); ++v)
    if (std::find(pinned.begin(), pinned.end(), v) == pinned.end())
      free.push_back(v);
  const auto nf = static_cast<Eigen::Index>(free.size()), rows = m.rows();
  Eigen::MatrixXd a(2 * rows, 2 * nf);
  for (Eigen::Index k = 0; k < nf; ++k) {
    a.block(0, k, rows, 1) = m.col(free[k]).real();
    a.block(rows, k, rows, 1) = m.col(free[k]).imag();
    a.block(0, nf + k, rows, 1) = -m.col(free[k]).imag();
    a.block(rows, nf + k, rows, 1) = m.col(free[k]).real();
  }
  Eigen::VectorXcd moved = Eigen::VectorXcd::Zero(rows);
  for (const Index v : pinned)
    moved -= m.col(v) * complex(chart.uv[v]);
  Eigen::VectorXd b(2 * rows);
  b << moved.real(), moved.imag();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a);
  EXPECT_EQ(qr.rank(), 2 * nf);
  const Eigen::VectorXd x = qr.solve(b);
  for (Eigen::Index k = 0; k < nf; ++k) {
    EXPECT_NEAR(chart.uv[free[k]].x(), x[k], 1e-12);
    EXPECT_NEAR(chart.uv[free[k]].y(), x[nf + k], 1e-12);
  }
}

TEST(LSCM, without_a_pin_only_the_constants_have_no_energy)
{
  const Eigen::MatrixXcd m = matrix_m(wavy(4, 4));
  EXPECT_EQ(Eigen::ColPivHouseholderQR<Eigen::MatrixXcd>(m).rank(), m.cols() - 1);
  EXPECT_LT((m * Eigen::VectorXcd::Ones(m.cols())).norm(), 1e-12);
}

TEST(LSCM, the_energy_is_the_same_by_another_definition)
{
  LSCM_record record;
  Chart chart = wavy();
  ASSERT_EQ(LSCM_parameterizer<>().parameterize(chart, Execution(), record), Chart_status::valid);
  double area = 0;
  for (const auto& t : chart.triangles)
    area += CGAL::area(chart.uv[t[0]], chart.uv[t[1]], chart.uv[t[2]]);
  EXPECT_NEAR(record.energy, energy_by_definition(chart) / area, 1e-12);
  EXPECT_GT(record.energy, 1e-4);
  EXPECT_LT(record.residual, 1e-10);
  Eigen::VectorXcd u(static_cast<Eigen::Index>(chart.uv.size()));
  for (Eigen::Index v = 0; v < u.size(); ++v)
    u[v] = complex(chart.uv[v]);
  EXPECT_NEAR(record.energy, (matrix_m(chart) * u).squaredNorm() / 4 / area, 1e-12);
}

TEST(LSCM, no_other_map_with_the_same_pins_has_less_energy)
{
  Chart chart = flattened(wavy());
  const double least = energy_by_definition(chart);
  const std::vector<Point_2> uv = chart.uv;
  LSCM_record record;
  Chart again = wavy();
  ASSERT_EQ(LSCM_parameterizer<>().parameterize(again, Execution(), record), Chart_status::valid);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-1e-3, 1e-3);
  for (int trial = 0; trial < 20; ++trial) {
    for (Index v = 0; v < uv.size(); ++v)
      if (v != record.pins[0].vertex && v != record.pins[1].vertex)
        chart.uv[v] = uv[v] + Vector_2(noise(random), noise(random));
    EXPECT_GT(energy_by_definition(chart), least);
  }
}

/// Largest relative change of an edge length from space to the plane.
double isometry_defect(const Chart& chart)
{
  double worst = 0;
  for (const auto& t : chart.triangles)
    for (int i = 0; i < 3; ++i) {
      const Index a = t[i], b = t[(i + 1) % 3];
      const double space = std::sqrt((chart.points[a] - chart.points[b]).squared_length()),
                   plane = std::sqrt((chart.uv[a] - chart.uv[b]).squared_length());
      worst = std::max(worst, std::abs(plane / space - 1));
    }
  return worst;
}

TEST(LSCM, developable_charts_are_flattened_isometrically)
{
  // A strip folded along lines across it, a planar sheet in space, and a prism-like cylinder.
  const Chart folded = test::chart_of(test::grid(
      9, 4, [](double x, double y) { return Point_3(x, 0.3 * y, std::abs(std::fmod(9 * x, 2.) - 1) / 9); }));
  const Chart tilted = test::chart_of(
      test::grid(6, 6, [](double x, double y) { return Point_3(x + y, x - 2 * y, 0.5 * x + 3 * y); }));
  const Chart cylinder = test::chart_of(
      test::grid(24, 3, [](double x, double y) { return Point_3(std::cos(6 * x), std::sin(6 * x), y); }));
  // A cone of discrete rulings through its apex.
  test::Soup fan;
  fan.points.emplace_back(0, 0, 1);
  for (int i = 0; i <= 20; ++i)
    fan.points.emplace_back(std::cos(0.25 * i), std::sin(0.25 * i), 0);
  for (Index i = 1; i <= 20; ++i)
    fan.polygons.push_back({0, i, i + 1});
  for (const Chart& chart : {folded, tilted, cylinder, test::chart_of(fan)}) {
    EXPECT_LT(isometry_defect(flattened(chart)), 1e-10);
    EXPECT_LT(std::abs(energy_by_definition(flattened(chart))), 1e-12);
  }
}

TEST(LSCM, a_similarity_of_the_pins_moves_everything_by_that_similarity)
{
  const std::vector<LSCM_pin> pins{{0, Point_2(0, 0)}, {12, Point_2(1, 0)}, {120, Point_2(1, 1)}};
  const Complex z(0.6, -1.7), w(3, 4);
  std::vector<LSCM_pin> moved = pins;
  for (LSCM_pin& pin : moved) {
    const Complex image = z * complex(pin.uv) + w;
    pin.uv = Point_2(image.real(), image.imag());
  }
  const Chart a = flattened(wavy(), pins), b = flattened(wavy(), moved);
  for (Index v = 0; v < a.uv.size(); ++v)
    EXPECT_LT(std::abs(z * complex(a.uv[v]) + w - complex(b.uv[v])), 1e-11);
  for (const LSCM_pin& pin : pins)
    EXPECT_LT((a.uv[pin.vertex] - pin.uv).squared_length(), 1e-30);
}

TEST(LSCM, splitting_a_triangle_moves_no_vertex_and_puts_the_new_one_at_its_barycentre)
{
  const std::vector<LSCM_pin> pins{{0, Point_2(0, 0)}, {129, Point_2(1, 1)}};
  Chart chart = wavy();
  const Chart before = flattened(chart, pins);
  const std::array<double, 3> weight{0.2, 0.5, 0.3};
  const auto [a, b, c] = chart.triangles[77];
  const Index v = static_cast<Index>(chart.points.size());
  chart.points.push_back(
      CGAL::barycenter(chart.points[a], weight[0], chart.points[b], weight[1], chart.points[c], weight[2]));
  chart.triangles[77] = {a, b, v};
  chart.triangles.insert(chart.triangles.end(), {{b, c, v}, {c, a, v}});
  const Chart after = flattened(chart, pins);
  for (Index w = 0; w < v; ++w)
    EXPECT_LT((before.uv[w] - after.uv[w]).squared_length(), 1e-24);
  const Complex expected =
      weight[0] * complex(after.uv[a]) + weight[1] * complex(after.uv[b]) + weight[2] * complex(after.uv[c]);
  EXPECT_LT(std::abs(complex(after.uv[v]) - expected), 1e-12);
}

TEST(LSCM, the_default_pins_are_on_the_border_and_far_apart)
{
  LSCM_record record;
  Chart chart = test::chart_of(test::grid(40, 4, [](double x, double y) { return Point_3(10 * x, y, 0); }));
  ASSERT_EQ(LSCM_parameterizer<>().parameterize(chart, Execution(), record), Chart_status::valid);
  ASSERT_EQ(record.pins.size(), 2u);
  const Point_3 p = chart.points[record.pins[0].vertex], q = chart.points[record.pins[1].vertex];
  EXPECT_NEAR(std::abs(p.x() - q.x()), 10, 1e-12);
}

TEST(LSCM, a_slit_ring_is_not_pinned_at_the_two_copies_of_a_place)
{
  Chart chart = test::chart_of(test::grid(60, 4, [](double x, double y) {
    const double angle = 2 * M_PI * x;
    return Point_3((2 + y) * std::cos(angle), (2 + y) * std::sin(angle), 0);
  }));
  LSCM_record record;
  ASSERT_EQ(LSCM_parameterizer<>().parameterize(chart, Execution(), record), Chart_status::valid);
  ASSERT_EQ(record.pins.size(), 2u);
  const Point_3 p = chart.points[record.pins[0].vertex], q = chart.points[record.pins[1].vertex];
  EXPECT_GT(CGAL::squared_distance(p, q), 4);
  for (const auto& [a, b, c] : chart.triangles)
    EXPECT_NEAR(CGAL::squared_distance(chart.uv[a], chart.uv[b]),
                CGAL::squared_distance(chart.points[a], chart.points[b]), 1e-9);
}

/// The longest shortest path between two border vertices, by Floyd and Warshall's algorithm.
double longest_way(const Chart& chart)
{
  const std::size_t n = chart.number_of_vertices();
  std::vector<std::vector<double>> way(n, std::vector<double>(n, HUGE_VAL));
  for (const auto& corner : chart.triangles)
    for (int i = 0; i < 3; ++i) {
      const Index a = corner[i], b = corner[(i + 1) % 3];
      way[a][b] = way[b][a] = std::sqrt(CGAL::squared_distance(chart.points[a], chart.points[b]));
    }
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        way[i][j] = std::min(way[i][j], way[i][k] + way[k][j]);
  const std::vector<bool> is_on_border = internal::border_vertices(chart);
  double longest = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (is_on_border[i] && is_on_border[j])
        longest = std::max(longest, way[i][j]);
  return longest;
}

TEST(LSCM, the_papers_pins_are_the_ends_of_the_diameter)
{
  // A rectangle, a sheet with waves, a round cap, and an open ring, whose cut counts as a way.
  const std::vector<Chart> charts{
      wavy(12, 3, 0), wavy(12, 9, 0.3),
      test::chart_of(test::grid(10, 10,
                                [](double x, double y) {
                                  const double r = std::max(std::abs(2 * x - 1), std::abs(2 * y - 1));
                                  const double a = std::atan2(2 * y - 1, 2 * x - 1);
                                  return Point_3(r * std::cos(a), r * std::sin(a), 1 - r * r);
                                })),
      test::chart_of(test::grid(24, 2, [](double x, double y) {
        return Point_3((2 + y) * std::cos(6.2 * x), (2 + y) * std::sin(6.2 * x), 0);
      }))};
  for (const Chart& chart : charts) {
    const std::vector<LSCM_pin> pins = diameter_pins(chart);
    ASSERT_EQ(pins.size(), 2u);
    const std::vector<bool> is_on_border = internal::border_vertices(chart);
    EXPECT_TRUE(is_on_border[pins[0].vertex] && is_on_border[pins[1].vertex]);
    EXPECT_NEAR(pins[1].uv.x() - pins[0].uv.x(), longest_way(chart), 1e-9);
    // Without time to search it is a double sweep, never more.
    EXPECT_LE(diameter_pins(chart, 0)[1].uv.x(), pins[1].uv.x() + 1e-12);
    EXPECT_GE(diameter_pins(chart, 0)[1].uv.x(), 0.5 * pins[1].uv.x());
  }
  EXPECT_TRUE(diameter_pins(Chart()).empty());
}

TEST(LSCM, the_result_scales_with_the_model_and_keeps_the_area)
{
  const Chart chart = wavy();
  const Chart reference = flattened(chart);
  double space = 0, plane = 0;
  for (const auto& t : reference.triangles) {
    space +=
        std::sqrt(CGAL::squared_area(reference.points[t[0]], reference.points[t[1]], reference.points[t[2]]));
    plane += CGAL::area(reference.uv[t[0]], reference.uv[t[1]], reference.uv[t[2]]);
  }
  EXPECT_NEAR(plane / space, 1, 1e-12);
  for (const double scale : {1e-30, 1e-6, 3., 1e6, 1e30}) {
    Chart scaled = chart;
    for (Point_3& p : scaled.points)
      p = Point_3(scale * p.x(), scale * p.y(), scale * p.z());
    scaled = flattened(scaled);
    for (Index v = 0; v < reference.uv.size(); ++v) {
      EXPECT_NEAR(scaled.uv[v].x() / scale, reference.uv[v].x(), 1e-10);
      EXPECT_NEAR(scaled.uv[v].y() / scale, reference.uv[v].y(), 1e-10);
    }
  }
}

TEST(LSCM, conjugate_gradients_on_the_papers_matrix_agree)
{
  const Chart expected = flattened(wavy());
  Chart chart = wavy();
  LSCM_record record;
  const LSCM_parameterizer<Conjugate_gradient_LSCM_traits> lscm;
  ASSERT_EQ(lscm.parameterize(chart, Execution(), record), Chart_status::valid);
  for (Index v = 0; v < chart.uv.size(); ++v)
    EXPECT_LT((chart.uv[v] - expected.uv[v]).squared_length(), 1e-20);
}

TEST(LSCM, the_multifrontal_solver_agrees_with_eigen)
{
  // A ring cut open has many border vertices; a square has few.
  for (const Chart& chart :
       {wavy(3, 2), wavy(40, 30), test::chart_of(test::grid(90, 3, [](double x, double y) {
          return Point_3((1 + y) * std::cos(6 * x), (1 + y) * std::sin(6 * x), x * y);
        }))}) {
    Chart a = chart, b = chart;
    LSCM_record record;
    const LSCM_parameterizer<Basic_LSCM_traits<internal::Hermitian_LDLT>> eigen;
    const LSCM_parameterizer<Basic_LSCM_traits<internal::Hermitian_multifrontal>> multifrontal;
    ASSERT_EQ(eigen.parameterize(a, Execution()), Chart_status::valid);
    ASSERT_EQ(multifrontal.parameterize(b, Execution(), record), Chart_status::valid);
    EXPECT_LT(record.residual, 1e-9);
    for (Index v = 0; v < a.uv.size(); ++v)
      EXPECT_LT((a.uv[v] - b.uv[v]).squared_length(), 1e-20);
  }
}

TEST(LSCM, degenerate_triangles_do_not_spoil_their_neighbours)
{
  // A planar grid with a needle (two vertices in one place), a cap (a vertex on an edge) and a triangle
  // whose corners are one point, glued in; the rest must still be the planar grid.
  Chart chart = test::chart_of(test::planar_grid(8, 8));
  const auto split_edge = [&](Index a, Index b, const Point_3& p, bool on_both_sides) {
    const Index v = static_cast<Index>(chart.points.size());
    chart.points.push_back(p);
    const std::size_t count = chart.triangles.size();
    bool done = false;
    for (std::size_t t = 0; t < count; ++t)
      for (int i = 0; i < 3; ++i) {
        auto triangle = chart.triangles[t];
        const bool matches = (triangle[i] == a && triangle[(i + 1) % 3] == b) ||
                             (on_both_sides && triangle[i] == b && triangle[(i + 1) % 3] == a);
        if (!matches || (done && !on_both_sides))
          continue;
        done = true;
        chart.triangles.push_back({v, triangle[(i + 1) % 3], triangle[(i + 2) % 3]});
        if (!on_both_sides)
          chart.triangles.push_back({triangle[i], triangle[(i + 1) % 3], v}); // the cap
        chart.triangles[t] = {triangle[i], v, triangle[(i + 2) % 3]};
        break;
      }
  };
  const auto [a, b, c] = chart.triangles[40];
  split_edge(a, b, CGAL::midpoint(chart.points[a], chart.points[b]), false);
  const auto [d, e, f] = chart.triangles[90];
  split_edge(d, e, chart.points[d], true); // needles
  // Three vertices in one place inside a triangle.
  const auto [g, h, i] = chart.triangles[70];
  const Index x = static_cast<Index>(chart.points.size()), y = x + 1, z = x + 2;
  chart.points.insert(chart.points.end(), 3,
                      CGAL::centroid(chart.points[g], chart.points[h], chart.points[i]));
  chart.triangles[70] = {x, y, z};
  chart.triangles.insert(chart.triangles.end(),
                         {{g, h, x}, {h, y, x}, {h, i, y}, {i, z, y}, {i, g, z}, {g, x, z}});
  (void)c, (void)f;
  const Chart result = flattened(chart);
  for (const auto& t : result.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Point_2 &p = result.uv[t[k]], &q = result.uv[t[(k + 1) % 3]];
      ASSERT_TRUE(std::isfinite(p.x()) && std::isfinite(p.y()));
      const double space = std::sqrt((chart.points[t[k]] - chart.points[t[(k + 1) % 3]]).squared_length());
      EXPECT_NEAR(std::sqrt((p - q).squared_length()), space, 1e-6);
    }
  }
}

TEST(LSCM, charts_that_are_no_discs_end_in_a_status_and_finite_coordinates)
{
  std::vector<Chart> charts{test::chart_of(test::sphere(1)), test::chart_of(test::torus(6, 5)), Chart()};
  Chart one = test::chart_of(test::planar_grid(1, 1));
  one.triangles.resize(1);
  charts.push_back(one);
  Chart point = one;
  std::fill(point.points.begin(), point.points.end(), Point_3(1, 2, 3));
  charts.push_back(point);
  Chart line = one;
  line.points = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
  charts.push_back(line);
  Chart repeated = one;
  repeated.triangles[0] = {0, 1, 1};
  charts.push_back(repeated);
  Chart two = test::chart_of(test::planar_grid(2, 2));
  two.triangles = {{0, 1, 3}, {4, 8, 7}};
  charts.push_back(two);
  for (Chart& chart : charts) {
    (void)LSCM_parameterizer<>().parameterize(chart, Execution());
    ASSERT_EQ(chart.uv.size(), chart.points.size());
    for (const Point_2& p : chart.uv)
      EXPECT_TRUE(std::isfinite(p.x()) && std::isfinite(p.y()));
  }
  EXPECT_LT(isometry_defect(flattened(one)), 1e-12);
}

} // namespace
