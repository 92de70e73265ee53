// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_PINNED_CHARTS_H
#define ATLAS_PIPELINE_INTERNAL_PINNED_CHARTS_H

#include <Atlas/core/Any_policies.h>
#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Packing.h>
#include <Atlas/core/Surface.h>
#include <Atlas/pipeline/Atlas_report.h>
#include <Atlas/pipeline/internal/map_with_pins.h>
#include <Atlas/pipeline/internal/round_coordinates.h>
#include <Atlas/pipeline/internal/separate_cut_sides.h>
#include <Atlas/validation/Exact_validator.h>
#include <Atlas/validation/overlaps.h>

#include <CGAL/Bbox_2.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// What corners are pinned to, and how charts with pins are made.
struct Pins
{
  std::vector<bool> is_pinned;            ///< per input corner; empty: there are none
  bool is_optimized = true;               ///< whether distortion is lowered between pins
  std::optional<Any_validator> validator; ///< the one that was given
};

/// \brief The charts that have pinned corners, and where they lie with them.
///
/// A chart with pins at several places is *stretched* between them, one with a single pinned vertex is moved.
class Pinned_charts
{
public:
  struct Pinned_chart
  {
    Index chart = no_index;
    std::vector<LSCM_pin> pins; ///< one for each pinned vertex, in [0, 1]^2
    std::vector<Index> corners;
    Chart flat;                              ///< without pins, in units of the model
    std::vector<Point_2> on_page;            ///< per vertex, as stored; empty: it has no place
    std::optional<Pin_fault> own_fault = {}; ///< for good
    std::optional<Pin_fault> fault = {};     ///< of the last layout

    bool is_stretched() const { return pins.size() > 1; }
    bool is_kept() const { return !fault; }
  };

  /// \param charts  of the part, with coordinates in units of the model. All must outlive this object
  Pinned_charts(const Surface& part, const Segmentation& segmentation, std::span<const Chart> charts,
                const Pins& pins, const std::vector<Point_2>& corner_uv, const Page_options& page,
                const Execution& execution)
      : part_(part), segmentation_(segmentation), pins_(pins), width_(page.width), height_(page.height),
        turns_(page.rotation == Chart_rotation::none ? 1 : 4), execution_(execution)
  {
    if (pins.is_pinned.empty())
      return;
    for (Index c = 0; c < charts.size(); ++c)
      collect(c, charts[c], corner_uv);
    execution_.for_each(list_.size(), [&](std::size_t i) {
      if (list_[i].is_stretched() && !list_[i].own_fault)
        list_[i].own_fault = stretch(list_[i]);
    });
  }

  const std::vector<Pinned_chart>& list() const { return list_; }
  bool is_empty() const { return list_.empty(); }

  /// Whether any chart that is one of `stretched` is laid out by its pins.
  bool keeps_any(bool stretched) const
  {
    return std::any_of(list_.begin(), list_.end(), [&](const Pinned_chart& pinned) {
      return pinned.is_kept() && pinned.is_stretched() == stretched;
    });
  }
  /// Whether any chart may be moved to its pin.
  bool has_moved() const
  {
    return std::any_of(list_.begin(), list_.end(), [](const Pinned_chart& pinned) {
      return !pinned.own_fault && !pinned.is_stretched();
    });
  }
  bool keeps_any() const { return keeps_any(false) || keeps_any(true); }

  /// Lays out all charts that can be.
  /// \param density  texels per unit of charts that are moved; 0: these are left out
  /// \param others   the triangles of charts that stay, on the page
  void lay(double density, const std::vector<Triangle_uv>& others)
  {
    std::vector<CGAL::Bbox_2> placed;
    for (Pinned_chart& pinned : list_) {
      pinned.fault = pinned.own_fault;
      if (!pinned.fault && !pinned.is_stretched())
        pinned.fault = density > 0 ? move(pinned, density, placed) : Pin_fault::no_room;
      if (!pinned.fault)
        placed.push_back(CGAL::bbox_2(pinned.on_page.begin(), pinned.on_page.end()));
    }
    drop_overlapping(others);
  }

