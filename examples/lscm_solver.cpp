// SPDX-License-Identifier: MIT
// Least squares conformal maps with a sparse solver of one's own: a wavy sheet, held at two corners.
#include <Atlas/parameterization/LSCM_parameterizer.h>

#include <Eigen/SparseCholesky>

#include <cmath>
#include <complex>
#include <iostream>
#include <span>

/// Any solver of sparse Hermitian systems will do; here it is one of Eigen, fed by compressed columns.
class My_solver
{
public:
  bool factorize(const Atlas::LSCM_system& system, const Atlas::Execution&)
  {
    const auto n = static_cast<Eigen::Index>(system.size());
    const auto entries = static_cast<Eigen::Index>(system.value.size());
    ldlt_.compute(Eigen::Map<const Matrix>(n, n, entries, system.first.data(), system.row.data(),
                                           system.value.data())); // the lower triangle
    return ldlt_.info() == Eigen::Success;
  }
  bool solve(std::span<std::complex<double>> b)
  {
    Eigen::Map<Eigen::VectorXcd> x(b.data(), static_cast<Eigen::Index>(b.size()));
    x = ldlt_.solve(x.eval()).eval();
    return ldlt_.info() == Eigen::Success;
  }

private:
  using Matrix = Eigen::SparseMatrix<std::complex<double>>;
  Eigen::SimplicialLDLT<Matrix> ldlt_;
};

int main()
{
  const Atlas::Index side = 30;
  Atlas::Chart chart;
  for (Atlas::Index j = 0; j < side; ++j)
    for (Atlas::Index i = 0; i < side; ++i) {
      const double x = i / (side - 1.), y = j / (side - 1.);
      chart.points.emplace_back(x, y, 0.1 * std::sin(7 * x) * std::cos(5 * y));
    }
  for (Atlas::Index j = 0; j + 1 < side; ++j)
    for (Atlas::Index i = 0; i + 1 < side; ++i) {
      const Atlas::Index a = j * side + i, b = a + 1, c = a + side, d = c + 1;
      chart.triangles.push_back({a, b, d});
      chart.triangles.push_back({a, d, c});
    }

  using My_traits = Atlas::Basic_LSCM_traits<My_solver>;
  const My_traits traits({{0, Atlas::Point_2(0, 0)}, {side * side - 1, Atlas::Point_2(1, 1)}});
  Atlas::LSCM_record record;
  const Atlas::Chart_status status =
      Atlas::LSCM_parameterizer<My_traits>(traits).parameterize(chart, Atlas::Execution(), record);
  std::cout << message(status) << "\nconformal energy per area: " << record.energy
            << "\nlast refinement step: " << record.residual << '\n';
  return status == Atlas::Chart_status::valid && record.energy < 0.01 && record.residual < 1e-9 ? 0 : 1;
}
