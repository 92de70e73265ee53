// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_REPEATED_PARTS_H
#define ATLAS_PIPELINE_INTERNAL_REPEATED_PARTS_H

#include <Atlas/core/Packing.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/core/internal/Flattened_chart.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/pipeline/internal/part_congruence.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief The connected parts of a surface that are copies of others of its parts.
///
/// Of each set of copies one is the model. Only models are segmented and flattened; the copies take over
/// their charts, corner by corner, and so are equal to them whatever the order of their triangles, and
/// however last digits differ. A part is compared with the last few models of about its size: O(n log n) in
/// all.
class Repeated_parts
{
public:
  Repeated_parts() = default;

  /// \param stacking  which copies count: none, those that a motion of space makes, or mirror images too
  Repeated_parts(const Surface& surface, Chart_stacking stacking)
  {
    if (stacking == Chart_stacking::none || surface.number_of_triangles() == 0)
      return;
    std::vector<Surface_part> parts = parts_of(surface);
    find_copies(surface, parts, stacking == Chart_stacking::copies_and_mirrored);
    if (copies_.empty())
      return;
    std::vector<Index> kept;
    for (const Surface_part& part : parts)
      kept.insert(kept.end(), part.triangles.begin(), part.triangles.end());
    std::sort(kept.begin(), kept.end());
    keep(surface, std::move(kept));
  }

  bool is_empty() const { return copies_.empty(); }
  std::size_t number_of_copies() const { return copies_.size(); }

  /// The surface without the copies: triangles in their order, faces and corners with their numbers.
  Surface& models() { return models_; }

  /// The segmentation of the whole surface: charts of the models keep their numbers.
  ///
  /// \param model_of_chart  output: per chart the chart of the models that it is, or is a copy of
  Segmentation expand(const Surface& surface, const Segmentation& of_models,
                      std::vector<Index>& model_of_chart) const
  {
    model_of_chart.resize(of_models.number_of_charts);
    std::iota(model_of_chart.begin(), model_of_chart.end(), Index(0));
    if (is_empty())
      return of_models;
    Segmentation result{std::vector<Index>(surface.number_of_triangles(), no_index),
                        std::vector<std::uint8_t>(3 * surface.number_of_triangles(), 0),
                        of_models.number_of_charts};
    for (Index t = 0; t < origin_.size(); ++t) {
      result.chart[origin_[t]] = of_models.chart[t];
      for (Index i = 0; i < 3; ++i)
        result.cut[3 * origin_[t] + i] = of_models.cut[3 * t + i];
    }
    for (const Copy& copy : copies_) {
      std::map<Index, Index> number;
      for (const auto& [h, m] : copy.sides) {
        const auto [it, is_new] = number.try_emplace(result.chart[m / 3], result.number_of_charts);
        if (is_new) {
          ++result.number_of_charts;
          model_of_chart.push_back(it->first);
        }
        result.chart[h / 3] = it->second;
        result.cut[h] = result.cut[copy.is_mirrored ? previous_side(surface, m) : m];
      }
    }
    name_inner_triangles(surface, result);
    return result;
  }

  /// The charts of the whole surface, those of copies with the coordinates of their models.
  std::vector<Chart> expand(const Surface& surface, const Segmentation& segmentation,
                            const std::vector<Flattened_chart>& of_models) const
  {
    std::vector<Chart> charts;
    std::vector<Point_2> uv(surface.number_of_corners);
    for (const Flattened_chart& f : of_models) {
      charts.push_back(f.chart);
      if (is_empty())
        continue;
      Chart& chart = charts.back();
      for (Index& t : chart.source)
        t = origin_[t];
      for (std::size_t t = 0; t < chart.source.size(); ++t)
        for (Index i = 0; i < 3; ++i)
          uv[surface.corner[3 * chart.source[t] + i]] = chart.uv[chart.triangles[t][i]];
    }
    if (is_empty())
      return charts;
    for (const Copy& copy : copies_)
      for (const auto& [h, m] : copy.sides) {
        const Point_2& p = uv[surface.corner[m]];
        uv[surface.corner[h]] = Point_2(p.x(), copy.is_mirrored ? -p.y() : p.y());
      }
    std::vector<std::vector<Index>> lists = triangles_of_charts(segmentation);
    std::vector<Index> local(surface.number_of_triangles());
    for (std::size_t c = charts.size(); c < lists.size(); ++c) {
      Chart chart = extract_chart(surface, segmentation, lists[c], local);
      chart.uv.resize(chart.number_of_vertices());
      for (std::size_t t = 0; t < chart.source.size(); ++t)
        for (Index i = 0; i < 3; ++i)
          chart.uv[chart.triangles[t][i]] = uv[surface.corner[3 * chart.source[t] + i]];
      charts.push_back(std::move(chart));
    }
    return charts;
  }

private:
  /// So many models are compared with a part.
  static constexpr std::size_t most_models = 32;

