// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_SPARSE_MULTIFRONTAL_CHOLESKY_H
#define ATLAS_PARAMETERIZATION_INTERNAL_SPARSE_MULTIFRONTAL_CHOLESKY_H

#include <Atlas/parameterization/internal/geometry/chart_geometry.h>
#include <Atlas/parameterization/internal/sparse/hermitian_rank_k_update.h>
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
template <int B>
class Multifrontal_cholesky
{
public:
  explicit Multifrontal_cholesky(const Supernodal_symbolic& symbolic)
      : symbolic_(symbolic), panels_(symbolic.supernodes().size()), local_(symbolic.size())
  {}

  /// \param diagonal  diagonal(column, add): calls add(i, j, value) for the entries i >= j of the block
  /// \param lower     lower(k, add): the same for all i, j of the k-th entry below the diagonal
  /// \return `false` if the matrix is not positive definite
  template <typename Diagonal, typename Lower, typename IsComplex>
  bool factorize(Diagonal diagonal, Lower lower, IsComplex is_complex)
  {
    const auto& nodes = symbolic_.supernodes();
    std::vector<std::vector<Index>> children(nodes.size());
    updates_ = std::vector<Panel>(nodes.size());
    for (Index s = 0; s < nodes.size(); ++s) {
      bool has_complex = false;
      if constexpr (B == 1) {
        for (const Index child : children[s])
          has_complex = has_complex || updates_[child].is_complex;
        for (std::size_t k = symbolic_.lower_begin(nodes[s].begin);
             !has_complex && k < symbolic_.lower_begin(nodes[s].end); ++k)
          has_complex = is_complex(k);
      }
      const bool is_done = has_complex ? factorize<Complex>(s, children[s], diagonal, lower)
                                       : factorize<double>(s, children[s], diagonal, lower);
      if (!is_done)
        return false;
      std::vector<Index>().swap(children[s]);
      if (nodes[s].parent != no_index)
        children[nodes[s].parent].push_back(s);
    }
    return true;
  }

  /// Solves in place. The unknowns of column c are at c B, ..., c B + B - 1.
  template <typename Scalar>
  bool solve(std::vector<Scalar>& x) const
  {
    const auto& nodes = symbolic_.supernodes();
    Vector<Scalar> below;
    for (std::size_t s = 0; s < nodes.size(); ++s)
      visit(s, [&](const auto& panel) { forward(nodes[s], panel, x, below); });
    for (std::size_t s = nodes.size(); s-- > 0;)
      visit(s, [&](const auto& panel) { backward(nodes[s], panel, x, below); });
    return Eigen::Map<const Vector<Scalar>>(x.data(), static_cast<Eigen::Index>(x.size())).allFinite();
  }

  /// Numbers of type double in the factor.
  std::size_t factor_size() const
  {
    std::size_t sum = 0;
    for (const Panel& panel : panels_)
      sum += panel.size;
    return sum;
  }

private:
  template <typename Scalar>
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  template <typename Scalar>
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  /// Doubles, or pairs of them.
  struct Panel
  {
    std::unique_ptr<double[]> data;
    std::size_t size = 0;
    bool is_complex = false;

    void allocate(std::size_t doubles)
    {
      if (size == doubles)
        std::fill_n(data.get(), size, 0.);
      else
        data = std::make_unique<double[]>(doubles);
      size = doubles;
    }
    template <typename Scalar>
    Scalar* as() const
    {
      return reinterpret_cast<Scalar*>(data.get());
    }
  };

  using Supernode = Supernodal_symbolic::Supernode;

  static constexpr std::size_t block = 48; ///< columns that are factorized at once

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

