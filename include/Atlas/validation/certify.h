// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_CERTIFY_H
#define ATLAS_VALIDATION_CERTIFY_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Packing.h>
#include <Atlas/core/Surface.h>
#include <Atlas/validation/Atlas_certificate.h>
#include <Atlas/validation/internal/Certifier.h>

#include <span>

namespace Atlas {

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
/// \pre `corner_uv.size() == surface.number_of_corners`, and `face_page` is empty or has an entry per face
inline Atlas_certificate certify(const Surface& surface, std::span<const Point_2> corner_uv,
                                 std::span<const Index> face_page = {},
                                 const Certificate_options& options = {},
                                 const Execution& execution = Execution())
{
  CGAL_precondition(corner_uv.size() == surface.number_of_corners);
  CGAL_precondition(face_page.empty() || face_page.size() == surface.number_of_faces);
  return internal::Certifier(surface, corner_uv, face_page, options, execution).run();
}

} // namespace Atlas

#endif
