// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_CERTIFY_H
#define ATLAS_VALIDATION_CERTIFY_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Packing.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/library.h>
#include <Atlas/validation/Atlas_certificate.h>

#include <cstddef>
#include <span>

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

/// \brief Examines texture coordinates of any origin.
///
/// Coordinates are rounded to the precision asked for, then everything is decided on the rounded values. The
/// result does not depend on the number of threads. O(n log n) whatever the input; a valid atlas costs little
/// more than reading it, because overlap is decided on the border edges alone (see `is_overlap_free()`).
///
/// \param corner_uv  coordinates per corner of the input (`surface.corner` tells which a triangle has), in
/// pages
///                   of size 1 x 1; NaN where there are none
/// \param face_page  page per face of the input; empty: all on one page
///
/// \throws Invalid_argument unless `corner_uv` has an entry for each corner, and `face_page` is empty or has
/// one for each face; and if the size of the page or the gutter cannot be
Atlas_certificate certify(const Surface& surface, std::span<const Point_2> corner_uv,
                          std::span<const Index> face_page = {}, const Certificate_options& options = {},
                          const Execution& execution = Execution());

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/validation/internal/certify_impl.h>
#endif

#endif
