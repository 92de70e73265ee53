// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_CERTIFICATE_OPTIONS_H
#define ATLAS_VALIDATION_CERTIFICATE_OPTIONS_H

#include <Atlas/core/Packing.h>

#include <cstddef>

namespace Atlas {

/// How coordinates are stored where they are used.
enum class Uv_precision {
  single_precision, ///< 32 bits: glTF, engines, graphics hardware
  double_precision  ///< 64 bits: taken as they are
};

/// By how many texels a distance may fall short of the gutter: distances are measured in coordinates that
/// have been rounded, to a thousandth of a texel on a page of 16 k.
inline constexpr double default_gutter_tolerance = 0.01;

/// What a certificate is asked for.
struct Certificate_options
{
  Index width = default_texture_size;  ///< texels; a unit of u
  Index height = default_texture_size; ///< texels; a unit of v
  double gutter = 0; ///< least distance between charts, in texels; half of it to the page border
  double gutter_tolerance = default_gutter_tolerance; ///< texels
  Uv_precision precision = Uv_precision::double_precision;
  std::size_t max_overlaps = 1'000'000; ///< pairs of triangles to count at most
  std::size_t max_culprits = 1'000'000; ///< faces to list at most
};

} // namespace Atlas

#endif
