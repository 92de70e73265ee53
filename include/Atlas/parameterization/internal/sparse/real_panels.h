// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_SPARSE_REAL_PANELS_H
#define ATLAS_PARAMETERIZATION_INTERNAL_SPARSE_REAL_PANELS_H

#include <Atlas/core/internal/avx2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#ifdef ATLAS_HAS_AVX2_KERNELS

/// Dense kernels for the panels of small fronts, of which meshes have most: there the libraries for dense
/// matrices spend their time in preparations. They read the columns where they are.
///
/// Panels are column-major, `ld` numbers from one column to the next.
namespace Atlas::internal::avx2 {

#define ATLAS_AVX2 __attribute__((target("avx2,fma")))

/// The first `count` of four numbers.
ATLAS_AVX2 inline __m256i first_lanes(std::size_t count)
{
  return _mm256_cmpgt_epi64(_mm256_set1_epi64x(static_cast<long long>(count)), _mm256_set_epi64x(3, 2, 1, 0));
}

ATLAS_AVX2 inline double sum(__m256d x)
{
  const __m128d pair = _mm_add_pd(_mm256_castpd256_pd128(x), _mm256_extractf128_pd(x, 1));
  return _mm_cvtsd_f64(_mm_add_sd(pair, _mm_unpackhi_pd(pair, pair)));
}

/// C -= A B^T for 4 Vectors rows and so many columns. The rows of B are `b`, `b` + 1, ... with the stride of
/// A.
template <int Vectors, int Columns>
ATLAS_AVX2 inline void subtract_tile(double* c, std::size_t ldc, const double* a, const double* b,
                                     std::size_t ld, std::size_t depth)
{
  __m256d left[Columns][Vectors];
#pragma GCC unroll 4
  for (int j = 0; j < Columns; ++j)
#pragma GCC unroll 3
    for (int i = 0; i < Vectors; ++i)
      left[j][i] = _mm256_loadu_pd(c + j * ldc + 4 * i);
  for (std::size_t k = 0; k < depth; ++k, a += ld, b += ld) {
    __m256d column[Vectors];
#pragma GCC unroll 3
    for (int i = 0; i < Vectors; ++i)
      column[i] = _mm256_loadu_pd(a + 4 * i);
#pragma GCC unroll 4
    for (int j = 0; j < Columns; ++j) {
      const __m256d x = _mm256_broadcast_sd(b + j);
#pragma GCC unroll 3
      for (int i = 0; i < Vectors; ++i)
        left[j][i] = _mm256_fnmadd_pd(column[i], x, left[j][i]);
    }
  }
#pragma GCC unroll 4
  for (int j = 0; j < Columns; ++j)
#pragma GCC unroll 3
    for (int i = 0; i < Vectors; ++i)
      _mm256_storeu_pd(c + j * ldc + 4 * i, left[j][i]);
}

/// The same for fewer than 4 rows.
template <int Columns>
ATLAS_AVX2 inline void subtract_rest(double* c, std::size_t ldc, const double* a, const double* b,
                                     std::size_t ld, std::size_t depth, std::size_t rows)
{
  const __m256i mask = first_lanes(rows);
  __m256d left[Columns];
#pragma GCC unroll 4
  for (int j = 0; j < Columns; ++j)
    left[j] = _mm256_maskload_pd(c + j * ldc, mask);
  for (std::size_t k = 0; k < depth; ++k, a += ld, b += ld) {
    const __m256d column = _mm256_maskload_pd(a, mask);
#pragma GCC unroll 4
    for (int j = 0; j < Columns; ++j)
      left[j] = _mm256_fnmadd_pd(column, _mm256_broadcast_sd(b + j), left[j]);
  }
#pragma GCC unroll 4
  for (int j = 0; j < Columns; ++j)
    _mm256_maskstore_pd(c + j * ldc, mask, left[j]);
}

template <int Columns>
ATLAS_AVX2 void subtract_strip(double* c, std::size_t ldc, const double* a, const double* b, std::size_t ld,
                               std::size_t rows, std::size_t depth)
{
  std::size_t r = 0;
  for (; r + 12 <= rows; r += 12)
    subtract_tile<3, Columns>(c + r, ldc, a + r, b, ld, depth);
  if (r + 8 <= rows) {
    subtract_tile<2, Columns>(c + r, ldc, a + r, b, ld, depth);
    r += 8;
  }
  if (r + 4 <= rows) {
    subtract_tile<1, Columns>(c + r, ldc, a + r, b, ld, depth);
    r += 4;
  }
  if (r < rows)
    subtract_rest<Columns>(c + r, ldc, a + r, b, ld, depth, rows - r);
}

/// C -= A B^T, of up to 4 columns.
inline void subtract_strip(double* c, std::size_t ldc, const double* a, const double* b, std::size_t ld,
                           std::size_t rows, std::size_t columns, std::size_t depth)
{
  switch (columns) {
  case 1:
    return subtract_strip<1>(c, ldc, a, b, ld, rows, depth);
  case 2:
    return subtract_strip<2>(c, ldc, a, b, ld, rows, depth);
  case 3:
    return subtract_strip<3>(c, ldc, a, b, ld, rows, depth);
  default:
    return subtract_strip<4>(c, ldc, a, b, ld, rows, depth);
  }
}

/// C -= A A^T, the lower triangle of C, as `subtract_outer` does it.
inline void subtract_outer(double* c, std::size_t ldc, const double* a, std::size_t ld, std::size_t rows,
                           std::size_t columns, std::size_t depth)
{
  for (std::size_t j = 0; j < columns; j += 4)
    subtract_strip(c + j * ldc + j, ldc, a + j, a + j, ld, rows - j, std::min<std::size_t>(4, columns - j),
                   depth);
}

/// X := X L^-T for four rows, or as many as the mask lets through. `factor` is L with inverses on its
/// diagonal.
template <int Columns, bool Is_masked>
ATLAS_AVX2 inline void solve_rows(double* x, std::size_t ld,
                                  const std::array<std::array<double, 4>, 4>& factor, __m256i mask)
{
  __m256d column[Columns];
#pragma GCC unroll 4
  for (int j = 0; j < Columns; ++j) {
    column[j] = Is_masked ? _mm256_maskload_pd(x + j * ld, mask) : _mm256_loadu_pd(x + j * ld);
#pragma GCC unroll 4
    for (int k = 0; k < j; ++k)
      column[j] = _mm256_fnmadd_pd(column[k], _mm256_set1_pd(factor[j][k]), column[j]);
    column[j] = _mm256_mul_pd(column[j], _mm256_set1_pd(factor[j][j]));
    if constexpr (Is_masked)
      _mm256_maskstore_pd(x + j * ld, mask, column[j]);
    else
      _mm256_storeu_pd(x + j * ld, column[j]);
  }
}

/// Factorizes the first `Columns` rows, and divides the others by the factor.
template <int Columns>
ATLAS_AVX2 bool factorize_strip(double* x, std::size_t ld, std::size_t rows)
{
  std::array<std::array<double, 4>, 4> factor{};
  for (int j = 0; j < Columns; ++j)
    for (int i = j; i < Columns; ++i) {
      double value = x[j * ld + i];
      for (int k = 0; k < j; ++k)
        value -= x[k * ld + i] * x[k * ld + j];
      if (i > j)
        x[j * ld + i] = factor[i][j] = value * factor[j][j];
      else if (value > 0) {
        x[j * ld + j] = std::sqrt(value);
        factor[j][j] = 1 / x[j * ld + j];
      } else
        return false;
    }
  std::size_t r = Columns;
  for (; r + 4 <= rows; r += 4)
    solve_rows<Columns, false>(x + r, ld, factor, __m256i());
  if (r < rows)
    solve_rows<Columns, true>(x + r, ld, factor, first_lanes(rows - r));
  return true;
}

/// Cholesky's factorization of the first `width` of the rows, and the other rows divided by the factor.
inline bool factorize(double* panel, std::size_t ld, std::size_t rows, std::size_t width)
{
  for (std::size_t j = 0; j < width; j += 4) {
    const std::size_t columns = std::min<std::size_t>(4, width - j);
    double* const strip = panel + j * ld + j;
    subtract_strip(strip, ld, panel + j, panel + j, ld, rows - j, columns, j);
    const bool is_done = columns == 4   ? factorize_strip<4>(strip, ld, rows - j)
                         : columns == 3 ? factorize_strip<3>(strip, ld, rows - j)
                         : columns == 2 ? factorize_strip<2>(strip, ld, rows - j)
                                        : factorize_strip<1>(strip, ld, rows - j);
    if (!is_done)
      return false;
  }
  return true;
}

/// y := A x
ATLAS_AVX2 inline void multiply(const double* a, std::size_t ld, std::size_t rows, std::size_t columns,
                                const double* x, double* y)
{
  std::size_t r = 0;
  for (; r + 16 <= rows; r += 16) {
    __m256d part[4] = {_mm256_setzero_pd(), _mm256_setzero_pd(), _mm256_setzero_pd(), _mm256_setzero_pd()};
    for (std::size_t k = 0; k < columns; ++k) {
      const __m256d factor = _mm256_broadcast_sd(x + k);
#pragma GCC unroll 4
      for (int i = 0; i < 4; ++i)
        part[i] = _mm256_fmadd_pd(_mm256_loadu_pd(a + k * ld + r + 4 * i), factor, part[i]);
    }
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i)
      _mm256_storeu_pd(y + r + 4 * i, part[i]);
  }
  for (; r + 4 <= rows; r += 4) {
    __m256d part = _mm256_setzero_pd();
    for (std::size_t k = 0; k < columns; ++k)
      part = _mm256_fmadd_pd(_mm256_loadu_pd(a + k * ld + r), _mm256_broadcast_sd(x + k), part);
    _mm256_storeu_pd(y + r, part);
  }
  if (r < rows) {
    const __m256i mask = first_lanes(rows - r);
    __m256d part = _mm256_setzero_pd();
    for (std::size_t k = 0; k < columns; ++k)
      part = _mm256_fmadd_pd(_mm256_maskload_pd(a + k * ld + r, mask), _mm256_broadcast_sd(x + k), part);
    _mm256_maskstore_pd(y + r, mask, part);
  }
}