  struct Copy
  {
    Side_pairs sides; ///< of its polygons, with those of the model. \see `Part_matcher::match()`
    bool is_mirrored = false;
  };

  static std::vector<Surface_part> parts_of(const Surface& surface)
  {
    const Components components = connected_components(surface.opposite);
    std::vector<std::vector<Index>> lists(components.count);
    for (Index t = 0; t < components.of_triangle.size(); ++t)
      lists[components.of_triangle[t]].push_back(t);
    std::vector<Surface_part> parts;
    for (std::vector<Index>& list : lists)
      parts.push_back(surface_part(surface, std::move(list)));
    return parts;
  }

  /// Fills `copies_`, and takes the triangles from those parts.
  void find_copies(const Surface& surface, std::vector<Surface_part>& parts, bool is_mirroring_allowed)
  {
    std::vector<Index> order(parts.size()), models;
    for (Index i = 0; i < order.size(); ++i)
      order[i] = i;
    const auto rank = [&](Index i) {
      return std::tuple(parts[i].sides.size(), parts[i].triangles.size(), parts[i].spread, i);
    };
    std::sort(order.begin(), order.end(), [&](Index i, Index j) { return rank(i) < rank(j); });
    Part_matcher matcher(surface);
    for (const Index i : order) {
      bool is_copy = false;
      for (std::size_t k = 0; k < most_models && k < models.size() && !is_copy; ++k) {
        const Surface_part& model = parts[models[models.size() - 1 - k]];
        for (const bool is_mirrored : {false, true})
          if (!is_copy && (!is_mirrored || is_mirroring_allowed))
            if (std::optional<Side_pairs> sides = matcher.match(parts[i], model, is_mirrored)) {
              copies_.push_back({std::move(*sides), is_mirrored});
              is_copy = true;
            }
      }
      if (is_copy)
        parts[i].triangles.clear();
      else
        models.push_back(i);
    }
  }

  /// The rest of the surface.
  void keep(const Surface& surface, std::vector<Index> triangles)
  {
    std::vector<Index> number(surface.number_of_triangles(), no_index);
    for (Index t = 0; t < triangles.size(); ++t)
      number[triangles[t]] = t;
    models_.points = surface.points;
    models_.number_of_faces = surface.number_of_faces;
    models_.number_of_corners = surface.number_of_corners;
    const auto copy = [](auto& to, const auto& from, std::size_t i) {
      if (!from.empty())
        to.push_back(from[i]);
    };
    for (const Index t : triangles) {
      models_.triangles.push_back(surface.triangles[t]);
      models_.face.push_back(surface.face[t]);
      copy(models_.patch, surface.patch, t);
      copy(models_.density_weight, surface.density_weight, t);
      for (Index h = 3 * t; h < 3 * t + 3; ++h) {
        const Index o = surface.opposite[h];
        models_.opposite.push_back(o == no_index ? no_index : 3 * number[o / 3] + o % 3);
        models_.corner.push_back(surface.corner[h]);
        copy(models_.constraint, surface.constraint, h);
        copy(models_.seam_cost, surface.seam_cost, h);
      }
    }
    origin_ = std::move(triangles);
  }

  static Index previous_side(const Surface& surface, Index h)
  {
    Index g = previous_halfedge(h);
    while (surface.is_diagonal(g))
      g = previous_halfedge(surface.opposite[g]);
    return g;
  }

  /// Triangles of polygons without a side of the polygon belong to the chart of the others.
  static void name_inner_triangles(const Surface& surface, Segmentation& segmentation)
  {
    std::vector<Index> chart_of_face(surface.number_of_faces, no_index);
    for (Index t = 0; t < surface.face.size(); ++t)
      if (segmentation.chart[t] != no_index)
        chart_of_face[surface.face[t]] = segmentation.chart[t];
    for (Index t = 0; t < surface.face.size(); ++t)
      segmentation.chart[t] = chart_of_face[surface.face[t]];
  }

  std::vector<Copy> copies_;
  Surface models_;
  std::vector<Index> origin_; ///< per triangle of the models: the triangle of the surface
};

} // namespace Atlas::internal

#endif