  /// The chart on the page in texels, for packers.
  std::vector<Point_2> texels(const Pinned_chart& pinned) const
  {
    std::vector<Point_2> result;
    for (const Point_2& p : pinned.on_page)
      result.emplace_back(p.x() * width_, p.y() * height_);
    return result;
  }

  /// Lets go of the pins of charts that are laid out by them and are one of `charts`, for good.
  /// \return whether there are any
  template <typename Is_one>
  bool give_up(Pin_fault fault, Is_one is_one)
  {
    bool is_any = false;
    for (Pinned_chart& pinned : list_)
      if (pinned.is_kept() && is_one(pinned.chart)) {
        pinned.own_fault = pinned.fault = fault;
        is_any = true;
      }
    return is_any;
  }

  /// The charts whose pins could not stay.
  std::vector<Moved_pins> moved() const
  {
    std::vector<Moved_pins> result;
    for (const Pinned_chart& pinned : list_)
      if (pinned.fault)
        result.push_back({pinned.chart, *pinned.fault, pinned.corners});
    return result;
  }

private:
  void collect(Index c, const Chart& chart, const std::vector<Point_2>& corner_uv)
  {
    Pinned_chart pinned{.chart = c, .pins = {}, .corners = {}, .flat = {}, .on_page = {}};
    std::vector<std::optional<Point_2>> place(chart.number_of_vertices());
    for (Index t = 0; t < chart.number_of_triangles(); ++t)
      for (Index i = 0; i < 3; ++i) {
        const Index corner = part_.corner[3 * chart.source[t] + i];
        if (!pins_.is_pinned[corner])
          continue;
        pinned.corners.push_back(corner);
        std::optional<Point_2>& there = place[chart.triangles[t][i]];
        if (there && *there != corner_uv[corner])
          pinned.own_fault = Pin_fault::no_seam_between;
        there = corner_uv[corner];
      }
    if (pinned.corners.empty())
      return;
    std::sort(pinned.corners.begin(), pinned.corners.end());
    pinned.corners.erase(std::unique(pinned.corners.begin(), pinned.corners.end()), pinned.corners.end());
    for (Index v = 0; v < place.size(); ++v)
      if (place[v])
        pinned.pins.push_back({v, *place[v]});
    pinned.flat = chart;
    list_.push_back(std::move(pinned));
  }

  /// Maps a chart between its pins. Lengths are those of texels: pages need not be square.
  std::optional<Pin_fault> stretch(Pinned_chart& pinned) const
  {
    Chart chart = pinned.flat;
    std::vector<LSCM_pin> pins = pinned.pins;
    if (std::all_of(pins.begin(), pins.end(), [&](const LSCM_pin& p) { return p.uv == pins[0].uv; }))
      return Pin_fault::not_one_to_one;
    for (LSCM_pin& pin : pins)
      pin.uv = Point_2(pin.uv.x() * width_, pin.uv.y() * height_);
    if (map_with_pins(chart, pins, pins_.is_optimized, execution_) != Chart_status::valid)
      return Pin_fault::not_solved;
    return finish(pinned, std::move(chart));
  }

  /// Moves a chart to its pin, in the first quarter turn in which it lies on the page, beside the boxes of
  /// the charts before it if it can.
  std::optional<Pin_fault> move(Pinned_chart& pinned, double density,
                                const std::vector<CGAL::Bbox_2>& before) const
  {
    std::optional<Pin_fault> fault;
    std::vector<Point_2> kept;
    for (int turn = 0; turn < turns_; ++turn) {
      const std::optional<Pin_fault> now = finish(pinned, moved(pinned, density, turn));
      fault = turn == 0 ? now : fault;
      if (now)
        continue;
      const CGAL::Bbox_2 box = CGAL::bbox_2(pinned.on_page.begin(), pinned.on_page.end());
      if (std::none_of(before.begin(), before.end(),
                       [&](const CGAL::Bbox_2& b) { return CGAL::do_overlap(box, b); }))
        return std::nullopt;
      if (kept.empty())
        kept = pinned.on_page;
    }
    pinned.on_page = std::move(kept);
    return pinned.on_page.empty() ? fault : std::nullopt;
  }

