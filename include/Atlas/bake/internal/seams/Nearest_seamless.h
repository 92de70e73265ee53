// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_SEAMS_NEAREST_SEAMLESS_H
#define ATLAS_BAKE_INTERNAL_SEAMS_NEAREST_SEAMLESS_H

#include <Atlas/bake/internal/seams/Seam_equations.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Kernel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief The numbers in [0, 255] nearest to given ones, by least squares, with which the sides of seams see
/// the same but for a tolerance; then, where they have to be whole, whole numbers near them that keep it.
///
/// The dual method of Hildreth (1957): one after the other, each equation that is not kept is brought back by
/// the least change, and one that has changed more than it needs gives back.
class Nearest_seamless
{
public:
  /// \param ease  per number: how easily it changes, positive; 1 is usual
  /// \param are_whole  whether the numbers are whole in the end
  Nearest_seamless(const Seam_equations& equations, const std::vector<float>& ease, bool are_whole)
      : equations_(equations), ease_(ease), are_whole_(are_whole)
  {
    // Neighbours on a seam pull at the same texels: far from each other in the order, they agree sooner.
    std::vector<std::pair<std::uint32_t, Index>> keys;
    for (Index i = 0; i < equations.size(); ++i)
      keys.emplace_back(i * 2654435761u, i);
    std::sort(keys.begin(), keys.end());
    for (const auto& key : keys)
      order_.push_back(key.second);
  }

  /// Changes the numbers. Once cancelled, it ends as soon as it can.
  void operator()(std::vector<double>& numbers, const Execution& execution) const
  {
    for (int pass = 0; pass < most_passes && !execution.is_cancelled() && (pass == 0 || !is_kept(numbers));
         ++pass) {
      approach(numbers, execution);
      for (double& number : numbers)
        number = std::clamp(number, 0.0, 255.0);
      if (!are_whole_)
        continue;
      for (double& number : numbers)
        number = std::round(number);
      for (int round = 0; round < most_repairs && !execution.is_cancelled(); ++round)
        if (!repair(numbers))
          break;
    }
  }

private:
  static constexpr double tolerance = 0.4; ///< of the solution: rounding takes about as much again
  static constexpr double kept = 0.6;      ///< of whole numbers
  static constexpr double settled = 0.02;  ///< when no equation is farther beyond the tolerance, it is over
  static constexpr double wanted = 0.97;   ///< of these in the end
  static constexpr int most_sweeps = 1000, longest_rest = 64, most_repairs = 50, most_passes = 4;

  bool is_kept(const std::vector<double>& numbers) const
  {
    for (Index i = 0; i < equations_.size(); ++i)
      if (excess(value(i, numbers), wanted) != 0)
        return false;
    return true;
  }

  static double excess(double value, double bound)
  {
    return value > bound ? value - bound : value < -bound ? value + bound : 0;
  }

  double value(Index i, const std::vector<double>& numbers) const
  {
    double sum = equations_.constant(i);
    for (const Seam_equations::Term& term : equations_.terms(i))
      sum += double(term.weight) * std::clamp(numbers[term.number], 0.0, 255.0);
    return sum;
  }

  /// The least squares solution, not yet clamped.
  void approach(std::vector<double>& numbers, const Execution& execution) const
  {
    std::vector<double> pull(order_.size(), 0);     // the multiplier of each equation
    std::vector<std::uint16_t> rest(order_.size()), // for so many sweeps it is left alone
        patience(order_.size(), 1);                 // the longer it has been kept, the longer
    for (int sweep = 0, last_change = 0; sweep < last_change + longest_rest; ++sweep) {
      if (sweep == most_sweeps || !execution.proceed())
        break;
      for (const Index i : order_) {
        if (rest[i] > 0) {
          --rest[i];
          continue;
        }
        const bool is_kept = adjust(i, pull[i], numbers) <= settled;
        patience[i] = is_kept ? std::min<std::uint16_t>(2 * patience[i], longest_rest) : 1;
        rest[i] = patience[i] - 1;
        last_change = is_kept ? last_change : sweep + 1;
      }
    }
  }

