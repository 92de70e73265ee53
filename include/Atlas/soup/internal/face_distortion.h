// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_INTERNAL_FACE_DISTORTION_H
#define ATLAS_SOUP_INTERNAL_FACE_DISTORTION_H

#include <Atlas/soup/Polygon_soup.h>

#include <cstddef>
#include <vector>

namespace Atlas {

/// \brief Distortion of every triangle of a mesh with coordinates, up to one scale for all of them.
struct Soup_distortion
{
  std::vector<Index> face;      ///< per triangle that can be measured: its face
  std::vector<double> weight;   ///< per triangle: its share of the area in space
  std::vector<double> largest;  ///< per triangle: s1, the largest singular value from plane to space
  std::vector<double> smallest; ///< per triangle: s2
};

/// \brief Measures the coordinates of a soup; triangles without area in space or in the plane are left out.
/// O(n log n). \throw Invalid_argument the soup has faces, but not a coordinate per corner
Soup_distortion measure_distortion(const Polygon_soup& soup);

/// \brief Per face of a soup how far it is from its true shape and size: the largest of s1 and 1/s2 over its
/// triangles; 1 is isometric, NaN unknown.
std::vector<double> face_stretch(const Soup_distortion& distortion, std::size_t number_of_faces);

/// \brief Shares of the area of the surface in bins of equal width; values outside count in the first or last
/// bin.
struct Histogram
{
  double low = 0, high = 1;
  std::vector<double> share; ///< per bin, sums up to 1
};

/// By how many degrees right angles of the surface are off on the page at worst, 2 atan(s1/s2) - 90, in
/// [0, 45], in 45 bins.
Histogram angle_histogram(const Soup_distortion& distortion);

/// The binary logarithm of the area on the page over its fair share, in [-2, 2], in 64 bins.
Histogram area_histogram(const Soup_distortion& distortion);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/soup/internal/face_distortion_impl.h>
#endif

#endif
