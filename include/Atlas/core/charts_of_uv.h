// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_CHARTS_OF_UV_H
#define ATLAS_CORE_CHARTS_OF_UV_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/library.h>

#include <span>

namespace Atlas {

/// The charts that coordinates at corners make of a surface: triangles are glued along edges at both ends of
/// which their coordinates are equal. Triangles without finite coordinates get the chart `no_index`. Linear.
Segmentation charts_of_uv(const Surface& surface, std::span<const Point_2> uv);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/core/internal/charts_of_uv_impl.h>
#endif

#endif
