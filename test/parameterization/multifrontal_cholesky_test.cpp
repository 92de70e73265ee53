// SPDX-License-Identifier: MIT
#include <Atlas/parameterization/internal/sparse/Vertex_block_cholesky.h>

#include <Eigen/Dense>

#include "test_meshes.h"

namespace {

using namespace Atlas;
using Complex = std::complex<double>;

TEST(Multifrontal_cholesky, solves_hermitian_and_block_systems)
{
  // Random positive definite matrices on the graph of a chart, against Eigen's dense solver.
  const Chart chart = test::chart_of(test::planar_grid(9, 7));
  const internal::Graph graph = internal::vertex_graph(chart);
  const auto n = static_cast<Eigen::Index>(graph.size());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> value(-1, 1);
  Eigen::MatrixXcd dense = Eigen::MatrixXcd::Zero(n, n);
  std::vector<Complex> entries(graph.neighbor.size());
  for (Eigen::Index v = 0; v < n; ++v) {
    dense(v, v) = 9;
    for (std::size_t k = graph.first[v]; k < graph.first[v + 1]; ++k)
      if (graph.neighbor[k] > v) {
        const Complex z(value(random), graph.neighbor[k] % 3 == 0 ? value(random) : 0);
        dense(v, graph.neighbor[k]) = z;
        dense(graph.neighbor[k], v) = std::conj(z);
      }
    for (std::size_t k = graph.first[v]; k < graph.first[v + 1]; ++k)
      entries[k] = dense(v, graph.neighbor[k]);
  }
  const internal::Supernodal_symbolic symbolic(graph, internal::approximate_minimum_degree(graph));
  internal::Multifrontal_cholesky<1> cholesky(symbolic);
  for (int round = 0; round < 2; ++round) { // the second reuses the memory of the first
    ASSERT_TRUE(cholesky.factorize(
        [](Index, auto add) { add(0, 0, 9.); },
        [&](std::size_t k, auto add) { add(0, 0, std::conj(entries[symbolic.lower_source(k)])); },
        [&](std::size_t k) { return entries[symbolic.lower_source(k)].imag() != 0; }));
    Eigen::VectorXcd b = Eigen::VectorXcd::Random(n);
    std::vector<Complex> x(n);
    for (Index c = 0; c < x.size(); ++c)
      x[c] = b[symbolic.vertex(c)];
    ASSERT_TRUE(cholesky.solve(x));
    const Eigen::VectorXcd expected = dense.ldlt().solve(b);
    for (Index c = 0; c < x.size(); ++c)
      EXPECT_LT(std::abs(x[c] - expected[symbolic.vertex(c)]), 1e-12);
  }
  EXPECT_FALSE(cholesky.factorize([](Index, auto add) { add(0, 0, -9.); },
                                  [&](std::size_t, auto add) { add(0, 0, Complex(0)); },
                                  [](std::size_t) { return false; }));

  internal::Vertex_block_cholesky system(chart);
  Eigen::MatrixXd blocks = Eigen::MatrixXd::Identity(2 * n, 2 * n) * 50;
  for (Index v = 0; v < graph.size(); ++v)
    system.add(v, {50, 0, 0, 50});
  for (Index t = 0; t < chart.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const std::array<double, 4> block{value(random), value(random), value(random), value(random)};
      system.add(t, i, block);
      const Index v = chart.triangles[t][i], w = chart.triangles[t][(i + 1) % 3];
      for (int r = 0; r < 2; ++r)
        for (int c = 0; c < 2; ++c) {
          blocks(2 * v + r, 2 * w + c) += block[2 * r + c];
          blocks(2 * w + c, 2 * v + r) += block[2 * r + c];
        }
    }
  const Eigen::VectorXd right = Eigen::VectorXd::Random(2 * n), solution = blocks.ldlt().solve(right);
  std::vector<Complex> x(n);
  for (Eigen::Index v = 0; v < n; ++v)
    x[v] = {right[2 * v], right[2 * v + 1]};
  ASSERT_TRUE(system.solve(x));
  for (Eigen::Index v = 0; v < n; ++v)
    EXPECT_LT(std::abs(x[v] - Complex(solution[2 * v], solution[2 * v + 1])), 1e-12);
}

template <typename Scalar>
void check_dense_update()
{
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  std::vector<double> packed;
  for (const auto& [rows, columns, depth] :
       {std::array{1, 1, 1}, {23, 7, 5}, {24, 24, 1}, {37, 13, 200}, {50, 50, 170}, {61, 3, 48}}) {
    const Matrix a = Matrix::Random(rows + 3, depth), before = Matrix::Random(rows + 2, columns);
    Matrix c = before;
    internal::subtract_outer(c.data(), rows + 2, a.data(), rows + 3, rows, columns, depth, packed);
    const Matrix expected = before.topRows(rows) - a.topRows(rows) * a.topRows(columns).adjoint();
    for (int j = 0; j < columns; ++j)
      for (int i = j; i < rows; ++i)
        EXPECT_LT(std::abs(c(i, j) - expected(i, j)), 1e-12);
    EXPECT_EQ(c.bottomRows(2), before.bottomRows(2)); // nothing is written beyond the matrix
  }
}

TEST(Dense_update, subtracts_the_outer_product)
{
  check_dense_update<double>();
  check_dense_update<Complex>();
}

} // namespace