  /// A chart at its pin, in texels.
  Chart moved(const Pinned_chart& pinned, double density, int turn) const
  {
    Chart chart = pinned.flat;
    const LSCM_pin& pin = pinned.pins.front();
    const Point_2 from = chart.uv[pin.vertex];
    for (Point_2& p : chart.uv) {
      Vector_2 off = density * (p - from);
      for (int i = 0; i < turn; ++i)
        off = Vector_2(-off.y(), off.x());
      p = Point_2(pin.uv.x() * width_ + off.x(), pin.uv.y() * height_ + off.y());
    }
    return chart;
  }

  /// Whether rounding to the grid gives a point of the page.
  static bool is_on_page(const Point_2& p)
  {
    const auto is_in = [](double x) {
      return std::round(x * grid_cells) >= 0 && std::round(x * grid_cells) <= grid_cells;
    };
    return is_in(p.x()) && is_in(p.y());
  }

  /// Stores the coordinates of a chart in texels as those of the page, pins to the bit, and examines them.
  std::optional<Pin_fault> finish(Pinned_chart& pinned, Chart chart) const
  {
    pinned.on_page.clear();
    if (pins_.validator && !pins_.validator->validate(chart, execution_).is_valid())
      return Pin_fault::refused;
    for (Point_2& p : chart.uv)
      p = Point_2(p.x() / width_, p.y() / height_);
    std::vector<bool> is_fixed(chart.number_of_vertices(), false);
    const auto put_pins = [&] {
      for (const LSCM_pin& pin : pinned.pins)
        chart.uv[pin.vertex] = pin.uv;
    };
    for (const LSCM_pin& pin : pinned.pins)
      is_fixed[pin.vertex] = true;
    put_pins();
    if (!std::all_of(chart.uv.begin(), chart.uv.end(), is_on_page))
      return Pin_fault::outside_page;
    (void)Grid_rounding(chart, is_fixed)(); // the validator tells of what it cannot mend
    Cut_side_separator(part_, segmentation_, chart)();
    put_pins();
    const Exact_validator exact(std::numeric_limits<double>::infinity(), 0);
    if (!exact.validate(chart, execution_).is_valid())
      return Pin_fault::not_one_to_one;
    pinned.on_page = std::move(chart.uv);
    return std::nullopt;
  }

  /// Of charts that lie on each other those with lower numbers stay.
  void drop_overlapping(const std::vector<Triangle_uv>& others)
  {
    bool is_complete = false;
    while (!is_complete && keeps_any() && execution_.proceed()) {
      std::vector<Triangle_uv> triangles = others;
      std::vector<std::size_t> owner(others.size(), list_.size());
      for (std::size_t i = 0; i < list_.size(); ++i)
        if (list_[i].is_kept())
          for (const auto& [a, b, c] : list_[i].flat.triangles) {
            const std::vector<Point_2>& uv = list_[i].on_page;
            triangles.push_back({uv[a], uv[b], uv[c]});
            owner.push_back(i);
          }
      const Overlaps found = find_overlaps(triangles, execution_);
      std::set<std::pair<std::size_t, std::size_t>> pairs; // the one to drop, and the one that it lies on
      for (const auto& [s, t] : found.pairs) {
        const std::size_t a = owner[s], b = owner[t];
        if (a != b)
          pairs.emplace(a == list_.size() || b == list_.size() ? std::min(a, b) : std::max(a, b),
                        a == list_.size() || b == list_.size() ? list_.size() : std::min(a, b));
      }
      for (const auto& [upper, lower] : pairs)
        if (lower == list_.size() || list_[lower].is_kept())
          list_[upper].fault = Pin_fault::covers_chart;
      is_complete = found.is_complete || pairs.empty();
    }
  }

  const Surface& part_;
  const Segmentation& segmentation_;
  const Pins& pins_;
  double width_, height_;
  int turns_; ///< in which charts may be moved to their pins
  const Execution& execution_;
  std::vector<Pinned_chart> list_; ///< in the order of charts
};

} // namespace Atlas::internal

#endif
