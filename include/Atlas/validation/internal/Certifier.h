// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_INTERNAL_CERTIFIER_H
#define ATLAS_VALIDATION_INTERNAL_CERTIFIER_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/area_in_space.h>
#include <Atlas/planar/internal/coverage_sweep.h>
#include <Atlas/validation/certify.h>
#include <Atlas/validation/internal/Uv_charts.h>
#include <Atlas/validation/internal/chart_clearance.h>
#include <Atlas/validation/overlaps.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// One examination of texture coordinates; see `certify()`.
class Certifier
{
public:
  Certifier(const Surface& surface, std::span<const Point_2> corner_uv, std::span<const Index> face_page,
            const Certificate_options& options, const Execution& execution)
      : surface_(surface), options_(options), execution_(execution), uv_(3 * surface.number_of_triangles()),
        triangles_(surface.number_of_triangles())
  {
    in_blocks([&](Index t) { examine_triangle(t, corner_uv); });
    number_pages(face_page);
  }

  Atlas_certificate run()
  {
    describe_input();
    const Uv_charts charts(surface_, uv_, page_);
    if (execution_.proceed(0.3)) {
      count_triangles(charts);
      describe_charts(charts);
    }
    if (execution_.proceed(0.5))
      find_overlaps(charts);
    if (execution_.proceed(0.9))
      measure_distances(charts);
    finish_lists();
    return std::move(certificate_);
  }

private:
  struct Triangle
  {
    std::int8_t sign = 0; ///< of the orientation in the plane
    bool is_finite = false;
    bool has_area = false;    ///< in space
    std::uint8_t outside = 0; ///< bit i: corner i is not on the page
    double area_uv = 0, area = 0;
  };

  template <typename Body>
  void in_blocks(Body body) const
  {
    constexpr std::size_t block_size = 4096;
    const std::size_t n = surface_.number_of_triangles();
    execution_.for_each((n + block_size - 1) / block_size, [&](std::size_t block) {
      for (std::size_t t = block * block_size; t < std::min(n, (block + 1) * block_size); ++t)
        body(static_cast<Index>(t));
    });
  }

  /// The nearest number of 32 bits. GCC 12 at -O2 forgets to round when it converts two neighbours at once to
  /// float and back; it has to keep its hands off a volatile.
  static double to_single(double x)
  {
    const volatile float rounded = static_cast<float>(x);
    return rounded;
  }

  Point_2 rounded(const Point_2& p) const
  {
    return options_.precision == Uv_precision::double_precision ? p
                                                                : Point_2(to_single(p.x()), to_single(p.y()));
  }

  void examine_triangle(Index t, std::span<const Point_2> corner_uv)
  {
    Triangle& triangle = triangles_[t];
    triangle.is_finite = true;
    for (Index i = 0; i < 3; ++i) {
      const Point_2 p = uv_[3 * t + i] = rounded(corner_uv[surface_.corner[3 * t + i]]);
      triangle.is_finite = triangle.is_finite && std::isfinite(p.x()) && std::isfinite(p.y());
      const bool is_inside = 0 <= p.x() && p.x() <= 1 && 0 <= p.y() && p.y() <= 1;
      triangle.outside = static_cast<std::uint8_t>(triangle.outside | !is_inside << i);
    }
    const Point_3 &a = surface_.point(3 * t), &b = surface_.point(3 * t + 1), &c = surface_.point(3 * t + 2);
    triangle.has_area = has_area(a, b, c);
    triangle.area = triangle.has_area ? std::sqrt(CGAL::squared_area(a, b, c)) : 0;
    if (!triangle.is_finite)
      return;
    const Point_2 &p = uv_[3 * t], &q = uv_[3 * t + 1], &r = uv_[3 * t + 2];
    triangle.sign = static_cast<std::int8_t>(CGAL::orientation(p, q, r));
    triangle.area_uv = triangle.sign == 0 ? 0 : std::abs(CGAL::area(p, q, r));
  }

  /// Pages get numbers 0, 1, ... in their order; triangles without coordinates are on none.
  void number_pages(std::span<const Index> face_page)
  {
    std::vector<Index> names(face_page.begin(), face_page.end());
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    certificate_.pages = face_page.empty() ? !triangles_.empty() : names.size();
    page_.assign(triangles_.size(), no_index);
    in_blocks([&](Index t) {
      if (triangles_[t].is_finite && face_page.empty())
        page_[t] = 0;
      else if (triangles_[t].is_finite)
        page_[t] = static_cast<Index>(
            std::lower_bound(names.begin(), names.end(), face_page[surface_.face[t]]) - names.begin());
    });
  }

  void describe_input()
  {
    certificate_.faces = surface_.number_of_faces;
    certificate_.triangles = surface_.number_of_triangles();
    certificate_.rejected_faces = surface_.rejected.size();
    certificate_.width = options_.width;
    certificate_.height = options_.height;
    certificate_.gutter = options_.gutter;
    certificate_.gutter_tolerance = options_.gutter_tolerance;
  }

