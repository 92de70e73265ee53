// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_SPARSE_MULTIFRONTAL_CHOLESKY_H
#define ATLAS_PARAMETERIZATION_INTERNAL_SPARSE_MULTIFRONTAL_CHOLESKY_H

#include <Atlas/parameterization/internal/geometry/chart_geometry.h>
#include <Atlas/parameterization/internal/sparse/factor_panels.h>
#include <Atlas/parameterization/internal/sparse/hermitian_rank_k_update.h>
#include <Atlas/parameterization/internal/sparse/real_panels.h>
#include <Atlas/parameterization/internal/sparse/supernodal_symbolic.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief The numeric part: A = L L* by dense fronts (Duff and Reid 1983), each front handed from the
/// children to the parent.
///
/// Every vertex is a block of B unknowns. With B = 1 the matrix may be Hermitian: a front stays real until an
/// entry with an imaginary part has been assembled in its subtree, and is complex from there on. For LSCM,
/// where only border edges have imaginary parts, that costs half of an all-complex factorization.
/// \tparam Panels  where the factor is kept: see factor_panels.h
template <int B, typename Panels = Panels_in_memory>
class Multifrontal_cholesky
{
public:
  explicit Multifrontal_cholesky(const Supernodal_symbolic& symbolic)
      : symbolic_(symbolic), is_complex_(symbolic.supernodes().size()), local_(symbolic.size())
  {
    panels_.resize(symbolic.supernodes().size());
  }

  /// Says where the factor will be, before `factorize`.
  void keep_in(Panels panels)
  {
    panels_ = std::move(panels);
    panels_.resize(symbolic_.supernodes().size());
  }

  /// \param diagonal  diagonal(column, add): calls add(i, j, value) for the entries i >= j of the block
  /// \param lower     lower(k, add): the same for all i, j of the k-th entry below the diagonal
  /// \return `false` if the matrix is not positive definite
  template <typename Diagonal, typename Lower, typename IsComplex>
  bool factorize(Diagonal diagonal, Lower lower, IsComplex is_complex)
  {
    const auto& nodes = symbolic_.supernodes();
    find_complex(is_complex);
    std::vector<std::vector<Index>> children(nodes.size());
    updates_ = std::vector<std::unique_ptr<double[]>>(nodes.size());
    for (Index s = 0; s < nodes.size(); ++s) {
      const bool is_done = is_complex_[s] ? factorize<Complex>(s, children[s], diagonal, lower)
                                          : factorize<double>(s, children[s], diagonal, lower);
      if (!is_done)
        return false;
      std::vector<Index>().swap(children[s]);
      if (nodes[s].parent != no_index)
        children[nodes[s].parent].push_back(s);
    }
    return true;
  }

  /// The most bytes that a factorization has in fronts at a time.
  template <typename IsComplex>
  std::size_t peak_of_fronts(IsComplex is_complex)
  {
    find_complex(is_complex);
    const auto& nodes = symbolic_.supernodes();
    std::vector<std::size_t> children(nodes.size(), 0); // numbers in their updates
    std::size_t stack = 0, peak = 0;
    for (std::size_t s = 0; s < nodes.size(); ++s) {
      const std::size_t numbers = is_complex_[s] ? 2 : 1, width = B * nodes[s].width(),
                        height = B * nodes[s].height();
      stack += numbers * height * height;
      peak = std::max(peak, stack + (numbers * width + longest_pack) * (width + height));
      stack -= children[s];
      if (nodes[s].parent != no_index)
        children[nodes[s].parent] += numbers * height * height;
    }
    return peak * sizeof(double);
  }

  /// Solves in place. The unknowns of column c are at c B, ..., c B + B - 1.
  template <typename Scalar>
  bool solve(std::vector<Scalar>& x)
  {
    const auto& nodes = symbolic_.supernodes();
    Vector<Scalar> below;
    for (std::size_t s = 0; s < nodes.size(); ++s)
      visit(s, [&](const auto& panel) { forward(nodes[s], panel, x, below); });
    for (std::size_t s = nodes.size(); s-- > 0;)
      visit(s, [&](const auto& panel) { backward(nodes[s], panel, x, below); });
    return Eigen::Map<const Vector<Scalar>>(x.data(), static_cast<Eigen::Index>(x.size())).allFinite();
  }

