// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_INTERNAL_FILE_CHARTS_H
#define ATLAS_SOUP_INTERNAL_FILE_CHARTS_H

#include <Atlas/core/Any_policies.h>
#include <Atlas/core/Chart.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/parameterization/Existing_uv_parameterizer.h>
#include <Atlas/segmentation/Patch_segmentation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief The charts that coordinates have, as charts to begin with: they may merge, and are no limits.
///
/// Copies share their data.
class File_charts
{
public:
  /// \param surface    must outlive this object
  /// \param corner_uv  per input corner, not finite where there are none; must outlive this object
  File_charts(const Surface& surface, std::span<const Point_2> corner_uv)
      : surface_(&surface), corner_uv_(corner_uv)
  {
    Surface limited = surface;
    constrain_to_uv(limited, corner_uv);
    Segmentation charts = Patch_segmentation().segment(limited);
    for (Index h = 0; h < charts.cut.size(); ++h)
      charts.cut[h] = limited.constraint[h] == Edge_constraint::seam;
    charts_ = std::make_shared<const Segmentation>(std::move(charts));
  }

  /// A model of `ChartSegmentation`.
  Segmentation segment(const Surface&, const Execution&) const { return *charts_; }

  /// The chart of a triangle.
  Index chart(Index t) const { return charts_->chart[t]; }

  /// Whether all of a chart has been one before, in the plane too.
  bool is_kept(const Chart& chart) const
  {
    std::vector<const Point_2*> place(chart.number_of_vertices(), nullptr);
    for (std::size_t t = 0; t < chart.source.size(); ++t) {
      if (charts_->chart[chart.source[t]] != charts_->chart[chart.source.front()])
        return false;
      for (Index i = 0; i < 3; ++i) {
        const Point_2& p = corner_uv_[surface_->corner[3 * chart.source[t] + i]];
        const Point_2*& there = place[chart.triangles[t][i]];
        if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || (there && *there != p))
          return false;
        there = &p;
      }
    }
    return true;
  }

private:
  const Surface* surface_;
  std::span<const Point_2> corner_uv_;
  std::shared_ptr<const Segmentation> charts_;
};

/// Keeps the shapes of charts that have not merged, and flattens the others.
class Unmerged_uv_parameterizer
{
public:
  Unmerged_uv_parameterizer(File_charts charts, Existing_uv_parameterizer kept, Any_parameterizer merged)
      : charts_(std::move(charts)), kept_(std::move(kept)), merged_(std::move(merged))
  {}

  Chart_status parameterize(Chart& chart, const Execution& execution) const
  {
    Flattening_record ignored;
    return parameterize(chart, execution, ignored);
  }
  Chart_status parameterize(Chart& chart, const Execution& execution, Flattening_record& record) const
  {
    return charts_.is_kept(chart) ? kept_.parameterize(chart, execution)
                                  : merged_.parameterize(chart, execution, record);
  }

private:
  File_charts charts_;
  Existing_uv_parameterizer kept_;
  Any_parameterizer merged_;
};

/// Binds charts that have merged; the others are as they have been.
class Unmerged_uv_validator
{
public:
  Unmerged_uv_validator(File_charts charts, Any_validator kept, Any_validator merged)
      : charts_(std::move(charts)), kept_(std::move(kept)), merged_(std::move(merged))
  {}

  Chart_verdict validate(const Chart& chart, const Execution& execution) const
  {
    return (charts_.is_kept(chart) ? kept_ : merged_).validate(chart, execution);
  }

private:
  File_charts charts_;
  Any_validator kept_, merged_;
};

/// Takes charts apart that should not have merged: about half of the area goes to either side, and each chart
/// of the file stays whole. So there are never more charts than before, but for those of the file that
/// overlap themselves.
class Unmerging_splitter
{
public:
  Unmerging_splitter(File_charts charts, Any_splitter single)
      : charts_(std::move(charts)), single_(std::move(single))
  {}

  std::vector<Index> split(const Chart& chart, const Chart_verdict& verdict) const
  {
    std::map<Index, Member> members;
    for (std::size_t t = 0; t < chart.source.size(); ++t)
      members[charts_.chart(chart.source[t])].add(chart, t);
    if (members.size() < 2 || chart.uv.size() != chart.number_of_vertices())
      return single_.split(chart, verdict);
    std::vector<std::pair<double, Index>> order; // along the longer side of the chart
    double whole = 0, half = 0;
    const CGAL::Bbox_2 box = CGAL::bbox_2(chart.uv.begin(), chart.uv.end());
    const bool is_wide = box.xmax() - box.xmin() >= box.ymax() - box.ymin();
    for (const auto& [number, member] : members) {
      order.emplace_back(member.place(is_wide), number);
      whole += member.area;
    }
    std::sort(order.begin(), order.end());
    std::map<Index, Index> part;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool is_first = i == 0 || (i + 1 < order.size() && half < whole / 2);
      part[order[i].second] = is_first ? 0 : 1;
      half += members[order[i].second].area;
    }
    std::vector<Index> result;
    for (const Index t : chart.source)
      result.push_back(part[charts_.chart(t)]);
    if (result.front() == 1) // parts are numbered in the order of their first triangles
      for (Index& p : result)
        p = 1 - p;
    return result;
  }

private:
  /// A chart of the file in a union.
  struct Member
  {
    double area = 0, x = 0, y = 0;

    void add(const Chart& chart, std::size_t t)
    {
      const auto& [a, b, c] = chart.triangles[t];
      const double size = std::sqrt(CGAL::squared_area(chart.points[a], chart.points[b], chart.points[c]));
      area += size;
      x += size * (chart.uv[a].x() + chart.uv[b].x() + chart.uv[c].x());
      y += size * (chart.uv[a].y() + chart.uv[b].y() + chart.uv[c].y());
    }
    double place(bool is_wide) const { return area > 0 ? (is_wide ? x : y) / area : 0; }
  };

  File_charts charts_;
  Any_splitter single_;
};

} // namespace Atlas::internal

#endif
