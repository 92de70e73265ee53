// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_RASTER_RASTER_PAGE_H
#define ATLAS_PACKING_INTERNAL_RASTER_RASTER_PAGE_H

#include <Atlas/core/Kernel.h>
#include <Atlas/core/internal/avx2.h>
#include <Atlas/packing/internal/shapes/Outline.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace Atlas::internal {

/// The pixels of a grown chart at one rotation, and those of a ring around it.
struct Raster_mask
{
  struct Run
  {
    Index row, begin, end;
  };
  Index width = 0, height = 0;
  std::vector<Run> runs;           ///< longest first
  std::vector<std::uint64_t> ring; ///< (height + 2 ring_width) rows of `words()` words
  Index ring_pixels = 0;
  Vec2 origin; ///< of the chart, in pixels from the lower left corner of the mask

  static constexpr Index ring_width = 2;
  Index ring_words() const { return (width + 2 * ring_width + 63) / 64; }
};

/// The number of bits that are set; plain code, since x86-64 has no instruction for it at the baseline.
inline int number_of_bits(std::uint64_t x)
{
  x -= x >> 1 & 0x5555555555555555u;
  x = (x & 0x3333333333333333u) + (x >> 2 & 0x3333333333333333u);
  x = (x + (x >> 4)) & 0x0f0f0f0f0f0f0f0fu;
  return static_cast<int>(x * 0x0101010101010101u >> 56);
}

/// A page as a bitmap of occupied pixels, with a border of occupied pixels around it.
///
/// All places at which a mask fits are found at once: the places at which a run of 2^k pixels meets an
/// occupied one are the bits of the page's rows, or-ed over windows of 2^k.
class Raster_page
{
public:
  static constexpr Index border = Raster_mask::ring_width;

  Raster_page(Index columns, Index rows)
      : columns_(columns + 2 * border), rows_(rows + 2 * border), words_(columns_ / 64 + 1),
        stride_(words_ <= most_narrow_words ? 2 * words_ : words_)
  {
    levels_ = 1;
    while ((Index(1) << levels_) <= columns_)
      ++levels_;
    windows_.assign(levels_, std::vector<std::uint64_t>(std::size_t(rows_) * stride_ + most_read_beyond));
    clear();
  }

  void clear()
  {
    std::fill(windows_[0].begin(), windows_[0].end(), 0);
    for (Index y = 0; y < rows_; ++y)
      for (Index x = 0; x < columns_; ++x)
        if (y < border || y >= rows_ - border || x < border || x >= columns_ - border)
          set(x, y);
    for (Index y = 0; y < rows_; ++y)
      update_windows(y);
  }

  Index columns() const { return columns_ - 2 * border; }
  Index rows() const { return rows_ - 2 * border; }

  /// Occupies the pixels of the mask with its lower left corner at (x, y), border included.
  void put(const Raster_mask& mask, Index x, Index y)
  {
    for (const auto& run : mask.runs)
      fill(x + run.begin, x + run.end, y + run.row);
    for (Index row = y; row < y + mask.height; ++row)
      update_windows(row);
  }

  /// Occupies a pixel of the page proper; call `update()` afterwards.
  void put_pixel(Index x, Index y) { set(x + border, y + border); }
  void update()
  {
    for (Index y = 0; y < rows_; ++y)
      update_windows(y);
  }

  struct Place
  {
    Index x = 0, y = 0; ///< of the lower left corner of the mask, border included
    double score = -1;
  };

  /// The place of the mask that touches most of what is there, among the corners of the free space; the
  /// lowest of equals. Rows are searched from `first_row` on, and only `band` rows from the first that has
  /// a place.
  std::optional<Place> search(const Raster_mask& mask, Index first_row, Index band, double better_than,
                              std::uint64_t& work) const
  {
    if (mask.width + 2 * border > columns_ || mask.height + 2 * border > rows_)
      return std::nullopt;
    const Index last = rows_ - border - mask.height;
    Place best;
    best.score = better_than;
    bool is_found = false;
    below_.assign(words_, ~std::uint64_t(0));
    here_.assign(words_, ~std::uint64_t(0));
    above_.assign(words_, ~std::uint64_t(0));
    first_row = std::max(first_row, border);
    if (first_row > border)
      collide(mask, first_row - 1, below_, work);
    if (first_row <= last)
      collide(mask, first_row, here_, work);
    Index stop = last;
    for (Index y = first_row; y <= last && y <= stop; ++y) {
      if (y < last)
        collide(mask, y + 1, above_, work);
      else
        std::fill(above_.begin(), above_.end(), ~std::uint64_t(0));
      if (examine(mask, y, best, work)) {
        if (!is_found)
          stop = std::min<Index>(last, y + std::min(band, last));
        is_found = true;
      }
      std::swap(below_, here_);
      std::swap(here_, above_);
    }
    if (!(best.score > better_than))
      return std::nullopt;
    return best;
  }

private:
  /// Rows of so many words are searched without loops over words; zeros follow them, so that shifts need not
  /// heed their end.
  static constexpr Index most_narrow_words = 4;
  /// Narrow rows are read four words at a time; what is behind their end is not used.
  static constexpr Index most_read_beyond = 3;

