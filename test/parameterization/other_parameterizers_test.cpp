// SPDX-License-Identifier: MIT
// The methods that the LSCM paper compares with, where their results are known in closed form.
#include <Atlas/core/concepts.h>
#include <Atlas/core/errors.h>
#include <Atlas/parameterization/ARAP_parameterizer.h>
#include <Atlas/parameterization/Distortion_optimizer.h>
#include <Atlas/parameterization/Fixed_border_parameterizer.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/parameterization/Spectral_parameterizer.h>
#include <Atlas/parameterization/internal/conformal/conformal_energy.h>
#include <Atlas/parameterization/internal/distortion/distortion_energy.h>
#include <Atlas/parameterization/internal/geometry/border.h>
#include <Atlas/parameterization/internal/geometry/injectivity.h>

#include <Eigen/Dense>

#include "test_meshes.h"

namespace {

using namespace Atlas;
using Complex = std::complex<double>;

static_assert(ChartParameterizer<ARAP_parameterizer>);
static_assert(ChartParameterizer<Harmonic_parameterizer>);
static_assert(ChartParameterizer<Mean_value_parameterizer>);
static_assert(ChartParameterizer<Floater_parameterizer>);
static_assert(ChartParameterizer<Spectral_parameterizer<>>);
static_assert(UVOptimizer<MIPS_optimizer>);
static_assert(UVOptimizer<Stretch_optimizer>);
static_assert(UVOptimizer<Conformal_stretch_optimizer>);

Chart wavy()
{
  return test::chart_of(test::grid(16, 12, [](double x, double y) {
    return Point_3(x, 0.8 * y, 0.15 * std::sin(7 * x) * std::cos(5 * y + 1));
  }));
}

Chart cylinder()
{
  return test::chart_of(
      test::grid(20, 5, [](double x, double y) { return Point_3(std::cos(5 * x), std::sin(5 * x), y); }));
}

/// A flat disc in space: rings of n vertices about the centre, the inner ones shaken.
Chart disc(Index rings, Index n)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-0.2, 0.2);
  test::Soup soup;
  const auto at = [](double r, double a) {
    const double x = r * std::cos(a), y = r * std::sin(a);
    return Point_3(x, 0.6 * y, 0.8 * y);
  };
  soup.points.push_back(at(0, 0));
  for (Index k = 1; k <= rings; ++k)
    for (Index i = 0; i < n; ++i) {
      const double shake = k < rings ? 1 : 0;
      soup.points.push_back(
          at((k + shake * noise(random)) / rings, 2 * M_PI * (i + shake * noise(random)) / n));
    }
  for (Index i = 0; i < n; ++i)
    soup.polygons.push_back({0, 1 + i, 1 + (i + 1) % n});
  for (Index k = 0; k + 1 < rings; ++k)
    for (Index i = 0; i < n; ++i) {
      const Index a = 1 + k * n + i, b = 1 + k * n + (i + 1) % n, c = a + n, d = b + n;
      soup.polygons.insert(soup.polygons.end(), {{a, c, d}, {a, d, b}});
    }
  return test::chart_of(soup);
}

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

/// Area and both singular values of each triangle's map, by Eigen's SVD.
std::vector<std::array<double, 3>> singular_values(const Chart& chart)
{
  std::vector<std::array<double, 3>> result;
  for (const auto& [a, b, c] : chart.triangles) {
    const Vector_3 p = chart.points[b] - chart.points[a], q = chart.points[c] - chart.points[a];
    const double length = std::sqrt(p.squared_length()),
                 height = std::sqrt(CGAL::cross_product(p, q).squared_length()) / length;
    Eigen::Matrix2d space, plane;
    space << length, p * q / length, 0, height;
    const Vector_2 s = chart.uv[b] - chart.uv[a], t = chart.uv[c] - chart.uv[a];
    plane << s.x(), t.x(), s.y(), t.y();
    const Eigen::Vector2d values =
        Eigen::JacobiSVD<Eigen::Matrix2d>(plane * space.inverse()).singularValues();
    result.push_back({length * height / 2, values[0], values[1]});
  }
  return result;
}

/// Sander et al. 2001, scaled so that 1 is the least possible.
double l2_stretch(const Chart& chart)
{
  double sum = 0, space = 0, plane = 0;
  for (const auto& [area, x, y] : singular_values(chart)) {
    sum += area * (1 / (x * x) + 1 / (y * y)) / 2;
    space += area;
    plane += area * x * y;
  }
  return std::sqrt(sum * plane) / space;
}

