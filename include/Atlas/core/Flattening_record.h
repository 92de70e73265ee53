// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_FLATTENING_RECORD_H
#define ATLAS_CORE_FLATTENING_RECORD_H

#include <cstddef>

namespace Atlas {

/// \brief What the optimisation did to a chart.
struct Distortion_record
{
  double before = 0; ///< mean energy over that of an isometry; infinite for a chart that had flips
  double after = 0;
  std::size_t iterations = 0;
  bool was_border_guarded = false; ///< whether the border had to be kept from touching itself
};

/// Where the coordinates of a chart came from.
enum class Flattening_start {
  first_choice, ///< the parameterizer that was asked for, as a rule LSCM
  tutte,        ///< Tutte's map, because the first choice was not one-to-one
  schnyder      ///< a drawing on a grid, because Tutte's map needs more than double precision
};

/// A sentence for the user.
inline const char* message(Flattening_start start)
{
  switch (start) {
  case Flattening_start::first_choice:
    return "the chart keeps the map of the chosen parameterizer";
  case Flattening_start::tutte:
    return "the chosen parameterizer was not one-to-one; the chart starts from Tutte's map";
  case Flattening_start::schnyder:
    return "Tutte's map is below double precision; the chart starts from a drawing on a grid";
  }
  return "unknown start";
}

/// \brief What was done to flatten a chart.
struct Flattening_record
{
  Flattening_start start = Flattening_start::first_choice;
  std::size_t flips = 0;        ///< triangles that the first choice turned over or made flat
  bool was_overlapping = false; ///< whether the first choice made the border cross or touch itself
  bool is_optimized = false;    ///< whether the optimiser had a part in the result
  Distortion_record distortion; ///< of the optimiser's last run
};

} // namespace Atlas

#endif
