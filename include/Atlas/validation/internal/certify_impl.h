// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_INTERNAL_CERTIFY_IMPL_H
#define ATLAS_VALIDATION_INTERNAL_CERTIFY_IMPL_H

#include <Atlas/core/errors.h>
#include <Atlas/validation/certify.h>
#include <Atlas/validation/internal/Certifier.h>

#include <cmath>

namespace Atlas {

ATLAS_INLINE Atlas_certificate certify(const Surface& surface, std::span<const Point_2> corner_uv,
                                       std::span<const Index> face_page, const Certificate_options& options,
                                       const Execution& execution)
{
  internal::require(corner_uv.size() == surface.number_of_corners, "corner_uv",
                    "must have an entry for each corner of the surface");
  internal::require(face_page.empty() || face_page.size() == surface.number_of_faces, "face_page",
                    "must be empty or have an entry for each face of the surface");
  internal::require(options.width > 0 && options.height > 0, "width and height", "must be at least 1 texel");
  internal::require(std::isfinite(options.gutter) && options.gutter >= 0, "gutter",
                    "must be finite and not negative");
  return internal::Certifier(surface, corner_uv, face_page, options, execution).run();
}

} // namespace Atlas

#endif
