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

#ifdef ATLAS_HAS_AVX2_KERNELS
/// The kernels on the first `width` columns of a random matrix, against Eigen's.
void check_panel(int width, int height)
{
  const int n = width + height;
  const Eigen::MatrixXd random = Eigen::MatrixXd::Random(n, n),
                        matrix = random * random.transpose() + Eigen::MatrixXd::Identity(n, n),
                        factor = matrix.llt().matrixL();
  const Eigen::MatrixXd top = factor.topLeftCorner(width, width),
                        bottom = factor.bottomLeftCorner(height, width);
  Eigen::MatrixXd panel = matrix.leftCols(width), update = matrix.bottomRightCorner(height, height);
  ASSERT_TRUE(internal::avx2::factorize(panel.data(), n, n, width));
  internal::avx2::subtract_outer(update.data(), height, panel.data() + width, n, height, height, width);
  const auto lower = [](Eigen::MatrixXd x) { return Eigen::MatrixXd(x.triangularView<Eigen::Lower>()); };
  EXPECT_LT((lower(panel) - factor.leftCols(width)).cwiseAbs().sum(), 1e-9);
  EXPECT_LT(
      lower(update - matrix.bottomRightCorner(height, height) + bottom * bottom.transpose()).cwiseAbs().sum(),
      1e-9);

  const Eigen::VectorXd right = Eigen::VectorXd::Random(width), below = Eigen::VectorXd::Random(height);
  Eigen::VectorXd x = right, y = right, product(height);
  internal::avx2::solve_lower(panel.data(), n, width, x.data());
  EXPECT_LT((top * x - right).cwiseAbs().sum(), 1e-9);
  internal::avx2::multiply(panel.data() + width, n, height, width, x.data(), product.data());
  EXPECT_LT((bottom * x - product).cwiseAbs().sum(), 1e-9);
  internal::avx2::solve_upper(panel.data(), n, height, width, below.data(), y.data());
  EXPECT_LT((top.transpose() * y + bottom.transpose() * below - right).cwiseAbs().sum(), 1e-9);

  panel = matrix.leftCols(width);
  panel(width - 1, width - 1) = -1;
  EXPECT_FALSE(internal::avx2::factorize(panel.data(), n, n, width));
}

TEST(Real_panels, are_factorized_and_solved_at_any_size)
{
  if (!internal::has_avx2())
    GTEST_SKIP() << "this processor has no AVX2";
  for (int width = 1; width < 18; ++width)
    for (int height = 0; height < 30; ++height)
      check_panel(width, height);
  check_panel(48, 47);
}
#endif

} // namespace
