// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_SEAMS_SEAM_EQUATIONS_H
#define ATLAS_BAKE_INTERNAL_SEAMS_SEAM_EQUATIONS_H

#include <Atlas/bake/internal/seams/Seam_samples.h>
#include <Atlas/core/Kernel.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief What the two sides of seams see apart: for each place the weights of the numbers that it depends
/// on, and how far apart the sides are where all numbers are 0.
class Seam_equations
{
public:
  struct Term
  {
    Index number;
    float weight;
  };

  std::size_t size() const { return constant_.size(); }
  std::span<const Term> terms(Index equation) const
  {
    return std::span<const Term>(terms_).subspan(first_[equation], first_[equation + 1] - first_[equation]);
  }
  double constant(Index equation) const { return constant_[equation]; }

  /// \param terms  in any order, numbers several times too; is left empty
  void add(std::vector<std::pair<Index, double>>& terms, double constant)
  {
    std::sort(terms.begin(), terms.end());
    for (std::size_t i = 0; i < terms.size();) {
      const Index number = terms[i].first;
      double weight = 0;
      for (; i < terms.size() && terms[i].first == number; ++i)
        weight += terms[i].second;
      if (weight != 0)
        terms_.push_back({number, static_cast<float>(weight)});
    }
    terms.clear();
    if (terms_.size() == first_.back()) // both sides see the same, whatever there is
      return;
    first_.push_back(terms_.size());
    constant_.push_back(constant);
  }

private:
  std::vector<std::size_t> first_{0}; ///< per equation, one more closes
  std::vector<Term> terms_;
  std::vector<double> constant_;
};

/// \brief Texels of the pages as they are numbered in equations: only those that seams see.
class Seam_texels
{
public:
  Seam_texels(Image_size size, std::size_t pages)
      : sizes_(level_sizes(size)), number_(pages * size.width * size.height, no_index)
  {}

  /// The texels by their numbers; of all pages, page by page.
  const std::vector<std::size_t>& texels() const { return texels_; }
  /// By their numbers: the finest level at which they are seen.
  const std::vector<std::size_t>& finest() const { return finest_; }

  /// What a lookup depends on, times a factor. \param visit  called with a number and a weight
  template <typename Visit>
  void for_each_texel(const Bilinear_lookup& lookup, std::size_t level, double factor, Visit visit)
  {
    for (std::size_t i = 0; i < 4; ++i)
      if (lookup.weight[i] > 0)
        expand(lookup.texel[i], level, factor * lookup.weight[i], level, visit);
  }

private:
  /// A texel of a level is the mean of four of the level above.
  template <typename Visit>
  void expand(std::size_t texel, std::size_t level, double weight, std::size_t seen_at, Visit visit)
  {
    if (level == 0) {
      if (number_[texel] == no_index) {
        number_[texel] = static_cast<Index>(texels_.size());
        texels_.push_back(texel);
        finest_.push_back(seen_at);
      }
      std::size_t& finest = finest_[number_[texel]];
      finest = std::min(finest, seen_at);
      visit(number_[texel], weight);
      return;
    }
    const Image_size coarse = sizes_[level], fine = sizes_[level - 1];
    const std::size_t texels_of_page = coarse.width * coarse.height, page = texel / texels_of_page,
                      x = texel % texels_of_page % coarse.width, y = texel % texels_of_page / coarse.width,
                      right = std::min(2 * x + 1, fine.width - 1),
                      below = std::min(2 * y + 1, fine.height - 1);
    for (const std::size_t j : {2 * y, below})
      for (const std::size_t i : {2 * x, right})
        expand((page * fine.height + j) * fine.width + i, level - 1, weight / 4, seen_at, visit);
  }

  std::array<Image_size, seam_levels> sizes_;
  std::vector<Index> number_; ///< per texel
  std::vector<std::size_t> texels_, finest_;
};

} // namespace Atlas::internal

#endif