template <typename Energy>
void check_derivatives(const Energy& energy)
{
  for (const double x : {0.3, 1., 1.4, 3.})
    for (const double y : {0.2, 0.9, 1.}) {
      if (y > x)
        continue;
      const double r = (x + y) / 2, s = (x - y) / 2, h = 1e-6;
      const auto value = [&](double a, double b) { return energy.value(a * a, b * b); };
      const internal::Triangle_energy d = energy.derivatives(x, y);
      const double scale = std::abs(value(r, s)) / (y * y);
      EXPECT_NEAR(d.value, value(r, s), 1e-12 * scale);
      EXPECT_NEAR(d.dr, (value(r + h, s) - value(r - h, s)) / (2 * h), 1e-7 * scale);
      EXPECT_NEAR(d.ds, (value(r, s + h) - value(r, s - h)) / (2 * h), 1e-7 * scale);
      EXPECT_GE(d.krr, 0);
      EXPECT_GE(d.krr * d.kss - d.krs * d.krs, -1e-12 * d.krr * d.kss);
      EXPECT_GE(d.tangential_f, 0);
      if (s > 0) {
        EXPECT_GE(d.tangential_g, std::max(0., d.ds / s) - 1e-9 * scale / (y * y));
        if (std::is_empty_v<Energy>) { // a sum of positive parts may be more
          EXPECT_NEAR(d.tangential_g, std::max(0., d.ds / s), 1e-9 * scale / (y * y));
        }
      }
    }
  EXPECT_NEAR(energy.value(1, 0), Energy::isometry, 1e-15);
  EXPECT_EQ(energy.value(1, 1), std::numeric_limits<double>::infinity());
}

TEST(Distortion_energy, derivatives_agree_with_differences)
{
  check_derivatives(internal::Symmetric_dirichlet());
  check_derivatives(internal::Mips());
  check_derivatives(internal::Stretch());
  for (const double weight : {0., 0.3, 1.})
    check_derivatives(internal::Conformal_stretch{weight});
  for (const unsigned exponent : {1u, 2u, 3u, 6u}) {
    check_derivatives(internal::Power_of_energy<internal::Symmetric_dirichlet>{{}, exponent});
    check_derivatives(internal::Power_of_energy<internal::Conformal_stretch>{{0.3}, exponent});
  }
}

TEST(Fixed_border_parameterizer, flat_discs_are_reproduced)
{
  // All three have linear precision: with the true border, the true inner vertices solve the equations.
  const Chart flat = disc(5, 24);
  Chart harmonic = flat, mean_value = flat, floater = flat, tutte = flat;
  ASSERT_EQ(Harmonic_parameterizer().parameterize(harmonic, Execution()), Chart_status::valid);
  ASSERT_EQ(Mean_value_parameterizer().parameterize(mean_value, Execution()), Chart_status::valid);
  ASSERT_EQ(Floater_parameterizer().parameterize(floater, Execution()), Chart_status::valid);
  ASSERT_EQ(Tutte_parameterizer().parameterize(tutte, Execution()), Chart_status::valid);
  EXPECT_LT(isometry_defect(harmonic), 1e-10);
  EXPECT_LT(isometry_defect(mean_value), 1e-10);
  EXPECT_LT(isometry_defect(floater), 1e-10);
  EXPECT_GT(isometry_defect(tutte), 1e-3); // which sees no shapes
}

TEST(Fixed_border_parameterizer, harmonic_maps_have_the_least_dirichlet_energy)
{
  const auto dirichlet = [](const Chart& chart) {
    double sum = 0;
    for (const auto& [area, x, y] : singular_values(chart))
      sum += area * (x * x + y * y) / 2;
    return sum;
  };
  Chart harmonic = wavy(), mean_value = wavy(), floater = wavy();
  ASSERT_EQ(Harmonic_parameterizer().parameterize(harmonic, Execution()), Chart_status::valid);
  ASSERT_EQ(Mean_value_parameterizer().parameterize(mean_value, Execution()), Chart_status::valid);
  ASSERT_EQ(Floater_parameterizer().parameterize(floater, Execution()), Chart_status::valid);
  EXPECT_LT(dirichlet(harmonic), dirichlet(mean_value));
  EXPECT_LT(dirichlet(harmonic), dirichlet(floater));
  internal::Injectivity_checker checker(floater);
  for (const Chart* chart : {&mean_value, &floater}) {
    std::vector<Complex> u;
    for (const Point_2& p : chart->uv)
      u.emplace_back(p.x(), p.y());
    EXPECT_TRUE(checker.is_one_to_one(u));
  }
}

