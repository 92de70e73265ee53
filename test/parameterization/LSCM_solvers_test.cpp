// SPDX-License-Identifier: MIT
// Solvers of the LSCM system that iterate, and the one that works out of core, beside the direct one.
#include <Atlas/core/errors.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/parameterization/LSCM_traits.h>
#include <Atlas/parameterization/internal/conformal/hermitian_multifrontal.h>

#include "test_meshes.h"
#include <filesystem>
#include <fstream>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

using namespace Atlas;
using Complex = std::complex<double>;

static_assert(LSCMTraits<Preconditioned_CG_LSCM_traits>);
static_assert(LSCMTraits<Multigrid_LSCM_traits>);
static_assert(LSCMTraits<Out_of_core_LSCM_traits>);

/// Bumps at all scales.
Chart terrain(Index side)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-0.3, 0.3);
  return test::chart_of(test::grid(side, side, [&](double x, double y) {
    double z = 0;
    for (double f = 3; f < side / 2.; f *= 2)
      z += 0.3 / f * std::sin(f * x + 3 * f * y) * std::cos(2 * f * x - f * y + f);
    return Point_3(x, y, z + 0.3 / side * noise(random));
  }));
}

/// Discs that are not kind to solvers: bumps at all scales; triangles of sizes from 1 to 1e-4; rough with a
/// round border; a narrow strip that winds.
std::vector<Chart> discs(Index side)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-0.3, 0.3);
  const double h = 1. / side;
  const auto graded = [](double x, double y) {
    return Point_3(std::pow(x, 4) + 0.01 * x, y * y * y + 0.01 * y, 0.2 * std::cos(6 * x + 3 * y));
  };
  const auto rough = [&](double x, double y) {
    x = 2 * x - 1 + h * noise(random);
    y = 2 * y - 1 + h * noise(random);
    return Point_3(x * std::sqrt(1 - y * y / 3), y * std::sqrt(1 - x * x / 3), 0.4 * std::sin(4 * x) * y);
  };
  const auto spiral = [&](double x, double y) {
    const double angle = 12 * x, r = 0.3 + 0.1 * angle + 0.04 * y;
    return Point_3(r * std::cos(angle), r * std::sin(angle), 0.1 * h * noise(random));
  };
  return {terrain(side), test::chart_of(test::grid(side, side, graded)),
          test::chart_of(test::grid(side, side, rough)),
          test::chart_of(test::grid(side * side / 9, 9, spiral))};
}

/// H x.
std::vector<Complex> product(const LSCM_system& system, const std::vector<Complex>& x)
{
  std::vector<Complex> y(x.size(), 0);
  for (std::size_t c = 0; c < system.size(); ++c)
    for (int k = system.first[c]; k < system.first[c + 1]; ++k) {
      const auto r = static_cast<std::size_t>(system.row[k]);
      y[r] += system.value[k] * x[c];
      if (r != c)
        y[c] += std::conj(system.value[k]) * x[r];
    }
  return y;
}

/// |b - H x| / |b|.
double relative_residual(const LSCM_system& system, const std::vector<Complex>& x,
                         const std::vector<Complex>& b)
{
  double before = 0, after = 0;
  const std::vector<Complex> y = product(system, x);
  for (std::size_t i = 0; i < b.size(); ++i) {
    before += std::norm(b[i]);
    after += std::norm(b[i] - y[i]);
  }
  return std::sqrt(after / before);
}

double largest_difference(const Chart& a, const Chart& b)
{
  double largest = 0;
  for (std::size_t v = 0; v < a.uv.size(); ++v)
    largest = std::max(largest, std::sqrt((a.uv[v] - b.uv[v]).squared_length()));
  return largest;
}

template <typename Traits>
struct LSCM_iteration_test : testing::Test
{};
using Iterative_traits = testing::Types<Preconditioned_CG_LSCM_traits, Multigrid_LSCM_traits>;
TYPED_TEST_SUITE(LSCM_iteration_test, Iterative_traits);

TYPED_TEST(LSCM_iteration_test, agrees_with_the_direct_solver)
{
  for (const Index side : {4, 70})
    for (Chart chart : discs(side)) {
      Chart expected = chart;
      LSCM_record record;
      ASSERT_EQ(LSCM_parameterizer<>().parameterize(expected, Execution()), Chart_status::valid);
      ASSERT_EQ(LSCM_parameterizer<TypeParam>().parameterize(chart, Execution(), record),
                Chart_status::valid);
      EXPECT_LT(largest_difference(chart, expected), 1e-9);
      EXPECT_LT(record.residual, 1e-4); // the first solution has some digits, the second the others
    }
}