/// x -= A^T y for so many columns.
template <int Columns>
ATLAS_AVX2 inline void subtract_products(const double* a, std::size_t ld, std::size_t rows, const double* y,
                                         double* x)
{
  __m256d part[Columns];
#pragma GCC unroll 4
  for (__m256d& p : part)
    p = _mm256_setzero_pd();
  std::size_t r = 0;
  for (; r + 4 <= rows; r += 4) {
    const __m256d factor = _mm256_loadu_pd(y + r);
#pragma GCC unroll 4
    for (int j = 0; j < Columns; ++j)
      part[j] = _mm256_fmadd_pd(_mm256_loadu_pd(a + j * ld + r), factor, part[j]);
  }
  if (r < rows) {
    const __m256i mask = first_lanes(rows - r);
    const __m256d factor = _mm256_maskload_pd(y + r, mask);
#pragma GCC unroll 4
    for (int j = 0; j < Columns; ++j)
      part[j] = _mm256_fmadd_pd(_mm256_maskload_pd(a + j * ld + r, mask), factor, part[j]);
  }
#pragma GCC unroll 4
  for (int j = 0; j < Columns; ++j)
    x[j] -= sum(part[j]);
}

/// Solves L x' = x in place. `panel` has L as its first rows.
ATLAS_AVX2 inline void solve_lower(const double* panel, std::size_t ld, std::size_t width, double* x)
{
  for (std::size_t c = 0; c < width; ++c) {
    const double* const column = panel + c * ld;
    x[c] /= column[c];
    const __m256d factor = _mm256_set1_pd(x[c]);
    std::size_t r = c + 1;
    for (; r + 4 <= width; r += 4)
      _mm256_storeu_pd(x + r, _mm256_fnmadd_pd(_mm256_loadu_pd(column + r), factor, _mm256_loadu_pd(x + r)));
    for (; r < width; ++r)
      x[r] -= x[c] * column[r];
  }
}

/// Solves L^T x' = x - A^T y in place. `panel` has L as its first rows, and A below.
inline void solve_upper(const double* panel, std::size_t ld, std::size_t rows, std::size_t width,
                        const double* y, double* x)
{
  const double* const below = panel + width;
  std::size_t c = 0;
  for (; c + 4 <= width; c += 4)
    subtract_products<4>(below + c * ld, ld, rows, y, x + c);
  if (c + 2 <= width) {
    subtract_products<2>(below + c * ld, ld, rows, y, x + c);
    c += 2;
  }
  if (c < width)
    subtract_products<1>(below + c * ld, ld, rows, y, x + c);
  for (c = width; c-- > 0;) {
    const double* column = panel + c * ld;
    subtract_products<1>(column + c + 1, ld, width - c - 1, x + c + 1, x + c);
    x[c] /= column[c];
  }
}

#undef ATLAS_AVX2

} // namespace Atlas::internal::avx2

#endif

#endif