  template <typename Scalar, typename Diagonal, typename Lower>
  bool factorize(Index s, const std::vector<Index>& children, Diagonal& diagonal, Lower& lower)
  {
    const Supernode& node = symbolic_.supernodes()[s];
    constexpr std::size_t doubles = sizeof(Scalar) / sizeof(double);
    const std::size_t width = B * node.width(), height = B * node.height();
    panels_[s].is_complex = updates_[s].is_complex = !std::is_same_v<Scalar, double>;
    panels_[s].allocate(doubles * width * (width + height));
    if (height > 0)
      updates_[s].allocate(doubles * height * height);
    const Front<Scalar> front{panels_[s].template as<Scalar>(), updates_[s].template as<Scalar>(), width,
                              height};
    for (Index c = node.begin; c < node.end; ++c)
      local_[c] = c - node.begin;
    for (std::size_t k = node.first_row; k < node.last_row; ++k)
      local_[symbolic_.rows()[k]] = static_cast<Index>(node.width() + k - node.first_row);

    assemble(node, front, diagonal, lower);
    for (const Index child : children) {
      if (updates_[child].is_complex)
        extend<Scalar, Complex>(child, front);
      else
        extend<Scalar, double>(child, front);
      updates_[child] = {};
    }
    return eliminate(front);
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
    const ChildScalar* update = updates_[child].template as<ChildScalar>();
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

  template <typename Visit>
  void visit(std::size_t s, Visit&& visit) const
  {
    const Supernode& node = symbolic_.supernodes()[s];
    const auto width = static_cast<Eigen::Index>(B * node.width()),
               rows = static_cast<Eigen::Index>(B * (node.width() + node.height()));
    if (panels_[s].is_complex) {
      if constexpr (B == 1)
        visit(Eigen::Map<const Matrix<Complex>>(panels_[s].template as<Complex>(), rows, width));
    } else
      visit(Eigen::Map<const Matrix<double>>(panels_[s].template as<double>(), rows, width));
  }

  template <typename Panel_map, typename Scalar>
  void forward(const Supernode& node, const Panel_map& panel, std::vector<Scalar>& x,
               Vector<Scalar>& below) const
  {
    const Eigen::Index width = panel.cols(), height = panel.rows() - width;
    Eigen::Map<Vector<Scalar>> own(x.data() + B * node.begin, width);
    for (Eigen::Index c = 0; c < width; ++c) {
      own[c] /= real(panel(c, c));
      own.tail(width - c - 1) -= own[c] * panel.col(c).segment(c + 1, width - c - 1);
    }
    below.noalias() = panel.bottomRows(height) * own;
    for (std::size_t k = node.first_row; k < node.last_row; ++k)
      for (int i = 0; i < B; ++i)
        x[B * symbolic_.rows()[k] + i] -= below[static_cast<Eigen::Index>(B * (k - node.first_row)) + i];
  }

  template <typename Panel_map, typename Scalar>
  void backward(const Supernode& node, const Panel_map& panel, std::vector<Scalar>& x,
                Vector<Scalar>& below) const
  {
    const Eigen::Index width = panel.cols(), height = panel.rows() - width;
    below.resize(height);
    for (std::size_t k = node.first_row; k < node.last_row; ++k)
      for (int i = 0; i < B; ++i)
        below[static_cast<Eigen::Index>(B * (k - node.first_row)) + i] = x[B * symbolic_.rows()[k] + i];
    Eigen::Map<Vector<Scalar>> own(x.data() + B * node.begin, width);
    own.noalias() -= panel.bottomRows(height).adjoint() * below;
    for (Eigen::Index c = width; c-- > 0;) {
      for (Eigen::Index r = c + 1; r < width; ++r)
        own[c] -= conjugate(panel(r, c)) * own[r];
      own[c] /= real(panel(c, c));
    }
  }

  static double real(double x) { return x; }
  static double real(const Complex& z) { return z.real(); }
  static double conjugate(double x) { return x; }
  static Complex conjugate(const Complex& z) { return std::conj(z); }

  const Supernodal_symbolic& symbolic_;
  std::vector<Panel> panels_, updates_;
  std::vector<Index> local_;
  std::vector<std::size_t> rows_;
  std::vector<double> packed_;
};

} // namespace Atlas::internal

#endif