  /// Numbers in the factor, a complex one counting twice.
  std::size_t factor_size() const { return panels_.size(); }

private:
  template <typename Scalar>
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  template <typename Scalar>
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  template <typename Panel_map, typename Scalar>
  static constexpr bool are_real =
      std::is_same_v<typename Panel_map::Scalar, double>&& std::is_same_v<Scalar, double>;

  using Supernode = Supernodal_symbolic::Supernode;

  static constexpr std::size_t block = 48;         ///< columns that are factorized at once
  static constexpr std::size_t longest_pack = 256; ///< numbers of a row that the dense kernels copy at most

  /// Column-major front: the panel of the node's own columns over all its rows, and the square update below.
  template <typename Scalar>
  struct Front
  {
    Scalar *panel, *update;
    std::size_t width, height;

    Scalar& operator()(std::size_t row, std::size_t column) const
    {
      return column < width ? panel[column * (width + height) + row]
                            : update[(column - width) * height + row - width];
    }
  };

  /// A front is complex if it has a complex entry, or a child that is complex.
  template <typename IsComplex>
  void find_complex(IsComplex& is_complex)
  {
    if constexpr (B == 1) {
      const auto& nodes = symbolic_.supernodes();
      std::fill(is_complex_.begin(), is_complex_.end(), char(false));
      for (std::size_t s = 0; s < nodes.size(); ++s) {
        for (std::size_t k = symbolic_.lower_begin(nodes[s].begin);
             !is_complex_[s] && k < symbolic_.lower_begin(nodes[s].end); ++k)
          is_complex_[s] = is_complex(k);
        if (is_complex_[s] && nodes[s].parent != no_index)
          is_complex_[nodes[s].parent] = true;
      }
    }
  }

  template <typename Scalar, typename Diagonal, typename Lower>
  bool factorize(Index s, const std::vector<Index>& children, Diagonal& diagonal, Lower& lower)
  {
    const Supernode& node = symbolic_.supernodes()[s];
    constexpr std::size_t doubles = sizeof(Scalar) / sizeof(double);
    const std::size_t width = B * node.width(), height = B * node.height();
    if (height > 0)
      updates_[s] = std::make_unique<double[]>(doubles * height * height);
    const Front<Scalar> front{reinterpret_cast<Scalar*>(panels_.start(s, doubles * width * (width + height))),
                              reinterpret_cast<Scalar*>(updates_[s].get()), width, height};
    for (Index c = node.begin; c < node.end; ++c)
      local_[c] = c - node.begin;
    for (std::size_t k = node.first_row; k < node.last_row; ++k)
      local_[symbolic_.rows()[k]] = static_cast<Index>(node.width() + k - node.first_row);

    assemble(node, front, diagonal, lower);
    for (const Index child : children) {
      if (is_complex_[child])
        extend<Scalar, Complex>(child, front);
      else
        extend<Scalar, double>(child, front);
      updates_[child].reset();
    }
    return eliminate(front) && panels_.finish(s);
  }

  template <typename Scalar, typename Value>
  static void add(Scalar& to, const Value& value)
  {
    if constexpr (std::is_same_v<Scalar, double> && !std::is_same_v<Value, double>)
      to += value.real(); // in a real front the imaginary parts are zero
    else
      to += value;
  }

  template <typename Scalar, typename Diagonal, typename Lower>
  void assemble(const Supernode& node, const Front<Scalar>& front, Diagonal& diagonal, Lower& lower) const
  {
    for (Index c = node.begin; c < node.end; ++c) {
      const std::size_t column = B * local_[c];
      diagonal(c, [&](int i, int j, const auto& value) { add(front(column + i, column + j), value); });
      for (std::size_t k = symbolic_.lower_begin(c); k < symbolic_.lower_begin(c + 1); ++k) {
        const std::size_t row = B * local_[symbolic_.lower_row(k)];
        lower(k, [&](int i, int j, const auto& value) { add(front(row + i, column + j), value); });
      }
    }
  }