TEST(Spectral_parameterizer, is_isometric_where_lscm_is)
{
  Chart chart = cylinder();
  ASSERT_EQ(Spectral_parameterizer<>().parameterize(chart, Execution()), Chart_status::valid);
  EXPECT_LT(isometry_defect(chart), 1e-9);
}

TEST(Spectral_parameterizer, solves_the_generalized_eigenvalue_problem)
{
  Chart chart = wavy(), lscm = wavy();
  ASSERT_EQ(Spectral_parameterizer<>().parameterize(chart, Execution()), Chart_status::valid);
  ASSERT_EQ(LSCM_parameterizer<>().parameterize(lscm, Execution()), Chart_status::valid);
  const internal::Chart_geometry geometry(chart);
  const internal::Conformal_energy energy(geometry);
  const std::vector<bool> border = internal::border_vertices(chart);
  const auto centred = [&](const Chart& c) {
    std::vector<Complex> x;
    Complex mean = 0;
    double count = 0;
    for (Index v = 0; v < c.uv.size(); ++v) {
      x.emplace_back(c.uv[v].x(), c.uv[v].y());
      mean += border[v] ? x[v] : Complex(0);
      count += border[v];
    }
    for (Complex& z : x)
      z -= mean / count;
    return x;
  };
  const auto quotient = [&](const std::vector<Complex>& x) {
    double variance = 0;
    for (Index v = 0; v < x.size(); ++v)
      variance += border[v] ? std::norm(x[v]) : 0;
    return 2 * energy.value(x) / variance;
  };
  const std::vector<Complex> x = centred(chart);
  const double eigenvalue = quotient(x);
  EXPECT_LT(eigenvalue, quotient(centred(lscm)));
  std::vector<Complex> r; // -H x
  energy.residual(x, r);
  double error = 0, size = 0;
  for (Index v = 0; v < x.size(); ++v) {
    const Complex bx = border[v] ? eigenvalue * x[v] : Complex(0);
    error += std::norm(r[v] + bx);
    size += std::norm(bx);
  }
  EXPECT_LT(std::sqrt(error / size), 1e-3);
}

TEST(ARAP_parameterizer, is_isometric_on_developable_charts_and_lowers_its_energy_elsewhere)
{
  Chart flat = cylinder();
  ASSERT_EQ(ARAP_parameterizer().parameterize(flat, Execution()), Chart_status::valid);
  EXPECT_LT(isometry_defect(flat), 1e-9);
  const auto energy = [](const Chart& chart) {
    double sum = 0;
    for (const auto& [area, x, y] : singular_values(chart))
      sum += area * ((x - 1) * (x - 1) + (y - 1) * (y - 1));
    return sum;
  };
  Chart arap = wavy(), lscm = wavy(), dirichlet = wavy();
  ASSERT_EQ(ARAP_parameterizer(1000, 1e-12).parameterize(arap, Execution()), Chart_status::valid);
  ASSERT_EQ(LSCM_parameterizer<>().parameterize(lscm, Execution()), Chart_status::valid);
  dirichlet.uv = lscm.uv;
  ASSERT_EQ(Symmetric_dirichlet_optimizer().optimize(dirichlet, Execution()), Chart_status::valid);
  EXPECT_LT(energy(arap), energy(lscm));
  EXPECT_LT(energy(arap), energy(dirichlet));
}

TEST(ARAP_parameterizer, checks_its_arguments)
{
  EXPECT_THROW((void)ARAP_parameterizer(10, -1e-6), Invalid_argument);
  EXPECT_THROW((void)ARAP_parameterizer(10, std::nan("")), Invalid_argument);
}

/// Mean of (x/y + y/x) / 2; a conformal map has 1.
double mean_mips(const Chart& chart)
{
  double sum = 0, total = 0;
  for (const auto& [area, x, y] : singular_values(chart)) {
    sum += area * (x / y + y / x) / 2;
    total += area;
  }
  return sum / total;
}

