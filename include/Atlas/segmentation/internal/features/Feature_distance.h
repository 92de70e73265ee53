// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_FEATURES_FEATURE_DISTANCE_H
#define ATLAS_SEGMENTATION_INTERNAL_FEATURES_FEATURE_DISTANCE_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/segmentation/internal/features/Fast_marching.h>
#include <Atlas/segmentation/internal/surface/Submesh.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// How far things are from the features.
struct Feature_distance
{
  std::vector<double> vertex;   ///< per vertex of the submesh
  std::vector<double> triangle; ///< per triangle
  std::vector<Index> component; ///< per vertex of the submesh
  Index number_of_components = 0;
};

/// Numbers the connected components of a submesh, per vertex, in the order of their first vertices.
inline Index number_components(const Submesh& submesh, std::vector<Index>& component)
{
  const Components triangles = connected_components(submesh.opposite);
  component.resize(submesh.number_of_vertices());
  for (Index v = 0; v < component.size(); ++v)
    component[v] = triangles.of_triangle[submesh.outgoing[submesh.first[v]] / 3];
  return triangles.count;
}

/// \brief The paper's rule for closed components without features: the two ends of a diameter become the
/// highest places, and the value falls with the distance to the nearer end.
///
/// A diameter is sought by sweeps from place to farthest place, and once more from the place farthest from
/// the ends found; the longer way of the two is taken. All components at once.
class Diameter_rule
{
public:
  Diameter_rule(Fast_marching& distances, Feature_distance& field)
      : distances_(distances), field_(field), is_featureless_(field.number_of_components, 1)
  {
    for (Index v = 0; v < field.vertex.size(); ++v)
      if (distances.is_reached(v))
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
      largest[field_.component[v]] = distances_.distance()[v];
    for (Index v = 0; v < field_.vertex.size(); ++v)
      if (is_featureless_[field_.component[v]])
        field_.vertex[v] = largest[field_.component[v]] - distances_.distance()[v];
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
    distances_.run(vertices);
    return highest(distances_.distance());
  }

  struct Ends
  {
    std::vector<Index> a, b;
    std::vector<double> length;
  };

  /// From the given vertices to the farthest place, and on from there; the way never gets shorter.
  Ends sweep(const std::vector<Index>& start)
  {
    constexpr int sweeps = 3; // on shapes without many arms the way is a longest one by then
    Ends ends{{}, farthest_from(start), {}};
    for (int i = 0; i < sweeps; ++i) {
      ends.a = std::move(ends.b);
      ends.b = farthest_from(ends.a);
    }
    for (const Index v : ends.b)
      ends.length.push_back(distances_.distance()[v]);
    return ends;
  }

  static std::vector<Index> both(std::vector<Index> a, const std::vector<Index>& b)
  {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  }

  Fast_marching& distances_;
  Feature_distance& field_;
  std::vector<std::uint8_t> is_featureless_;
};

/// The distance of a triangle is the mean over the corners of its input face's triangles.
inline std::vector<double> distance_of_triangles(const Surface& surface, const Submesh& submesh,
                                                 const std::vector<double>& vertex)
{
  std::vector<double> sum(surface.number_of_faces, 0), count(surface.number_of_faces, 0);
  for (Index h = 0; h < submesh.vertex.size(); ++h) {
    sum[surface.face[h / 3]] += vertex[submesh.vertex[h]];
    ++count[surface.face[h / 3]];
  }
  std::vector<double> result(submesh.triangles.size());
  for (Index t = 0; t < result.size(); ++t)
    result[t] = sum[surface.face[t]] / count[surface.face[t]];
  return result;
}

/// The distance to the features, per halfedge of the surface: see Atlas::distance_to_features().
inline Feature_distance distance_to_features(const Surface& surface, const Submesh& submesh,
                                             const std::vector<std::uint8_t>& is_feature)
{
  std::vector<Index> sources;
  for (Index v = 0; v < submesh.number_of_vertices(); ++v)
    if (submesh.is_on_border[v])
      sources.push_back(v);
  for (Index h = 0; h < submesh.vertex.size(); ++h)
    if (is_feature[h])
      sources.push_back(submesh.vertex[h]);
  Fast_marching distances(surface, submesh);
  distances.run(sources);
  Feature_distance field;
  field.vertex = distances.distance();
  field.number_of_components = number_components(submesh, field.component);
  Diameter_rule(distances, field).run();
  field.triangle = distance_of_triangles(surface, submesh, field.vertex);
  return field;
}

} // namespace Atlas::internal

#endif