  std::uint64_t* row(Index level, Index y) { return windows_[level].data() + std::size_t(y) * stride_; }
  const std::uint64_t* row(Index level, Index y) const
  {
    return windows_[level].data() + std::size_t(y) * stride_;
  }
  void set(Index x, Index y) { row(0, y)[x / 64] |= std::uint64_t(1) << (x % 64); }

  void fill(Index begin, Index end, Index y)
  {
    std::uint64_t* bits = row(0, y);
    for (Index w = begin / 64; w <= (end - 1) / 64; ++w) {
      std::uint64_t mask = ~std::uint64_t(0);
      if (w == begin / 64)
        mask &= ~std::uint64_t(0) << (begin % 64);
      if (w == (end - 1) / 64 && end % 64 != 0)
        mask &= (std::uint64_t(1) << (end % 64)) - 1;
      bits[w] |= mask;
    }
  }

  /// to |= from >> shift
  void or_shifted(const std::uint64_t* from, Index shift, std::uint64_t* to) const
  {
    const Index skip = shift / 64, bits = shift % 64;
    if (bits == 0) {
      for (Index w = 0; w + skip < words_; ++w)
        to[w] |= from[w + skip];
      return;
    }
    for (Index w = 0; w + skip + 1 < words_; ++w)
      to[w] |= from[w + skip] >> bits | from[w + skip + 1] << (64 - bits);
    to[words_ - 1 - skip] |= from[words_ - 1] >> bits;
  }

  void update_windows(Index y)
  {
    for (Index k = 1; k < levels_; ++k) {
      const std::uint64_t* from = row(k - 1, y);
      std::copy(from, from + words_, row(k, y));
      or_shifted(from, Index(1) << (k - 1), row(k, y));
    }
  }

  /// The places in row `y` at which the mask meets occupied pixels.
  void collide(const Raster_mask& mask, Index y, std::vector<std::uint64_t>& result,
               std::uint64_t& work) const
  {
    std::fill(result.begin(), result.end(), 0);
    result[0] = (std::uint64_t(1) << border) - 1;
    const Index last = columns_ - border - mask.width;
    const std::uint64_t beyond = last % 64 == 63 ? 0 : ~std::uint64_t(0) << (last % 64 + 1);
    for (Index w = last / 64 + 1; w < words_; ++w)
      result[w] = ~std::uint64_t(0);
    result[last / 64] |= beyond;
    switch (words_) {
    case 1:
      return collide_narrow<1>(mask, y, result.data(), work);
    case 2:
      return collide_narrow<2>(mask, y, result.data(), work);
    case 3:
      return collide_narrow<3>(mask, y, result.data(), work);
    case 4:
      return collide_narrow<4>(mask, y, result.data(), work);
    default:
      return collide_wide(mask, y, result, work);
    }
  }

  void collide_wide(const Raster_mask& mask, Index y, std::vector<std::uint64_t>& result,
                    std::uint64_t& work) const
  {
    for (std::size_t i = 0; i < mask.runs.size(); ++i) {
      const auto& run = mask.runs[i];
      const Index level = static_cast<Index>(std::bit_width(run.end - run.begin) - 1);
      const std::uint64_t* from = row(level, y + run.row);
      or_shifted(from, run.begin, result.data());
      if (run.end - run.begin > Index(1) << level)
        or_shifted(from, run.end - (Index(1) << level), result.data());
      work += 2 * words_;
      if (i % 4 == 3 &&
          std::all_of(result.begin(), result.end(), [](std::uint64_t w) { return w == ~std::uint64_t(0); }))
        return;
    }
  }