TEST(MIPS_optimizer, makes_maps_conformal)
{
  Distortion_options options;
  options.tolerance = 1e-12;
  options.max_iterations = 300;
  Chart flat = cylinder();
  ASSERT_EQ(Tutte_parameterizer().parameterize(flat, Execution()), Chart_status::valid);
  Distortion_record record;
  ASSERT_EQ(MIPS_optimizer(options).optimize(flat, Execution(), record), Chart_status::valid);
  EXPECT_NEAR(record.after, 1, 1e-6);
  EXPECT_LT(isometry_defect(flat), 0.01);

  Chart chart = wavy();
  ASSERT_EQ(LSCM_parameterizer<>().parameterize(chart, Execution()), Chart_status::valid);
  Chart dirichlet = chart;
  const double lscm = mean_mips(chart);
  ASSERT_EQ(MIPS_optimizer(options).optimize(chart, Execution(), record), Chart_status::valid);
  ASSERT_EQ(Symmetric_dirichlet_optimizer().optimize(dirichlet, Execution()), Chart_status::valid);
  EXPECT_NEAR(record.before, lscm, 1e-9);
  EXPECT_NEAR(record.after, mean_mips(chart), 1e-9);
  EXPECT_LT(record.after, lscm);
  EXPECT_LT(record.after, mean_mips(dirichlet));
}

TEST(Conformal_stretch_optimizer, trades_conformality_for_stretch)
{
  Chart start = test::chart_of(test::grid(14, 14, [](double x, double y) {
    return Point_3(x, y, std::exp(-12 * ((x - 0.4) * (x - 0.4) + (y - 0.5) * (y - 0.5))));
  }));
  ASSERT_EQ(Tutte_parameterizer().parameterize(start, Execution()), Chart_status::valid);
  Distortion_options options;
  options.tolerance = 1e-10;
  options.max_iterations = 300;
  Chart conformal = start, stretch = start;
  ASSERT_EQ(MIPS_optimizer(options).optimize(conformal, Execution()), Chart_status::valid);
  ASSERT_EQ(Stretch_optimizer(options).optimize(stretch, Execution()), Chart_status::valid);
  double last_conformal = 0, last_stretch = std::numeric_limits<double>::infinity();
  for (const double weight : {0., 0.1, 0.3, 0.6, 0.9, 1.}) {
    options.stretch_weight = weight;
    Chart chart = start;
    ASSERT_EQ(Conformal_stretch_optimizer(options).optimize(chart, Execution()), Chart_status::valid);
    EXPECT_GT(mean_mips(chart), last_conformal + 1e-5) << weight;
    EXPECT_LT(l2_stretch(chart), last_stretch - 1e-5) << weight;
    last_conformal = mean_mips(chart);
    last_stretch = l2_stretch(chart);
    if (weight == 0) {
      EXPECT_EQ(chart.uv, conformal.uv);
    }
    if (weight == 1) {
      EXPECT_EQ(chart.uv, stretch.uv);
    }
  }
  for (const double weight : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    options.stretch_weight = weight;
    EXPECT_THROW(Conformal_stretch_optimizer{options}, Invalid_argument);
  }
}

TEST(Stretch_optimizer, lowers_the_stretch_of_sander_et_al)
{
  Distortion_options options;
  options.tolerance = 1e-10;
  options.max_iterations = 200;
  Chart flat = cylinder();
  ASSERT_EQ(Tutte_parameterizer().parameterize(flat, Execution()), Chart_status::valid);
  EXPECT_GT(l2_stretch(flat), 1.1);
  ASSERT_EQ(Stretch_optimizer(options).optimize(flat, Execution()), Chart_status::valid);
  EXPECT_NEAR(l2_stretch(flat), 1, 1e-6);

  Chart chart = wavy();
  ASSERT_EQ(LSCM_parameterizer<>().parameterize(chart, Execution()), Chart_status::valid);
  Chart dirichlet = chart;
  const double before = l2_stretch(chart);
  Distortion_record record;
  ASSERT_EQ(Stretch_optimizer(options).optimize(chart, Execution(), record), Chart_status::valid);
  ASSERT_EQ(Symmetric_dirichlet_optimizer(options).optimize(dirichlet, Execution()), Chart_status::valid);
  EXPECT_LT(l2_stretch(chart), before);
  EXPECT_LT(l2_stretch(chart), l2_stretch(dirichlet));
}

} // namespace
