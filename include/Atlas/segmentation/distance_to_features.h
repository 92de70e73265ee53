// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_DISTANCE_TO_FEATURES_H
#define ATLAS_SEGMENTATION_DISTANCE_TO_FEATURES_H

#include <Atlas/core/Surface.h>
#include <Atlas/segmentation/internal/features/Fast_marching.h>
#include <Atlas/segmentation/internal/surface/Submesh.h>
#include <Atlas/segmentation/internal/surface/surface_connectivity.h>

#include <cstddef>
#include <cstdint>
#include <utility>
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
inline Index number_components(const Submesh& piece, std::vector<Index>& component)
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

/// \brief The paper's rule for closed components without features: the two ends of a diameter become the
/// highest places, and the value falls with the distance to the nearer end.
///
/// A diameter is sought by sweeps from place to farthest place, and once more from the place farthest from
/// the ends found; the longer way of the two is taken. All components at once.
class Diameter_rule
{
public:
  Diameter_rule(Fast_marching& front, Feature_distance& field)
      : front_(front), field_(field), is_featureless_(field.number_of_components, 1)
  {
    for (Index v = 0; v < field.vertex.size(); ++v)
      if (front.is_reached(v))
        is_featureless_[field.component[v]] = 0;
  }

  void run()
  {
    const std::vector<Index> first = highest(std::vector<double>(field_.vertex.size(), 0));
    if (first.empty())
      return;
    Ends ends = sweep(first);
    const Ends others = sweep(farthest_from(both(ends.a, ends.b)));
    for (std::size_t i = 0; i < first.size(); ++i)
      if (others.length[i] > ends.length[i]) {
        ends.a[i] = others.a[i];
        ends.b[i] = others.b[i];
      }
    std::vector<double> largest(field_.number_of_components, 0);
    for (const Index v : farthest_from(both(ends.a, ends.b)))
      largest[field_.component[v]] = front_.distance()[v];
    for (Index v = 0; v < field_.vertex.size(); ++v)
      if (is_featureless_[field_.component[v]])
        field_.vertex[v] = largest[field_.component[v]] - front_.distance()[v];
  }

private:
  /// Per featureless component, in order, the vertex with the largest value.
  std::vector<Index> highest(const std::vector<double>& value) const
  {
    std::vector<Index> result(field_.number_of_components, no_index);
    for (Index v = 0; v < value.size(); ++v) {
      Index& best = result[field_.component[v]];
      if (is_featureless_[field_.component[v]] && (best == no_index || value[v] > value[best]))
        best = v;
    }
    std::erase(result, no_index);
    return result;
  }

  std::vector<Index> farthest_from(const std::vector<Index>& vertices)
  {
    front_.run(vertices);
    return highest(front_.distance());
  }

  struct Ends
  {
    std::vector<Index> a, b;
    std::vector<double> length;
  };

  /// From the given vertices to the farthest place, and on from there; the way never gets shorter.
  Ends sweep(const std::vector<Index>& start)
  {
    constexpr int sweeps = 3;
    Ends ends{{}, farthest_from(start), {}};
    for (int i = 0; i < sweeps; ++i) {
      ends.a = std::move(ends.b);
      ends.b = farthest_from(ends.a);
    }
    for (const Index v : ends.b)
      ends.length.push_back(front_.distance()[v]);
    return ends;
  }

  static std::vector<Index> both(std::vector<Index> a, const std::vector<Index>& b)
  {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  }

  Fast_marching& front_;
  Feature_distance& field_;
  std::vector<std::uint8_t> is_featureless_;
};

/// The distance of a triangle is the mean over the corners of its input face's triangles.
inline std::vector<double> distance_of_triangles(const Surface& surface, const Submesh& piece,
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

inline Feature_distance distance_to_features(const Surface& surface, const Submesh& piece,
                                             const std::vector<std::uint8_t>& is_feature)
{
  std::vector<Index> sources;
  for (Index v = 0; v < piece.number_of_vertices(); ++v)
    if (piece.is_on_border[v])
      sources.push_back(v);
  for (Index h = 0; h < piece.vertex.size(); ++h)
    if (is_feature[h])
      sources.push_back(piece.vertex[h]);
  Fast_marching front(surface, piece);
  front.run(sources);
  Feature_distance field;
  field.vertex = front.distance();
  field.number_of_components = number_components(piece, field.component);
  Diameter_rule(front, field).run();
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
  return internal::distance_to_features(surface, internal::surface_connectivity(surface), is_feature)
      .triangle;
}

} // namespace Atlas

#endif
