// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_PAGE_PACKER_H
#define ATLAS_PACKING_PAGE_PACKER_H

#include <Atlas/core/Any_policies.h>
#include <Atlas/core/concepts.h>
#include <Atlas/core/library.h>
#include <Atlas/packing/Page_engine.h>

#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace Atlas {

namespace internal {

struct Page_engine_interface
{
  virtual ~Page_engine_interface() = default;
  virtual std::optional<Page_layout> lay_out(const Page_task&, const Execution&) const = 0;
  virtual bool heeds_obstacles() const = 0;
};

} // namespace internal

/// \ingroup any_policies
/// \brief Holds any model of `PageEngine`.
class Any_page_engine : public internal::Any_policy<internal::Page_engine_interface>
{
public:
  template <PageEngine Engine>
  requires internal::is_other<Engine, Any_page_engine> Any_page_engine(Engine engine)
      : Any_policy(std::make_shared<Model<Engine>>(std::move(engine)), typeid(Engine))
  {}

  /// \throws Policy_error unless there is one finite turn and position for each piece, turns are of length 1
  /// and allowed, and the scale is positive and at most the one wanted
  std::optional<Page_layout> lay_out(const Page_task& task, const Execution& execution) const;
  /// Whether the engine is an `ObstaclePageEngine`.
  bool heeds_obstacles() const;

private:
  template <typename Engine>
  struct Model final : internal::Page_engine_interface
  {
    explicit Model(Engine e) : engine(std::move(e)) {}
    std::optional<Page_layout> lay_out(const Page_task& task, const Execution& execution) const override
    {
      return engine.lay_out(task, execution);
    }
    bool heeds_obstacles() const override { return ObstaclePageEngine<Engine>; }
    Engine engine;
  };
};

/// \brief The packer that a page engine makes: pages, gutters, density, weights, groups, locked charts and
/// stacked copies are the library's, the places on one page are the engine's.
///
/// Where an engine does not heed obstacles, a simple search on a raster fills pages with locked charts in its
/// place.
///
/// Models `ChartPacker`.
class Page_packer
{
public:
  explicit Page_packer(Any_page_engine engine) : engine_(std::move(engine)) {}

  /// O(n log n) for n segments besides the work of the engine, which is called once for each page where
  /// `density` is 0, and about three times otherwise.
  ///
  /// \throws Invalid_argument if `page` is no page, or has lists that do not fit the charts. \see `check()`
  /// \throws Policy_error if what the engine returns cannot be, or does not keep the margin it claims.
  /// Margins are tested exactly, on the layouts that are used in the end.
  Packing pack(std::span<const Chart> charts, const Page_options& page, const Execution& execution) const;

private:
  Any_page_engine engine_;
};

static_assert(ChartPacker<Page_packer>);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/packing/internal/pages/Page_packer_impl.h>
#endif

#endif