  template <typename Scalar, typename ChildScalar>
  void extend(Index child, const Front<Scalar>& front)
  {
    const Supernode& node = symbolic_.supernodes()[child];
    const std::size_t height = B * node.height();
    const auto* update = reinterpret_cast<const ChildScalar*>(updates_[child].get());
    rows_.resize(height);
    for (std::size_t k = 0; k < node.height(); ++k)
      for (int i = 0; i < B; ++i)
        rows_[B * k + i] = B * static_cast<std::size_t>(local_[symbolic_.rows()[node.first_row + k]]) + i;
    for (std::size_t c = 0; c < height; ++c) {
      const ChildScalar* from = update + c * height;
      if (rows_[c] < front.width) {
        Scalar* to = front.panel + rows_[c] * (front.width + front.height);
        for (std::size_t r = c; r < height; ++r)
          add(to[rows_[r]], from[r]);
      } else {
        Scalar* to = front.update + (rows_[c] - front.width) * front.height - front.width;
        for (std::size_t r = c; r < height; ++r)
          add(to[rows_[r]], from[r]);
      }
    }
  }

  /// Block by block of columns: factor the diagonal block, solve for what is below it, subtract their outer
  /// product from the columns that follow; in the end from the update.
  template <typename Scalar>
  bool eliminate(const Front<Scalar>& front)
  {
    const std::size_t total = front.width + front.height;
#ifdef ATLAS_HAS_AVX2_KERNELS
    if constexpr (std::is_same_v<Scalar, double>)
      if (has_avx2())
        return eliminate_by_strips(front);
#endif
    Eigen::Map<Matrix<Scalar>> panel(front.panel, static_cast<Eigen::Index>(total),
                                     static_cast<Eigen::Index>(front.width));
    for (std::size_t begin = 0; begin < front.width; begin += block) {
      const std::size_t width = std::min(block, front.width - begin), end = begin + width;
      const auto b = static_cast<Eigen::Index>(begin), w = static_cast<Eigen::Index>(width);
      Eigen::Ref<Matrix<Scalar>> top(panel.block(b, b, w, w));
      const Eigen::LLT<Eigen::Ref<Matrix<Scalar>>> llt(top);
      if (llt.info() != Eigen::Success)
        return false;
      if (end == total)
        break;
      auto bottom = panel.block(b + w, b, static_cast<Eigen::Index>(total - end), w);
      top.adjoint().template triangularView<Eigen::Upper>().template solveInPlace<Eigen::OnTheRight>(bottom);
      subtract_outer(front.panel + end * total + end, total, front.panel + begin * total + end, total,
                     total - end, front.width - end, width, packed_);
    }
    if (front.height > 0)
      subtract_outer(front.update, front.height, front.panel + front.width, total, front.height, front.height,
                     front.width, packed_);
    return true;
  }

#ifdef ATLAS_HAS_AVX2_KERNELS
  /// The same with the kernels for real panels, as long as what they read again and again is small.
  bool eliminate_by_strips(const Front<double>& front)
  {
    constexpr std::size_t small = 4096; // numbers
    const std::size_t total = front.width + front.height;
    const auto subtract = [&](double* c, std::size_t ldc, const double* a, std::size_t rows,
                              std::size_t columns, std::size_t depth) {
      if (rows * depth <= small)
        avx2::subtract_outer(c, ldc, a, total, rows, columns, depth);
      else
        subtract_outer(c, ldc, a, total, rows, columns, depth, packed_);
    };
    for (std::size_t begin = 0; begin < front.width; begin += block) {
      const std::size_t width = std::min(block, front.width - begin), end = begin + width;
      double* const columns = front.panel + begin * total;
      if (!avx2::factorize(columns + begin, total, total - begin, width))
        return false;
      subtract(front.panel + end * total + end, total, columns + end, total - end, front.width - end, width);
    }
    subtract(front.update, front.height, front.panel + front.width, front.height, front.height, front.width);
    return true;
  }
#endif

