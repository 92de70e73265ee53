// SPDX-License-Identifier: MIT
#include <Atlas/core/concepts.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/parameterization/ABF_parameterizer.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>

#include "test_meshes.h"

namespace {

using namespace Atlas;

static_assert(ChartParameterizer<ABF_parameterizer>);

using Angles = std::array<double, 3>;

/// From cross and scalar products.
Angles angles_in_space(const Chart& chart, std::size_t t)
{
  Angles result;
  for (int i = 0; i < 3; ++i) {
    const Point_3& p = chart.points[chart.triangles[t][i]];
    const Vector_3 a = chart.points[chart.triangles[t][(i + 1) % 3]] - p,
                   b = chart.points[chart.triangles[t][(i + 2) % 3]] - p;
    result[i] = std::atan2(std::sqrt(CGAL::cross_product(a, b).squared_length()), a * b);
  }
  return result;
}

Angles angles_in_plane(const Chart& chart, std::size_t t)
{
  Angles result;
  for (int i = 0; i < 3; ++i) {
    const Point_2& p = chart.uv[chart.triangles[t][i]];
    const Vector_2 a = chart.uv[chart.triangles[t][(i + 1) % 3]] - p,
                   b = chart.uv[chart.triangles[t][(i + 2) % 3]] - p;
    result[i] = std::atan2(a.x() * b.y() - a.y() * b.x(), a * b);
  }
  return result;
}

std::vector<bool> inner_vertices(const Chart& chart)
{
  std::vector<bool> result(chart.number_of_vertices(), true);
  const std::vector<Index> opposite = internal::opposite_halfedges(chart.triangles);
  for (Index h = 0; h < opposite.size(); ++h)
    if (opposite[h] == no_index) {
      const Index g = next_halfedge(h);
      result[chart.triangles[h / 3][h % 3]] = result[chart.triangles[g / 3][g % 3]] = false;
    }
  return result;
}

/// The largest amount by which angles miss one of the three conditions of Sheffer and de Sturler 2001; the
/// third as the product that it is there.
double violation(const Chart& chart, const std::vector<Angles>& angles)
{
  std::vector<double> sum(chart.number_of_vertices(), 0), next(sum.size(), 1), last(sum.size(), 1);
  double worst = 0;
  for (std::size_t t = 0; t < angles.size(); ++t) {
    const auto& [a, b, c] = angles[t];
    worst = std::max(worst, std::abs(a + b + c - M_PI));
    for (int i = 0; i < 3; ++i) {
      const Index v = chart.triangles[t][i];
      sum[v] += angles[t][i];
      next[v] *= std::sin(angles[t][(i + 1) % 3]);
      last[v] *= std::sin(angles[t][(i + 2) % 3]);
    }
  }
  const std::vector<bool> is_inner = inner_vertices(chart);
  for (std::size_t v = 0; v < sum.size(); ++v)
    if (is_inner[v])
      worst = std::max({worst, std::abs(sum[v] - 2 * M_PI), std::abs(next[v] / last[v] - 1)});
  return worst;
}

/// What ABF minimises, of the angles that the coordinates have.
double angle_energy(const Chart& chart)
{
  std::vector<double> sum(chart.number_of_vertices(), 0);
  for (std::size_t t = 0; t < chart.number_of_triangles(); ++t)
    for (int i = 0; i < 3; ++i)
      sum[chart.triangles[t][i]] += angles_in_space(chart, t)[i];
  const std::vector<bool> is_inner = inner_vertices(chart);
  double energy = 0;
  for (std::size_t t = 0; t < chart.number_of_triangles(); ++t) {
    const Angles space = angles_in_space(chart, t), plane = angles_in_plane(chart, t);
    for (int i = 0; i < 3; ++i) {
      const Index v = chart.triangles[t][i];
      const double target = space[i] * (is_inner[v] ? 2 * M_PI / sum[v] : 1);
      energy += std::pow(plane[i] / target - 1, 2);
    }
  }
  return energy;
}

/// Ratio of the singular values, from lengths and areas: mean and maximum over the triangles.
std::array<double, 2> quasi_conformal(const Chart& chart)
{
  double sum = 0, total = 0, worst = 0;
  for (std::size_t t = 0; t < chart.number_of_triangles(); ++t) {
    const auto& [a, b, c] = chart.triangles[t];
    const double area = std::sqrt(CGAL::squared_area(chart.points[a], chart.points[b], chart.points[c])),
                 area_uv = CGAL::area(chart.uv[a], chart.uv[b], chart.uv[c]);
    // x^2 + y^2 over 2 x y, by cotangents
    double dirichlet = 0;
    for (int i = 0; i < 3; ++i)
      dirichlet += CGAL::squared_distance(chart.uv[chart.triangles[t][(i + 1) % 3]],
                                          chart.uv[chart.triangles[t][(i + 2) % 3]]) /
                   std::tan(angles_in_space(chart, t)[i]) / 4;
    const double half = std::max(1., dirichlet / area_uv), ratio = half + std::sqrt(half * half - 1);
    sum += ratio * area;
    total += area;
    worst = std::max(worst, ratio);
  }
  return {sum / total, worst};
}

std::size_t number_of_flips(const Chart& chart)
{
  return std::count_if(chart.triangles.begin(), chart.triangles.end(), [&](const auto& t) {
    return CGAL::orientation(chart.uv[t[0]], chart.uv[t[1]], chart.uv[t[2]]) != CGAL::LEFT_TURN;
  });
}

double isometry_defect(const Chart& chart)
{
  double worst = 0;
  for (const auto& t : chart.triangles)
    for (int i = 0; i < 3; ++i) {
      const Index a = t[i], b = t[(i + 1) % 3];
      worst = std::max(worst, std::abs(std::sqrt(CGAL::squared_distance(chart.uv[a], chart.uv[b]) /
                                                 CGAL::squared_distance(chart.points[a], chart.points[b])) -
                                       1));
    }
  return worst;
}

bool is_finite(const Chart& chart)
{
  return chart.uv.size() == chart.points.size() &&
         std::all_of(chart.uv.begin(), chart.uv.end(),
                     [](const Point_2& p) { return std::isfinite(p.x()) && std::isfinite(p.y()); });
}

Chart height_field(Index n, double noise, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> height(-noise / n, noise / n);
  return test::chart_of(test::grid(n, n, [&](double x, double y) { return Point_3(x, y, height(random)); }));
}

/// The part of a sphere above a height in (-1, 1), by rings of quads about the pole.
Chart spherical_cap(double lowest)
{
  test::Soup soup = test::grid(
      24, 12,
      [&](double x, double y) {
        const double z = 1 - (1 - lowest) * (y + 0.05) / 1.05, r = std::sqrt(1 - z * z);
        return Point_3(r * std::cos(2 * M_PI * x), -r * std::sin(2 * M_PI * x), z);
      },
      true);
  const auto pole = static_cast<Index>(soup.points.size());
  soup.points.emplace_back(0, 0, 1);
  for (Index i = 0; i < 24; ++i)
    soup.polygons.push_back({(i + 1) % 24, i, pole});
  return test::chart_of(soup);
}

TEST(ABF_parameterizer, gives_back_a_planar_mesh)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shake(-0.3, 0.3);
  Chart chart = test::chart_of(test::grid(9, 7, [&](double x, double y) {
    const double a = x + shake(random) / 9, b = y + shake(random) / 7;
    return Point_3(3 + 0.6 * a, 0.8 * a, b);
  }));
  ABF_record record;
  ASSERT_EQ(ABF_parameterizer().parameterize(chart, Execution(), record), Chart_status::valid);
  EXPECT_TRUE(record.has_converged);
  EXPECT_LT(record.energy, 1e-20);
  for (std::size_t t = 0; t < chart.number_of_triangles(); ++t)
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(record.angles[t][i], angles_in_space(chart, t)[i], 1e-11);
  EXPECT_LT(isometry_defect(chart), 1e-10);
}

