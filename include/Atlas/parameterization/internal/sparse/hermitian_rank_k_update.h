// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_SPARSE_HERMITIAN_RANK_K_UPDATE_H
#define ATLAS_PARAMETERIZATION_INTERNAL_SPARSE_HERMITIAN_RANK_K_UPDATE_H

#include <Atlas/core/internal/avx2.h>
#include <Atlas/parameterization/internal/geometry/chart_geometry.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace Atlas::internal {

/// C -= A A*, only the lower trapezoid of the first `columns` columns of C: the kernel in which a sparse
/// factorization spends its time. Column-major, leading dimensions ldc and lda; A has `rows` rows and `depth`
/// columns. Entries above the diagonal of C may be changed.
template <typename Scalar>
void subtract_outer_by_eigen(Scalar* c, std::size_t ldc, const Scalar* a, std::size_t lda, std::size_t rows,
                             std::size_t columns, std::size_t depth)
{
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  const auto m = static_cast<Eigen::Index>(rows), n = static_cast<Eigen::Index>(columns),
             k = static_cast<Eigen::Index>(depth);
  Eigen::Map<Matrix, 0, Eigen::OuterStride<>> result(c, m, n,
                                                     Eigen::OuterStride<>(static_cast<Eigen::Index>(ldc)));
  Eigen::Map<const Matrix, 0, Eigen::OuterStride<>> factor(
      a, m, k, Eigen::OuterStride<>(static_cast<Eigen::Index>(lda)));
  result.topRows(n).template selfadjointView<Eigen::Lower>().rankUpdate(factor.topRows(n), Scalar(-1));
  if (m > n)
    result.bottomRows(m - n).noalias() -= factor.bottomRows(m - n) * factor.topRows(n).adjoint();
}

#ifdef ATLAS_HAS_AVX2_KERNELS

/// Real tiles: 12 rows by 4 columns. Packed: 12 rows of A side by side, column after column.
struct Real_tile
{
  using Scalar = double;
  static constexpr std::size_t rows = 12, columns = 4, stride = 12, depth = 160;

  static void pack(double* to, std::size_t i, double value) { to[i] = value; }

  __attribute__((target("avx2,fma"))) static void multiply(const double* a, const double* b, std::size_t k,
                                                           double* out)
  {
    __m256d sum[4][3];
    for (auto& column : sum)
      for (__m256d& part : column)
        part = _mm256_setzero_pd();
    for (std::size_t t = 0; t < k; ++t, a += stride, b += stride) {
      const __m256d a0 = _mm256_loadu_pd(a), a1 = _mm256_loadu_pd(a + 4), a2 = _mm256_loadu_pd(a + 8);
#pragma GCC unroll 4
      for (int j = 0; j < 4; ++j) {
        const __m256d x = _mm256_broadcast_sd(b + j);
        sum[j][0] = _mm256_fmadd_pd(a0, x, sum[j][0]);
        sum[j][1] = _mm256_fmadd_pd(a1, x, sum[j][1]);
        sum[j][2] = _mm256_fmadd_pd(a2, x, sum[j][2]);
      }
    }
#pragma GCC unroll 4
    for (int j = 0; j < 4; ++j)
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i)
        _mm256_storeu_pd(out + 12 * j + 4 * i, sum[j][i]);
  }

  static double value(const double* out, std::size_t i, std::size_t j)
  {
    return out[12 * j + i];
  }
};

/// Complex tiles: 4 rows by 4 columns. Packed: 4 real parts, then 4 imaginary parts.
struct Complex_tile
{
  using Scalar = Complex;
  static constexpr std::size_t rows = 4, columns = 4, stride = 8, depth = 128;

  static void pack(double* to, std::size_t i, const Complex& value)
  {
    to[i] = value.real();
    to[4 + i] = value.imag();
  }

