// SPDX-License-Identifier: MIT
#include <Atlas/core/errors.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/parameterization/LSCM_traits.h>
#include <Atlas/parameterization/Spectral_parameterizer.h>

#include <Eigen/Dense>

#include "test_meshes.h"

namespace {

using namespace Atlas;
using Complex = std::complex<double>;

Chart wavy(Index m = 6, Index n = 5)
{
  return test::chart_of(test::grid(m, n, [](double x, double y) {
    return Point_3(x, 0.8 * y, 0.1 * std::sin(7 * x) * std::cos(5 * y + 1));
  }));
}

/// The whole matrix, from what the documentation says of the entries.
Eigen::MatrixXcd dense(const LSCM_system& system)
{
  const auto n = static_cast<Eigen::Index>(system.size());
  Eigen::MatrixXcd h = Eigen::MatrixXcd::Zero(n, n);
  for (int c = 0; c < n; ++c)
    for (int k = system.first[c]; k < system.first[c + 1]; ++k) {
      h(system.row[k], c) = system.value[k];
      h(c, system.row[k]) = std::conj(system.value[k]);
    }
  return h;
}

/// A solver that an outsider could have written.
class Dense_solver
{
public:
  bool factorize(const LSCM_system& system, const Execution&)
  {
    ldlt_.compute(dense(system));
    return ldlt_.info() == Eigen::Success;
  }
  bool solve(std::span<Complex> b)
  {
    Eigen::Map<Eigen::VectorXcd> x(b.data(), static_cast<Eigen::Index>(b.size()));
    x = ldlt_.solve(x.eval()).eval();
    return true;
  }

private:
  Eigen::LDLT<Eigen::MatrixXcd> ldlt_;
};

TEST(LSCM_system, is_a_lower_triangle_in_sorted_compressed_columns)
{
  const Chart chart = wavy();
  const std::vector<LSCM_pin> pins{{3, Point_2(0, 0)}, {20, Point_2(1, 0)}};
  const LSCM_system system = lscm_system(chart, pins);
  ASSERT_EQ(system.size(), chart.number_of_vertices() - 2);
  ASSERT_EQ(system.row.size(), system.value.size());
  ASSERT_EQ(static_cast<std::size_t>(system.first.back()), system.row.size());
  ASSERT_EQ(system.unknown.size(), chart.number_of_vertices());
  int count = 0;
  for (Index v = 0; v < system.unknown.size(); ++v)
    EXPECT_EQ(system.unknown[v], v == 3 || v == 20 ? -1 : count++);
  std::size_t complex_entries = 0;
  for (std::size_t c = 0; c < system.size(); ++c) {
    ASSERT_LT(system.first[c], system.first[c + 1]);
    EXPECT_EQ(system.row[system.first[c]], static_cast<int>(c));
    EXPECT_EQ(system.value[system.first[c]].imag(), 0);
    for (int k = system.first[c] + 1; k < system.first[c + 1]; ++k) {
      EXPECT_GT(system.row[k], system.row[k - 1]);
      complex_entries += system.value[k].imag() != 0;
    }
  }
  std::size_t free_border_edges = 0;
  const std::vector<Index> opposite = internal::opposite_halfedges(chart.triangles);
  for (Index h = 0; h < opposite.size(); ++h) {
    const Index g = next_halfedge(h);
    free_border_edges += opposite[h] == no_index && system.unknown[chart.triangles[h / 3][h % 3]] >= 0 &&
                         system.unknown[chart.triangles[g / 3][g % 3]] >= 0;
  }
  EXPECT_GT(free_border_edges, 15u);
  EXPECT_EQ(complex_entries, free_border_edges);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> eigen(dense(system));
  EXPECT_GT(eigen.eigenvalues()[0], 0);
}

TEST(LSCM_system, is_half_of_the_square_of_the_papers_matrix)
{
  const Chart chart = wavy();
  const LSCM_system system =
      lscm_system(chart, std::vector<LSCM_pin>{{0, Point_2(0, 0)}, {41, Point_2(1, 0)}});
  const std::vector<LSCM_system::Row> rows = system.least_squares_rows();
  ASSERT_EQ(rows.size(), chart.number_of_triangles());
  Eigen::MatrixXcd m = Eigen::MatrixXcd::Zero(static_cast<Eigen::Index>(rows.size()),
                                              static_cast<Eigen::Index>(system.size()));
  for (std::size_t t = 0; t < rows.size(); ++t) {
    Complex sum = 0;
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(rows[t].unknown[i], system.unknown[chart.triangles[t][i]]);
      sum += rows[t].entry[i];
      if (rows[t].unknown[i] >= 0)
        m(static_cast<Eigen::Index>(t), rows[t].unknown[i]) = rows[t].entry[i];
    }
    EXPECT_LT(std::abs(sum), 1e-13); // the edges of a triangle
  }
  EXPECT_LT((m.adjoint() * m / 2 - dense(system)).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(LSCM_system, takes_solvers_from_outside)
{
  for (Chart chart : {wavy(), wavy(20, 3)}) {
    Chart expected = chart, spectral = chart, expected_spectral = chart;
    LSCM_record record;
    const LSCM_parameterizer<Basic_LSCM_traits<Dense_solver>> lscm;
    ASSERT_EQ(lscm.parameterize(chart, Execution(), record), Chart_status::valid);
    ASSERT_EQ(LSCM_parameterizer<>().parameterize(expected, Execution()), Chart_status::valid);
    EXPECT_LT(record.residual, 1e-10);
    ASSERT_EQ(Spectral_parameterizer<Dense_solver>().parameterize(spectral, Execution()),
              Chart_status::valid);
    ASSERT_EQ(Spectral_parameterizer<>().parameterize(expected_spectral, Execution()), Chart_status::valid);
    for (Index v = 0; v < chart.uv.size(); ++v) {
      EXPECT_LT((chart.uv[v] - expected.uv[v]).squared_length(), 1e-22);
      EXPECT_LT((spectral.uv[v] - expected_spectral.uv[v]).squared_length(), 1e-16);
    }
  }
}

TEST(LSCM_system, solvers_may_be_asked_before_there_is_a_factorization)
{
  std::vector<Complex> b(3, 1);
  EXPECT_FALSE(Direct_LSCM_solver().solve(b));
  EXPECT_FALSE(Conjugate_gradient_LSCM_solver().solve(b));
}

/// The name of the argument that is said to be at fault.
template <typename Call>
std::string fault_of(Call call)
{
  try {
    call();
  } catch (const Invalid_argument& error) {
    return error.argument();
  }
  return "none";
}

TEST(LSCM_system, pins_are_checked)
{
  Chart chart = wavy();
  const auto pinned = [&](const std::vector<LSCM_pin>& pins) {
    return fault_of([&] {
      const LSCM_parameterizer<> lscm{Eigen_LSCM_traits(pins)};
      (void)lscm.parameterize(chart, Execution());
    });
  };
  const Point_2 o(0, 0), x(1, 0);
  EXPECT_EQ(pinned({{0, o}, {1, x}}), "none");
  EXPECT_EQ(pinned({{0, o}}), "pins");
  EXPECT_EQ(pinned({{0, o}, {1, o}, {2, o}}), "pins");
  EXPECT_EQ(pinned({{0, o}, {0, x}}), "pins");
  EXPECT_EQ(pinned({{0, o}, {static_cast<Index>(chart.number_of_vertices()), x}}), "pins");
  EXPECT_EQ(pinned({{0, o}, {1, Point_2(std::nan(""), 0)}}), "pins");
  EXPECT_EQ(fault_of([&] { (void)lscm_system(chart, std::vector<LSCM_pin>{{10000, o}}); }), "pins");
  chart.triangles.push_back({0, 1, static_cast<Index>(chart.number_of_vertices())});
  EXPECT_EQ(pinned({{0, o}, {1, x}}), "chart");
  EXPECT_EQ(fault_of([&] { (void)Spectral_parameterizer<>().parameterize(chart, Execution()); }), "chart");
}

} // namespace