TEST(ABF_parameterizer, unrolls_developable_strips)
{
  Chart cylinder = test::chart_of(
      test::grid(40, 5, [](double x, double y) { return Point_3(std::cos(5 * x), std::sin(5 * x), y); }));
  ASSERT_EQ(ABF_parameterizer().parameterize(cylinder, Execution()), Chart_status::valid);
  EXPECT_LT(isometry_defect(cylinder), 1e-10);
  Chart cone = test::chart_of(test::grid(40, 5, [](double x, double y) {
    return Point_3((1 + y) * std::cos(5 * x), (1 + y) * std::sin(5 * x), 2 * y);
  }));
  Chart folded = test::chart_of(test::grid(30, 4, [](double x, double y) { // an accordion
    return Point_3(0.05 * std::round(30 * x), y, 0.2 * (static_cast<int>(std::round(30 * x)) % 2));
  }));
  for (Chart* chart : {&cone, &folded}) {
    Chart lscm = *chart;
    ABF_record record;
    ASSERT_EQ(ABF_parameterizer().parameterize(*chart, Execution(), record), Chart_status::valid);
    EXPECT_LT(violation(*chart, record.angles), 1e-10);
    ASSERT_EQ(LSCM_parameterizer<>().parameterize(lscm, Execution()), Chart_status::valid);
    for (const auto& [a, b, c] : chart->triangles) // both keep lengths up to how well facets fit the cone
      EXPECT_NEAR(CGAL::squared_distance(chart->uv[a], chart->uv[b]),
                  CGAL::squared_distance(lscm.uv[a], lscm.uv[b]), 1e-3);
  }
  EXPECT_LT(isometry_defect(folded), 1e-10);
}