  /// The orientation of the majority of each chart's triangles; among equals, of the larger area.
  std::vector<std::int8_t> majorities(const Uv_charts& charts) const
  {
    std::vector<long long> balance(charts.number_of_charts(), 0);
    std::vector<double> area(charts.number_of_charts(), 0);
    for (Index t = 0; t < triangles_.size(); ++t)
      if (const Index c = charts.chart(t); c != no_index) {
        balance[c] += triangles_[t].sign;
        area[c] += triangles_[t].sign * triangles_[t].area_uv;
      }
    std::vector<std::int8_t> result(balance.size());
    for (std::size_t c = 0; c < result.size(); ++c)
      result[c] = balance[c] < 0 || (balance[c] == 0 && area[c] < 0) ? -1 : 1;
    return result;
  }

  void count_triangles(const Uv_charts& charts)
  {
    const std::vector<std::int8_t> majority = majorities(charts);
    certificate_.mirrored_charts = std::count(majority.begin(), majority.end(), -1);
    std::vector<bool> is_outside(surface_.number_of_corners, false);
    for (Index t = 0; t < triangles_.size(); ++t) {
      const Triangle& triangle = triangles_[t];
      const Index c = charts.chart(t);
      const bool is_flipped = c != no_index && triangle.sign != 0 && triangle.sign != majority[c];
      const bool is_degenerate = triangle.is_finite && triangle.sign == 0 && triangle.has_area;
      certificate_.not_finite += !triangle.is_finite;
      certificate_.flipped += is_flipped;
      certificate_.degenerate += is_degenerate;
      for (Index i = 0; i < 3; ++i)
        if (triangle.is_finite && (triangle.outside >> i & 1) && !is_outside[surface_.corner[3 * t + i]]) {
          is_outside[surface_.corner[3 * t + i]] = true;
          ++certificate_.corners_outside;
        }
      if (!triangle.is_finite || is_flipped || is_degenerate || triangle.outside)
        certificate_.culprits.push_back(surface_.face[t]);
    }
  }

  void describe_charts(const Uv_charts& charts)
  {
    certificate_.charts = charts.number_of_charts();
    certificate_.seam_length = charts.seam_length();
    for (Index c = 0; c < charts.number_of_charts(); ++c)
      certificate_.non_disc_charts += !charts.counts(c).is_disc();
    certificate_.face_chart.assign(surface_.number_of_faces, no_index);
    for (Index t = 0; t < triangles_.size(); ++t)
      certificate_.face_chart[surface_.face[t]] = charts.chart(t);
    const double texels = double(options_.width) * options_.height;
    for (const Triangle& triangle : triangles_)
      if (triangle.has_area && triangle.area_uv > 0) {
        const double density = std::sqrt(triangle.area_uv * texels / triangle.area);
        certificate_.density_min = std::min(certificate_.density_min, density);
        certificate_.density_max = std::max(certificate_.density_max, density);
      }
  }

  /// Decides each page by a sweep over its border edges; pairs are searched only where there are some. On a
  /// page of many small charts the search costs less than the sweep and goes first: what it finds needs no
  /// other proof.
  void find_overlaps(const Uv_charts& charts)
  {
    std::vector<std::size_t> triangles(certificate_.pages, 0);
    for (const Index p : page_)
      if (p != no_index)
        ++triangles[p];
    std::vector<Coverage_sweep> sweeps = borders(charts);
    std::vector<std::uint8_t> is_sweep_cheap(certificate_.pages), is_free(certificate_.pages);
    execution_.for_each(sweeps.size(), [&](std::size_t p) {
      is_sweep_cheap[p] = 2 * sweeps[p].size() < 3 * triangles[p]; // a large polygon has as many of both
      is_free[p] = is_sweep_cheap[p] && sweeps[p].is_covered_at_most_once();
    });
    for (Index p = 0; p < certificate_.pages; ++p) {
      if (is_free[p])
        continue;
      const Overlaps found = list_overlaps(charts, p);
      const bool is_undecided = !is_sweep_cheap[p] && found.pairs.empty() && !found.is_complete;
      is_free[p] =
          is_undecided ? sweeps[p].is_covered_at_most_once() : found.pairs.empty() && found.is_complete;
      if (!is_free[p]) {
        certificate_.is_overlap_free = false;
        certificate_.are_overlaps_complete = certificate_.are_overlaps_complete && found.is_complete;
      }
    }
  }

  /// Per page the edges that do not run inside a chart, from one triangle to another of the same orientation.
  std::vector<Coverage_sweep> borders(const Uv_charts& charts) const
  {
    std::vector<Coverage_sweep> sweeps(certificate_.pages);
    for (Index h = 0; h < uv_.size(); ++h) {
      const std::int8_t sign = triangles_[h / 3].sign;
      const Index o = charts.glued(h), n = next_halfedge(h);
      const bool is_inside = o != no_index && triangles_[o / 3].sign == sign &&
                             uv_[h] == uv_[next_halfedge(o)] && uv_[n] == uv_[o];
      if (sign != 0 && !is_inside)
        sweeps[page_[h / 3]].add(uv_[sign > 0 ? h : n], uv_[sign > 0 ? n : h]);
    }
    return sweeps;
  }