  __attribute__((target("avx2,fma"))) static void multiply(const double* a, const double* b, std::size_t k,
                                                           double* out)
  {
    __m256d re[4], im[4];
    for (int j = 0; j < 4; ++j)
      re[j] = im[j] = _mm256_setzero_pd();
    for (std::size_t t = 0; t < k; ++t, a += stride, b += stride) {
      const __m256d ar = _mm256_loadu_pd(a), ai = _mm256_loadu_pd(a + 4);
#pragma GCC unroll 4
      for (int j = 0; j < 4; ++j) { // a conj(b)
        const __m256d br = _mm256_broadcast_sd(b + j), bi = _mm256_broadcast_sd(b + 4 + j);
        re[j] = _mm256_fmadd_pd(ar, br, re[j]);
        im[j] = _mm256_fmadd_pd(ai, br, im[j]);
        re[j] = _mm256_fmadd_pd(ai, bi, re[j]);
        im[j] = _mm256_fnmadd_pd(ar, bi, im[j]);
      }
    }
#pragma GCC unroll 4
    for (int j = 0; j < 4; ++j) {
      _mm256_storeu_pd(out + 8 * j, re[j]);
      _mm256_storeu_pd(out + 8 * j + 4, im[j]);
    }
  }

  static Complex value(const double* out, std::size_t i, std::size_t j)
  {
    return {out[8 * j + i], out[8 * j + 4 + i]};
  }
};

/// The same by tiles: blocks of columns of A are packed so that a tile reads memory in one direction.
template <typename Tile>
void subtract_outer_by_tiles(typename Tile::Scalar* c, std::size_t ldc, const typename Tile::Scalar* a,
                             std::size_t lda, std::size_t rows, std::size_t columns, std::size_t depth,
                             std::vector<double>& packed)
{
  const std::size_t panels = (rows + Tile::rows - 1) / Tile::rows;
  double out[Tile::stride * Tile::columns];
  for (std::size_t begin = 0; begin < depth; begin += Tile::depth) {
    const std::size_t k = std::min(Tile::depth, depth - begin), size = k * Tile::stride;
    packed.assign(panels * size, 0);
    for (std::size_t t = 0; t < k; ++t)
      for (std::size_t r = 0; r < rows; ++r)
        Tile::pack(packed.data() + r / Tile::rows * size + t * Tile::stride, r % Tile::rows,
                   a[(begin + t) * lda + r]);
    for (std::size_t p = 0; p < panels; ++p) {
      const std::size_t first_row = p * Tile::rows, height = std::min(Tile::rows, rows - first_row);
      for (std::size_t j = 0; j < std::min(columns, first_row + height); j += Tile::columns) {
        Tile::multiply(packed.data() + p * size, packed.data() + j / Tile::rows * size + j % Tile::rows, k,
                       out);
        const std::size_t width = std::min(Tile::columns, columns - j);
        for (std::size_t jj = 0; jj < width; ++jj)
          for (std::size_t i = 0; i < height; ++i)
            c[(j + jj) * ldc + first_row + i] -= Tile::value(out, i, jj);
      }
    }
  }
}

#endif

template <typename Scalar>
void subtract_outer(Scalar* c, std::size_t ldc, const Scalar* a, std::size_t lda, std::size_t rows,
                    std::size_t columns, std::size_t depth, std::vector<double>& packed)
{
  if (columns == 0 || depth == 0)
    return;
#ifdef ATLAS_HAS_AVX2_KERNELS
  constexpr std::size_t small = 24; // below it packing costs more than it brings
  if (rows >= small && has_avx2()) {
    using Tile = std::conditional_t<std::is_same_v<Scalar, double>, Real_tile, Complex_tile>;
    return subtract_outer_by_tiles<Tile>(c, ldc, a, lda, rows, columns, depth, packed);
  }
#endif
  (void)packed;
  subtract_outer_by_eigen(c, ldc, a, lda, rows, columns, depth);
}

} // namespace Atlas::internal

#endif