TYPED_TEST(LSCM_iteration_test, reaches_the_residual_that_it_states)
{
  for (const Chart& chart : discs(70)) {
    const Index last = static_cast<Index>(chart.number_of_vertices() - 1);
    const LSCM_system system =
        lscm_system(chart, std::vector<LSCM_pin>{{0, Point_2(0, 0)}, {last, Point_2(1, 1)}});
    std::vector<Complex> x(system.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = {std::cos(0.1 * static_cast<double>(i)), std::sin(static_cast<double>(i % 17))};
    const std::vector<Complex> b = product(system, x);
    x = b;
    typename TypeParam::Solver solver;
    EXPECT_FALSE(solver.solve(x));
    ASSERT_TRUE(solver.factorize(system, Execution()));
    ASSERT_TRUE(solver.solve(x));
    EXPECT_LE(relative_residual(system, x, b), 1e-8);
    EXPECT_NEAR(solver.record().residual, relative_residual(system, x, b), 1e-9);
    EXPECT_GT(solver.record().iterations, 1u);
    std::vector<Complex> zero(system.size(), 0);
    EXPECT_TRUE(solver.solve(zero));
    EXPECT_EQ(zero, std::vector<Complex>(system.size(), 0));
    EXPECT_EQ(solver.record().iterations, 0u);
  }
}

TYPED_TEST(LSCM_iteration_test, a_run_can_be_cancelled)
{
  Chart chart = discs(70)[0];
  const Execution execution;
  execution.cancel();
  EXPECT_EQ(LSCM_parameterizer<TypeParam>().parameterize(chart, execution), Chart_status::cancelled);
}

TEST(Preconditioned_CG, needs_a_handful_of_iterations)
{
  for (const Chart& chart : discs(100)) {
    const Index last = static_cast<Index>(chart.number_of_vertices() - 1);
    const LSCM_system system =
        lscm_system(chart, std::vector<LSCM_pin>{{0, Point_2(0, 0)}, {last, Point_2(1, 1)}});
    Preconditioned_CG_LSCM_solver solver;
    std::vector<Complex> b(system.size(), 0);
    b.front() = 1;
    ASSERT_TRUE(solver.factorize(system, Execution()));
    ASSERT_TRUE(solver.solve(b));
    EXPECT_LE(solver.record().iterations, 12u);
  }
}

/// A line of /proc/self/status in bytes; 0 where there is no such file.
std::size_t memory(const std::string& name)
{
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == name + ":") {
      std::size_t kilobytes = 0;
      status >> kilobytes;
      return 1024 * kilobytes;
    }
  return 0;
}

/// The most memory that a call has at a time, beyond what there was before.
template <typename Call>
std::size_t peak_memory(Call call)
{
#ifdef __GLIBC__
  malloc_trim(0); // what was freed before would hide what is taken now
#endif
  std::ofstream("/proc/self/clear_refs") << 5; // Linux resets the peak on request
  const std::size_t before = memory("VmRSS");
  call();
  return memory("VmHWM") - before;
}

TEST(Out_of_core, keeps_to_its_memory_limit_and_gives_the_same_coordinates)
{
  const std::filesystem::path directory =
      std::filesystem::path(testing::TempDir()) / "atlas_out_of_core_test";
  std::filesystem::create_directories(directory);
  constexpr std::size_t limit = 96'000'000;
  Chart chart = terrain(400), expected = chart;
  const std::size_t out_of_core = peak_memory([&] {
    const LSCM_parameterizer<Out_of_core_LSCM_traits> lscm{
        Out_of_core_LSCM_traits(limit, directory.string())};
    ASSERT_EQ(lscm.parameterize(chart, Execution()), Chart_status::valid);
  });
  EXPECT_LT(out_of_core, limit);
  ASSERT_EQ(LSCM_parameterizer<>().parameterize(expected, Execution()), Chart_status::valid);
  EXPECT_EQ(chart.uv, expected.uv);
  EXPECT_TRUE(std::filesystem::is_empty(directory));
  std::filesystem::remove(directory);

  // In memory the factor alone is more than the limit.
  internal::Hermitian_multifrontal factor;
  ASSERT_TRUE(factor.factorize(lscm_system(chart, std::vector<LSCM_pin>{{0, {}}, {1, {}}}), Execution()));
  EXPECT_GT(factor.factor_size() * sizeof(double), limit);
}

TEST(Out_of_core, says_when_the_limit_is_too_low_or_there_is_no_place_for_the_file)
{
  Chart chart = discs(70)[1];
  const auto status = [&](std::size_t limit, const std::string& directory) {
    return LSCM_parameterizer<Out_of_core_LSCM_traits>(Out_of_core_LSCM_traits(limit, directory))
        .parameterize(chart, Execution());
  };
  EXPECT_EQ(status(1'000'000, ""), Chart_status::solver_failed);
  EXPECT_EQ(status(1'000'000'000, "no such directory"), Chart_status::solver_failed);
  EXPECT_EQ(status(1'000'000'000, ""), Chart_status::valid);
  std::vector<Complex> b(3, 1);
  EXPECT_FALSE(Out_of_core_LSCM_solver().solve(b));
}

} // namespace
