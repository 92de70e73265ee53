// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_CONCEPTS_H
#define ATLAS_CORE_CONCEPTS_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Packing.h>
#include <Atlas/core/Surface.h>

#include <concepts>
#include <span>
#include <vector>

namespace Atlas {

/// \brief Decides which triangles belong together and where charts are cut open.
///
/// `segment()` assigns every triangle of the surface to a chart. The charts need not be discs, connected, or
/// respect input polygons, constraints and patches: `cut_to_discs()` sees to that afterwards, for every
/// model.
template <typename S>
concept ChartSegmentation = requires(const S& s, const Surface& surface, const Execution& execution)
{
  {
    s.segment(surface, execution)
    } -> std::same_as<Segmentation>;
};

/// \brief A segmentation that keeps a bound on the distortion of its charts: the report says which charts
/// keep it in the end, and pieces of charts are joined within it.
template <typename S>
concept BoundedSegmentation = ChartSegmentation<S> && requires(const S& s)
{
  {
    s.bound()
    } -> std::same_as<Distortion_bound>;
};

/// \brief Flattens one chart that is a disc: fills `chart.uv`, one finite point for each vertex, or tells why
/// not.
template <typename P>
concept ChartParameterizer = requires(const P& p, Chart& chart, const Execution& execution)
{
  {
    p.parameterize(chart, execution)
    } -> std::same_as<Chart_status>;
};

/// \brief A parameterizer that also tells what it did; the report carries the records.
template <typename P>
concept RecordingParameterizer = ChartParameterizer<P> &&
    requires(const P& p, Chart& chart, const Execution& execution, Flattening_record& record)
{
  {
    p.parameterize(chart, execution, record)
    } -> std::same_as<Chart_status>;
};

/// \brief Lowers the distortion of a flattened chart. A chart that was one-to-one stays so.
template <typename O>
concept UVOptimizer = requires(const O& o, Chart& chart, const Execution& execution)
{
  {
    o.optimize(chart, execution)
    } -> std::same_as<Chart_status>;
};

/// \brief Whether a chart is acceptable, and what is to blame if it is not.
struct Chart_verdict
{
  Chart_status status = Chart_status::valid; ///< `valid`, or what is wrong
  std::vector<Index> culprits; ///< triangles of the chart to blame, sorted; empty for a valid chart

  /// Whether the chart is accepted.
  bool is_valid() const { return status == Chart_status::valid; }
};

/// \brief Decides whether a flattened chart is acceptable.
///
/// A chart of one triangle that is flattened without a flip has to be acceptable, so that splitting ends.
template <typename V>
concept ChartValidator = requires(const V& v, const Chart& chart, const Execution& execution)
{
  {
    v.validate(chart, execution)
    } -> std::same_as<Chart_verdict>;
};

/// \brief Splits a chart that a validator refused.
///
/// `split()` gets the chart and the verdict on it. It gives each triangle a part number 0, 1, ... The parts
/// need be neither connected nor discs. Where it makes no two parts, the chart is halved.
template <typename S>
concept ChartSplitter = requires(const S& s, const Chart& chart, const Chart_verdict& verdict)
{
  {
    s.split(chart, verdict)
    } -> std::same_as<std::vector<Index>>;
};

/// \brief Places flattened charts on pages without overlap, keeping the gutter, with one density for all.
///
/// The charts' `uv` are in the unit of the model: the packer turns, moves and scales all of them alike.
template <typename K>
concept ChartPacker = requires(const K& k, std::span<const Chart> charts, const Page_options& page,
                               const Execution& execution)
{
  {
    k.pack(charts, page, execution)
    } -> std::same_as<Packing>;
};

} // namespace Atlas

#endif
