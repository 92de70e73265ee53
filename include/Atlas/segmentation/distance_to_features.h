// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_DISTANCE_TO_FEATURES_H
#define ATLAS_SEGMENTATION_DISTANCE_TO_FEATURES_H

#include <Atlas/Surface.h>
#include <Atlas/segmentation/internal/Front.h>
#include <Atlas/segmentation/internal/Piece.h>
#include <Atlas/segmentation/internal/whole_surface.h>

#include <cstdint>
#include <vector>

namespace Atlas {

namespace internal {

/// How far things are from the features.
struct Feature_distance
{
  std::vector<double> vertex;   ///< per vertex of the piece
  std::vector<double> triangle; ///< per triangle
  std::vector<Index> component; ///< per vertex of the piece
  Index number_of_components = 0;
};

/// Numbers the connected components of a piece, per vertex.
inline Index number_components(const Piece& piece, std::vector<Index>& component)
{
  component.assign(piece.number_of_vertices(), no_index);
  Index count = 0;
  std::vector<Index> stack;
  for (Index seed = 0; seed < component.size(); ++seed) {
    if (component[seed] != no_index)
      continue;
    component[seed] = count;
    stack.push_back(seed);
    while (!stack.empty()) {
      const Index v = stack.back();
      stack.pop_back();
      for (Index k = piece.first[v]; k < piece.first[v + 1]; ++k) {
        const Index h = piece.outgoing[k];
        for (const Index w : {piece.head(h), piece.vertex[previous_halfedge(h)]})
          if (component[w] == no_index) {
            component[w] = count;
            stack.push_back(w);
          }
      }
    }
    ++count;
  }
  return count;
}

/// Per component for which `is_chosen`, the vertex with the largest value.
inline std::vector<Index> highest_vertices(const Feature_distance& field, const std::vector<double>& value,
                                           const std::vector<std::uint8_t>& is_chosen)
{
  std::vector<Index> highest(field.number_of_components, no_index);
  for (Index v = 0; v < value.size(); ++v) {
    Index& best = highest[field.component[v]];
    if (is_chosen[field.component[v]] && (best == no_index || value[v] > value[best]))
      best = v;
  }
  std::erase(highest, no_index);
  return highest;
}

/// Closed components without features: the two ends of a diameter become the highest places, and the value
/// falls with the distance to the nearer end.
inline void rise_towards_ends_of_diameters(Front& front, Feature_distance& field)
{
  std::vector<std::uint8_t> is_featureless(field.number_of_components, 1);
  for (Index v = 0; v < field.vertex.size(); ++v)
    if (front.is_reached(v))
      is_featureless[field.component[v]] = 0;
  const auto highest = [&](const std::vector<double>& value) {
    return highest_vertices(field, value, is_featureless);
  };
  std::vector<Index> ends = highest(std::vector<double>(field.vertex.size(), 0));
  if (ends.empty())
    return;
  front.run(ends);
  ends = highest(front.distance());
  front.run(ends);
  const std::vector<Index> others = highest(front.distance());
  ends.insert(ends.end(), others.begin(), others.end());
  front.run(ends);
  std::vector<double> largest(field.number_of_components, 0);
  for (const Index v : highest(front.distance()))
    largest[field.component[v]] = front.distance()[v];
  for (Index v = 0; v < field.vertex.size(); ++v)
    if (is_featureless[field.component[v]])
      field.vertex[v] = largest[field.component[v]] - front.distance()[v];
}

/// The distance of a triangle is the mean over the corners of its input face's triangles.
inline std::vector<double> distance_of_triangles(const Surface& surface, const Piece& piece,
                                                 const std::vector<double>& vertex)
{
  std::vector<double> sum(surface.number_of_faces, 0), count(surface.number_of_faces, 0);
  for (Index h = 0; h < piece.vertex.size(); ++h) {
    sum[surface.face[h / 3]] += vertex[piece.vertex[h]];
    ++count[surface.face[h / 3]];
  }
  std::vector<double> result(piece.triangles.size());
  for (Index t = 0; t < result.size(); ++t)
    result[t] = sum[surface.face[t]] / count[surface.face[t]];
  return result;
}

inline Feature_distance distance_to_features(const Surface& surface, const Piece& piece,
                                           const std::vector<std::uint8_t>& is_feature)
{
  std::vector<Index> sources;
  for (Index v = 0; v < piece.number_of_vertices(); ++v)
    if (piece.is_on_border[v])
      sources.push_back(v);
  for (Index h = 0; h < piece.vertex.size(); ++h)
    if (is_feature[h])
      sources.push_back(piece.vertex[h]);
  Front front(surface, piece);
  front.run(sources);
  Feature_distance field;
  field.vertex = front.distance();
  field.number_of_components = number_components(piece, field.component);
  rise_towards_ends_of_diameters(front, field);
  field.triangle = distance_of_triangles(surface, piece, field.vertex);
  return field;
}

} // namespace internal

/// \brief The function that drives the growth of charts: per triangle, the distance along the surface to the
/// nearest border, patch border, wanted seam or feature, in the unit of the model.
///
/// Closed components without any of them get the function of the paper's diameter rule: highest at the two
/// ends of a diameter, falling with the distance to the nearer one. Triangles of one face have one value.
/// Section 3.2 of the LSCM paper; distances by fast marching. O(n log n).
///
/// \param is_feature  per halfedge
inline std::vector<double> distance_to_features(const Surface& surface,
                                                const std::vector<std::uint8_t>& is_feature)
{
  return internal::distance_to_features(surface, internal::whole_surface(surface), is_feature).triangle;
}

} // namespace Atlas

#endif