  /// The same in registers.
  template <Index Words>
  void collide_narrow(const Raster_mask& mask, Index y, std::uint64_t* result, std::uint64_t& work) const
  {
#ifdef ATLAS_HAS_AVX2_KERNELS
    if (Words > 1 && has_avx2())
      return collide_four_words<Words>(mask, y, result, work);
#endif
    std::uint64_t hit[Words];
    std::copy(result, result + Words, hit);
    const auto add = [&](const std::uint64_t* from, Index shift) {
      from += shift / 64;
      const Index bits = shift % 64;
      for (Index w = 0; w < Words; ++w)
        hit[w] |= from[w] >> bits | from[w + 1] << 1 << (63 - bits);
    };
    for (std::size_t i = 0; i < mask.runs.size(); ++i) {
      const auto& run = mask.runs[i];
      const Index level = static_cast<Index>(std::bit_width(run.end - run.begin) - 1);
      const std::uint64_t* from = row(level, y + run.row);
      add(from, run.begin);
      if (run.end - run.begin > Index(1) << level)
        add(from, run.end - (Index(1) << level));
      work += 2 * Words;
      if (i % 4 == 3 && std::all_of(hit, hit + Words, [](std::uint64_t w) { return w == ~std::uint64_t(0); }))
        break;
    }
    std::copy(hit, hit + Words, result);
  }

#ifdef ATLAS_HAS_AVX2_KERNELS
  /// The same, all words at a time.
  template <Index Words>
  __attribute__((target("avx2"))) void collide_four_words(const Raster_mask& mask, Index y,
                                                          std::uint64_t* result, std::uint64_t& work) const
  {
    const __m256i all = _mm256_set1_epi64x(-1);
    std::uint64_t words[4];
    std::fill(std::copy(result, result + Words, words), words + 4, ~std::uint64_t(0));
    __m256i hit = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(words));
    std::size_t i = 0;
    for (bool is_full = false; i < mask.runs.size() && !is_full; ++i) {
      const auto& run = mask.runs[i];
      const Index level = static_cast<Index>(std::bit_width(run.end - run.begin) - 1);
      const std::uint64_t* from = row(level, y + run.row);
      hit = _mm256_or_si256(hit, shifted(from, run.begin));
      if (run.end - run.begin > Index(1) << level)
        hit = _mm256_or_si256(hit, shifted(from, run.end - (Index(1) << level)));
      is_full = i % 4 == 3 && _mm256_testc_si256(hit, all);
    }
    work += 2 * Words * i;
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(words), hit);
    std::copy(words, words + Words, result);
  }

  /// Four words from a bit on.
  __attribute__((target("avx2"))) static __m256i shifted(const std::uint64_t* from, Index shift)
  {
    const int bits = static_cast<int>(shift % 64);
    from += shift / 64;
    const __m256i low = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)),
                  high = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from + 1));
    return _mm256_or_si256(_mm256_srl_epi64(low, _mm_cvtsi32_si128(bits)),
                           _mm256_sll_epi64(high, _mm_cvtsi32_si128(64 - bits)));
  }
#endif

  /// Looks at the corners of the free space in row `y`; tells whether the row has a free place.
  bool examine(const Raster_mask& mask, Index y, Place& best, std::uint64_t& work) const
  {
    bool is_free = false;
    for (Index w = 0; w < words_; ++w) {
      const std::uint64_t free = ~here_[w];
      if (free == 0)
        continue;
      is_free = true;
      const std::uint64_t left = here_[w] << 1 | (w > 0 ? here_[w - 1] >> 63 : 1);
      const std::uint64_t right =
          here_[w] >> 1 | (w + 1 < words_ ? here_[w + 1] << 63 : std::uint64_t(1) << 63);
      std::uint64_t corners = free & (left | right) & (below_[w] | above_[w]);
      for (; corners != 0; corners &= corners - 1) {
        const Index x = 64 * w + static_cast<Index>(std::countr_zero(corners));
        const double score = contact(mask, x, y);
        work += 2 * (mask.height + 2 * border) * mask.ring_words();
        if (score > best.score)
          best = {x, y, score};
      }
    }
    return is_free;
  }

  /// The share of the ring that is occupied.
  double contact(const Raster_mask& mask, Index x, Index y) const
  {
    const Index words = mask.ring_words(), left = x - border, skip = left / 64, bits = left % 64;
    int count = 0;
    for (Index j = 0; j < mask.height + 2 * border; ++j) {
      const std::uint64_t* page = row(0, y - border + j) + skip;
      const std::uint64_t* ring = mask.ring.data() + std::size_t(j) * words;
      for (Index w = 0; w < words; ++w) {
        std::uint64_t bits_of_page = page[w] >> bits;
        if (bits != 0 && skip + w + 1 < words_)
          bits_of_page |= page[w + 1] << (64 - bits);
        count += number_of_bits(bits_of_page & ring[w]);
      }
    }
    return mask.ring_pixels > 0 ? double(count) / mask.ring_pixels : 0;
  }

  Index columns_, rows_, words_, stride_, levels_; ///< a row takes `stride_` words, of which it uses `words_`
  std::vector<std::vector<std::uint64_t>> windows_; ///< per level k: or of 2^k pixels from each on
  mutable std::vector<std::uint64_t> below_, here_, above_;
};

} // namespace Atlas::internal

#endif