  template <typename Visit>
  void visit(std::size_t s, Visit&& visit)
  {
    const Supernode& node = symbolic_.supernodes()[s];
    const auto width = static_cast<Eigen::Index>(B * node.width()),
               rows = static_cast<Eigen::Index>(B * (node.width() + node.height()));
    const double* panel = panels_.read(s);
    if (is_complex_[s]) {
      if constexpr (B == 1)
        visit(Eigen::Map<const Matrix<Complex>>(reinterpret_cast<const Complex*>(panel), rows, width));
    } else
      visit(Eigen::Map<const Matrix<double>>(panel, rows, width));
  }

  template <typename Panel_map, typename Scalar>
  void forward(const Supernode& node, const Panel_map& panel, std::vector<Scalar>& x,
               Vector<Scalar>& below) const
  {
    const Eigen::Index width = panel.cols(), height = panel.rows() - width;
    Eigen::Map<Vector<Scalar>> own(x.data() + B * node.begin, width);
    below.resize(height);
#ifdef ATLAS_HAS_AVX2_KERNELS
    if constexpr (are_real<Panel_map, Scalar>)
      if (has_avx2()) {
        avx2::solve_lower(panel.data(), panel.rows(), width, own.data());
        avx2::multiply(panel.data() + width, panel.rows(), height, width, own.data(), below.data());
        return subtract_below(node, below, x);
      }
#endif
    for (Eigen::Index c = 0; c < width; ++c) {
      own[c] /= real(panel(c, c));
      own.tail(width - c - 1) -= own[c] * panel.col(c).segment(c + 1, width - c - 1);
    }
    below.noalias() = panel.bottomRows(height) * own;
    subtract_below(node, below, x);
  }

  template <typename Scalar>
  void subtract_below(const Supernode& node, const Vector<Scalar>& below, std::vector<Scalar>& x) const
  {
    const Scalar* from = below.data();
    for (std::size_t k = node.first_row; k < node.last_row; ++k)
      for (int i = 0; i < B; ++i)
        x[B * symbolic_.rows()[k] + i] -= *from++;
  }

  template <typename Panel_map, typename Scalar>
  void backward(const Supernode& node, const Panel_map& panel, std::vector<Scalar>& x,
                Vector<Scalar>& below) const
  {
    const Eigen::Index width = panel.cols(), height = panel.rows() - width;
    below.resize(height);
    Scalar* to = below.data();
    for (std::size_t k = node.first_row; k < node.last_row; ++k)
      for (int i = 0; i < B; ++i)
        *to++ = x[B * symbolic_.rows()[k] + i];
    Eigen::Map<Vector<Scalar>> own(x.data() + B * node.begin, width);
#ifdef ATLAS_HAS_AVX2_KERNELS
    if constexpr (are_real<Panel_map, Scalar>)
      if (has_avx2())
        return avx2::solve_upper(panel.data(), panel.rows(), height, width, below.data(), own.data());
#endif
    own.noalias() -= panel.bottomRows(height).adjoint() * below;
    for (Eigen::Index c = width; c-- > 0;) {
      for (Eigen::Index r = c + 1; r < width; ++r)
        own[c] -= conjugate(panel(r, c)) * own[r];
      own[c] /= real(panel(c, c));
    }
  }

  static double real(double x)
  {
    return x;
  }
  static double real(const Complex& z)
  {
    return z.real();
  }
  static double conjugate(double x)
  {
    return x;
  }
  static Complex conjugate(const Complex& z)
  {
    return std::conj(z);
  }

  const Supernodal_symbolic& symbolic_;
  Panels panels_;
  std::vector<std::unique_ptr<double[]>> updates_;
  std::vector<char> is_complex_; ///< of each supernode
  std::vector<Index> local_;
  std::vector<std::size_t> rows_;
  std::vector<double> packed_;
};

} // namespace Atlas::internal

#endif