  /// Brings an equation to its tolerance, or gives back what it has pulled in vain. Returns how far it was
  /// off.
  double adjust(Index i, double& pull, std::vector<double>& numbers) const
  {
    const double at = value(i, numbers), off = excess(at, tolerance);
    if (pull == 0 && off == 0)
      return 0;
    double give = 0;
    for (const Seam_equations::Term& term : equations_.terms(i))
      give += double(term.weight) * double(term.weight) * double(ease_[term.number]);
    const double change = pull > 0   ? std::max((at - tolerance) / give, -pull)
                          : pull < 0 ? std::min((at + tolerance) / give, -pull)
                                     : off / give;
    pull += change;
    for (const Seam_equations::Term& term : equations_.terms(i))
      numbers[term.number] -= change * double(term.weight) * double(ease_[term.number]);
    return std::abs(off);
  }

  /// Steps of whole numbers where equations are not kept. Returns whether there were any.
  bool repair(std::vector<double>& numbers) const
  {
    std::vector<double> values(equations_.size());
    std::vector<std::uint8_t> is_candidate(numbers.size(), 0);
    for (Index i = 0; i < values.size(); ++i) {
      values[i] = value(i, numbers);
      if (excess(values[i], kept) != 0)
        for (const Seam_equations::Term& term : equations_.terms(i))
          is_candidate[term.number] = 1;
    }
    const Columns columns = columns_of(is_candidate);
    bool has_moved = false;
    for (Index k = 0; k < numbers.size(); ++k)
      if (is_candidate[k])
        has_moved = step(columns.of(k), numbers[k], values) || has_moved;
    return has_moved;
  }

  /// The equations that depend on numbers.
  struct Columns
  {
    struct Entry
    {
      Index equation;
      float weight;
    };
    std::vector<std::size_t> first; ///< per number, one more closes
    std::vector<Entry> entries;

    std::span<const Entry> of(Index k) const
    {
      return std::span<const Entry>(entries).subspan(first[k], first[k + 1] - first[k]);
    }
  };

  Columns columns_of(const std::vector<std::uint8_t>& is_wanted) const
  {
    Columns columns{std::vector<std::size_t>(is_wanted.size() + 2, 0), {}};
    const auto for_each = [&](auto visit) {
      for (Index i = 0; i < equations_.size(); ++i)
        for (const Seam_equations::Term& term : equations_.terms(i))
          if (is_wanted[term.number])
            visit(i, term);
    };
    for_each([&](Index, const Seam_equations::Term& term) { ++columns.first[term.number + 2]; });
    for (std::size_t k = 2; k < columns.first.size(); ++k)
      columns.first[k] += columns.first[k - 1];
    columns.entries.resize(columns.first.back());
    for_each([&](Index i, const Seam_equations::Term& term) {
      columns.entries[columns.first[term.number + 1]++] = {i, term.weight};
    });
    return columns;
  }

  static double cost(double value)
  {
    const double off = excess(value, kept);
    return off * off * off * off;
  }

  /// The best of a few steps of one number.
  static bool step(std::span<const Columns::Entry> column, double& number, std::vector<double>& values)
  {
    double best = -1e-9, taken = 0;
    for (const double size : {-1., 1., -3., 3., -8., 8., -20., 20.}) {
      if (number + size < 0 || number + size > 255)
        continue;
      double change = 0;
      for (const Columns::Entry& entry : column)
        change += cost(values[entry.equation] + size * double(entry.weight)) - cost(values[entry.equation]);
      if (change < best) {
        best = change;
        taken = size;
      }
    }
    for (const Columns::Entry& entry : column)
      values[entry.equation] += taken * double(entry.weight);
    number += taken;
    return taken != 0;
  }

  const Seam_equations& equations_;
  const std::vector<float>& ease_;
  bool are_whole_;
  std::vector<Index> order_;
};

} // namespace Atlas::internal

#endif