TEST(ABF_parameterizer, angles_meet_the_conditions_and_the_coordinates_have_these_angles)
{
  for (Chart& chart : std::vector<Chart>{spherical_cap(0), spherical_cap(-0.7), height_field(20, 1, 1),
                                         height_field(20, 2, 2)}) {
    ABF_record record;
    ASSERT_EQ(ABF_parameterizer().parameterize(chart, Execution(), record), Chart_status::valid);
    EXPECT_TRUE(record.has_converged);
    EXPECT_LE(record.iterations, 12);
    EXPECT_LT(violation(chart, record.angles), 1e-10);
    EXPECT_LE(record.violation, 1e-10);
    EXPECT_NEAR(record.energy, angle_energy(chart), 1e-6 * record.energy);
    for (std::size_t t = 0; t < chart.number_of_triangles(); ++t)
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(record.angles[t][i], angles_in_plane(chart, t)[i], 1e-7);
  }
}

/// Any coordinates have angles that meet the conditions; so no coordinates nearby have a smaller energy.
TEST(ABF_parameterizer, no_neighbour_is_better)
{
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (Chart& chart : std::vector<Chart>{spherical_cap(-0.3), height_field(12, 0.5, 3)}) {
    ASSERT_EQ(ABF_parameterizer().parameterize(chart, Execution()), Chart_status::valid);
    const double least = angle_energy(chart);
    Chart lscm = chart;
    ASSERT_EQ(LSCM_parameterizer<>().parameterize(lscm, Execution()), Chart_status::valid);
    EXPECT_GT(angle_energy(lscm), 1.01 * least);
    for (const double size : {1e-2, 1e-3, 1e-4})
      for (int trial = 0; trial < 20; ++trial) {
        Chart moved = chart;
        if (trial % 2 == 0) // one vertex
          moved.uv[random() % moved.uv.size()] += Vector_2(size * normal(random), size * normal(random));
        else // towards LSCM and beyond, as a whole
          for (std::size_t v = 0; v < moved.uv.size(); ++v)
            moved.uv[v] = moved.uv[v] + size * normal(random) * (lscm.uv[v] - CGAL::ORIGIN);
        EXPECT_GE(angle_energy(moved), least * (1 - 1e-9));
      }
  }
}

TEST(ABF_parameterizer, is_at_least_as_conformal_as_lscm_on_a_hemisphere)
{
  for (const double lowest : {0.0, -0.5, -0.9}) {
    Chart abf = spherical_cap(lowest), lscm = abf;
    ASSERT_EQ(ABF_parameterizer().parameterize(abf, Execution()), Chart_status::valid);
    ASSERT_EQ(LSCM_parameterizer<>().parameterize(lscm, Execution()), Chart_status::valid);
    const auto a = quasi_conformal(abf), l = quasi_conformal(lscm);
    EXPECT_LE(a[0], l[0]) << lowest;
    if (lowest > -0.9) {
      EXPECT_LE(a[1], l[1]) << lowest;
    }
    EXPECT_EQ(number_of_flips(abf), 0u);
  }
}

TEST(ABF_parameterizer, does_not_flip_where_lscm_does)
{
  std::size_t lscm_flips = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    Chart abf = height_field(24, 1 + seed, seed), lscm = abf;
    ASSERT_EQ(ABF_parameterizer().parameterize(abf, Execution()), Chart_status::valid);
    ASSERT_EQ(LSCM_parameterizer<>().parameterize(lscm, Execution()), Chart_status::valid);
    EXPECT_EQ(number_of_flips(abf), 0u) << seed;
    lscm_flips += number_of_flips(lscm);
  }
  EXPECT_GT(lscm_flips, 50u);
}

