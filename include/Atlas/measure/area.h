// SPDX-License-Identifier: MIT
#ifndef ATLAS_MEASURE_AREA_H
#define ATLAS_MEASURE_AREA_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/library.h>

namespace Atlas {

/// The area of the surface, in squared units of the model.
double area_3d(const Surface& surface);

/// The area of the chart in space.
double area_3d(const Chart& chart);

/// The area of the flattened chart: flipped triangles count negative.
double area_uv(const Chart& chart);

/// The length of all seams in units of the model, each edge once: edges with a triangle on both sides that
/// are not glued. The border of the surface is no seam.
double seam_length(const Surface& surface, const Segmentation& segmentation);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/measure/internal/area_impl.h>
#endif

#endif
