// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_SURFACE_SURFACE_CONNECTIVITY_H
#define ATLAS_SEGMENTATION_INTERNAL_SURFACE_SURFACE_CONNECTIVITY_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/edge_rules.h>
#include <Atlas/segmentation/internal/surface/Submesh.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>

#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// The connectivity of the whole surface, open at borders, patch borders and wanted seams. Local numbers are
/// those of the surface.
inline Submesh surface_connectivity(const Surface& surface)
{
  std::vector<Index> all(surface.number_of_triangles()), local(surface.number_of_triangles());
  std::iota(all.begin(), all.end(), Index(0));
  return make_submesh(
      surface, std::move(all), [&](Index h) { return may_cross(surface, h); }, local);
}

/// Per triangle, the unit normal of its input face.
inline std::vector<Vector_3> face_normals(const Surface& surface)
{
  std::vector<Vector_3> sum(surface.number_of_faces, Vector_3(0, 0, 0));
  for (Index t = 0; t < surface.number_of_triangles(); ++t)
    sum[surface.face[t]] = sum[surface.face[t]] + triangle_area(surface, t) * unit_normal(surface, t);
  std::vector<Vector_3> normals(surface.number_of_triangles());
  for (Index t = 0; t < normals.size(); ++t) {
    const Vector_3& n = sum[surface.face[t]];
    const double length = std::sqrt(n.squared_length());
    normals[t] = length > 0 ? n / length : unit_normal(surface, t);
  }
  return normals;
}

} // namespace Atlas::internal

#endif