TEST(ABF_parameterizer, does_not_depend_on_the_unit)
{
  Chart chart = spherical_cap(-0.2), large = chart;
  for (Point_3& p : large.points)
    p = Point_3(std::ldexp(p.x(), 400), std::ldexp(p.y(), 400), std::ldexp(p.z(), 400));
  ASSERT_EQ(ABF_parameterizer().parameterize(chart, Execution()), Chart_status::valid);
  ASSERT_EQ(ABF_parameterizer().parameterize(large, Execution()), Chart_status::valid);
  for (std::size_t v = 0; v < chart.uv.size(); ++v) {
    EXPECT_EQ(std::ldexp(chart.uv[v].x(), 400), large.uv[v].x());
    EXPECT_EQ(std::ldexp(chart.uv[v].y(), 400), large.uv[v].y());
  }
}

TEST(ABF_parameterizer, degenerate_triangles_get_finite_coordinates)
{
  const auto bent = [](double y) { return 0.2 * std::sin(5 * y); };
  std::vector<Chart> charts;
  for (const double width : {1e-6, 1e-9, 1e-14, 0.}) // columns of needles
    charts.push_back(test::chart_of(test::grid(10, 6, [&](double x, double y) {
      const int column = static_cast<int>(std::lround(10 * x));
      return Point_3((column / 2 + column % 2 * width) / 5, y, bent(y));
    })));
  for (const double height : {1e-6, 1e-9, 1e-14, 0.}) { // caps
    test::Soup soup = test::grid(6, 6, [&](double x, double y) { return Point_3(x, y, bent(y)); });
    const std::size_t count = soup.polygons.size();
    for (std::size_t i = 0; i < count; i += 3) {
      const std::vector<Index> t = soup.polygons[i];
      const auto v = static_cast<Index>(soup.points.size());
      soup.points.push_back(CGAL::barycenter(soup.points[t[0]], 0.5, soup.points[t[1]], 0.5 - height,
                                             soup.points[t[2]], height));
      soup.polygons[i] = {t[0], t[1], v};
      soup.polygons.insert(soup.polygons.end(), {{t[1], t[2], v}, {t[2], t[0], v}});
    }
    charts.push_back(test::chart_of(soup));
  }
  for (const double size : {0., 1.}) { // all in one place, all on a line
    charts.push_back(test::chart_of(test::planar_grid(4, 4)));
    for (Point_3& p : charts.back().points)
      p = Point_3(1 + size * p.x(), 2, 3);
  }
  for (std::size_t i = 0; i < charts.size(); ++i) {
    ABF_record record;
    EXPECT_EQ(ABF_parameterizer().parameterize(charts[i], Execution(), record), Chart_status::valid) << i;
    EXPECT_TRUE(is_finite(charts[i])) << i;
    EXPECT_TRUE(record.has_converged) << i << ' ' << record.violation;
  }
  for (const std::size_t i : {0u, 1u, 4u, 5u}) // thin, but with an area that double precision can tell
    EXPECT_EQ(number_of_flips(charts[i]), 0u) << i;
}

TEST(ABF_parameterizer, single_triangles_and_refusals)
{
  Chart triangle = test::chart_of({{{0, 0, 0}, {0, 0, 3}, {0, 4, 0}}, {{0, 1, 2}}});
  ASSERT_EQ(ABF_parameterizer().parameterize(triangle, Execution()), Chart_status::valid);
  EXPECT_LT(isometry_defect(triangle), 1e-14);
  Chart sphere = test::chart_of(test::sphere(1)), torus = test::chart_of(test::torus(5, 4)), none;
  for (Chart* chart : {&sphere, &torus, &none})
    EXPECT_EQ(ABF_parameterizer().parameterize(*chart, Execution()), Chart_status::not_a_disc);
  Chart chart = spherical_cap(0);
  const Execution execution;
  execution.cancel();
  EXPECT_EQ(ABF_parameterizer().parameterize(chart, execution), Chart_status::cancelled);
  EXPECT_THROW((void)ABF_parameterizer(0), Invalid_argument);
  ABF_record record;
  ASSERT_EQ(ABF_parameterizer(1).parameterize(chart, Execution(), record), Chart_status::valid);
  EXPECT_FALSE(record.has_converged);
  EXPECT_EQ(record.iterations, 1);
}

} // namespace