  /// Counts the pairs on a page.
  Overlaps list_overlaps(const Uv_charts& charts, Index p)
  {
    std::vector<Triangle_uv> on_page;
    std::vector<Index> name;
    for (Index t = 0; t < triangles_.size(); ++t)
      if (page_[t] == p) {
        on_page.push_back({uv_[3 * t], uv_[3 * t + 1], uv_[3 * t + 2]});
        name.push_back(t);
      }
    const std::size_t counted = certificate_.overlaps_in_charts + certificate_.overlaps_between_charts;
    Overlaps found = Atlas::find_overlaps(on_page, execution_, options_.max_overlaps - counted);
    for (const auto& [i, j] : found.pairs) {
      const Index s = name[i], t = name[j];
      const bool is_same = charts.chart(s) == charts.chart(t) && charts.chart(s) != no_index;
      ++(is_same ? certificate_.overlaps_in_charts : certificate_.overlaps_between_charts);
      certificate_.culprits.push_back(surface_.face[s]);
      certificate_.culprits.push_back(surface_.face[t]);
    }
    return found;
  }

  /// Distances between borders of charts that have area, and from everything to the border of the page, in
  /// texels.
  void measure_distances(const Uv_charts& charts)
  {
    Box_2 box;
    std::vector<double> area(charts.number_of_charts(), 0), area_uv(charts.number_of_charts(), 0);
    for (Index t = 0; t < triangles_.size(); ++t) {
      if (!triangles_[t].is_finite)
        continue;
      for (Index h = 3 * t; h < 3 * t + 3; ++h)
        box.add(uv_[h].x(), uv_[h].y());
      if (const Index c = charts.chart(t); c != no_index) {
        area[c] += triangles_[t].area;
        area_uv[c] += triangles_[t].area_uv;
      }
    }
    certificate_.page_border_distance = std::min({box.x0 * options_.width, (1 - box.x1) * options_.width,
                                                  box.y0 * options_.height, (1 - box.y1) * options_.height});
    find_crowded_at_border();
    if (certificate_.overlaps_between_charts > 0) {
      certificate_.chart_distance = 0;
      return;
    }
    std::vector<std::vector<Border_segment>> segments(certificate_.pages);
    const auto texel = [&](const Point_2& p) {
      return Point_2(p.x() * options_.width, p.y() * options_.height);
    };
    for (Index h = 0; h < uv_.size(); ++h)
      if (const Index c = charts.chart(h / 3);
          c != no_index && charts.is_border(h) && area[c] > 0 && area_uv[c] > 0)
        segments[page_[h / 3]].push_back({texel(uv_[h]), texel(uv_[next_halfedge(h)]), c, h / 3});
    Chart_distance best;
    for (const auto& on_page : segments) {
      const Border_search search(on_page, execution_);
      const Chart_distance nearest = search.nearest(execution_);
      best = std::min(best, nearest);
      if (const double least = least_distance(); nearest.squared < least * least && least > 0)
        for (const Index t : search.crowded(least * least, execution_))
          certificate_.crowded_faces.push_back(surface_.face[t]);
    }
    if (best.first != no_index) {
      certificate_.chart_distance = std::sqrt(best.squared);
      certificate_.closest_faces = {surface_.face[best.first], surface_.face[best.second]};
    }
  }

  /// Between charts, in texels, with the tolerance.
  double least_distance() const { return options_.gutter - options_.gutter_tolerance; }

  void find_crowded_at_border()
  {
    const double least = options_.gutter / 2 - options_.gutter_tolerance;
    if (!(certificate_.page_border_distance < least))
      return;
    const auto is_near = [&](const Point_2& p) {
      return std::min(p.x(), 1 - p.x()) * options_.width < least ||
             std::min(p.y(), 1 - p.y()) * options_.height < least;
    };
    for (Index t = 0; t < triangles_.size(); ++t)
      if (triangles_[t].is_finite &&
          (is_near(uv_[3 * t]) || is_near(uv_[3 * t + 1]) || is_near(uv_[3 * t + 2])))
        certificate_.crowded_faces.push_back(surface_.face[t]);
  }

  void finish_lists()
  {
    const bool is_complete = finish(certificate_.culprits);
    certificate_.are_culprits_complete = certificate_.are_overlaps_complete && is_complete;
    (void)finish(certificate_.crowded_faces);
  }

  /// Sorts the list and caps it. Returns whether nothing was cut off.
  bool finish(std::vector<Index>& list) const
  {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    const bool is_complete = list.size() <= options_.max_culprits;
    list.resize(std::min(list.size(), options_.max_culprits));
    return is_complete;
  }

  const Surface& surface_;
  const Certificate_options& options_;
  const Execution& execution_;
  std::vector<Point_2> uv_; ///< per corner of the surface, rounded
  std::vector<Triangle> triangles_;
  std::vector<Index> page_; ///< per triangle
  Atlas_certificate certificate_;
};

} // namespace Atlas::internal

#endif
