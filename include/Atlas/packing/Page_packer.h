// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_PAGE_PACKER_H
#define ATLAS_PACKING_PAGE_PACKER_H

#include <Atlas/core/Any_policies.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Kernel.h>
#include <Atlas/core/Packing.h>
#include <Atlas/core/concepts.h>
#include <Atlas/core/internal/library.h>

#include <array>
#include <complex>
#include <concepts>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace Atlas {

/// \brief What an engine knows of a piece: the segments that bound its image, in a plane of complex numbers
/// whose origin is the piece's centre of gravity.
///
/// A piece is a chart, or a group of charts that moves as one. The unit is one for all pieces: the larger
/// side of the bounding box of the largest measures about 1.
struct Page_piece
{
  std::vector<std::complex<double>> points;   ///< ends of the segments; at least one
  std::vector<std::array<Index, 2>> segments; ///< pairs of points. First those of the border, with the inside
                                              ///< on their left if `orientation` is 1; then folds
  std::size_t number_of_border_segments = 0;  ///< how many of `segments`, from the first on, are border
  int orientation = 0; ///< of the triangles: 1 counterclockwise, -1 clockwise, 0 both or degenerate
  std::vector<std::array<std::complex<double>, 3>> triangles; ///< only of pieces that are folded, whose
                                                              ///< border alone does not tell what is inside
  double area = 0;                                            ///< sum of the areas of the triangles
  double radius = 0;                                          ///< largest distance of a point from the origin
  Chart_rotation rotation = Chart_rotation::any; ///< how it may be turned; `any`, `quarter_turns` or `none`

  /// The lower left and the upper right corner of the bounding box, not turned. O(points).
  std::array<std::complex<double>, 2> box() const;
};

/// \brief A piece that stays where it is. Its outline is in texels about its centre.
struct Page_obstacle
{
  Page_piece outline;          ///< what keeps its place
  std::complex<double> centre; ///< where it is, in texels
};

/// \brief One page to be filled with all of the pieces. Texels count from the lower left corner.
struct Page_task
{
  std::vector<Page_piece> pieces;       ///< at least one
  std::vector<Page_obstacle> obstacles; ///< none, unless the engine heeds them. \see `ObstaclePageEngine`
  /// In texels, at least 1.
  Index width = 0, height = 0; ///< in texels, at least 1
  double gutter = 0;           ///< least distance between two pieces, in texels
  double margin = 0; ///< what a piece is to keep from the border, and half of what two are to keep from each
                     ///< other: half of the gutter, and what rounding to single precision may cost
  double most_scale = std::numeric_limits<double>::infinity(); ///< larger scales are not wanted

  /// No scale above this is wanted or can fit: pieces would fill the page, or the largest would stick out.
  /// Finite and positive.
  double largest_scale() const;
};

/// \brief Where the pieces of a page are: a point z of piece i goes to `positions[i] + scale * turns[i] * z`.
struct Page_layout
{
  double scale = 0;                        ///< texels per unit of the pieces; in (0, `most_scale`]
  double margin = 0;                       ///< what is kept, if not what was asked for; in texels
  std::vector<std::complex<double>> turns; ///< per piece: of absolute value 1, as its rotation rule allows
  std::vector<std::complex<double>> positions; ///< per piece: where its origin is, in texels
};

/// \brief Lays out the pieces of one page.
///
/// `lay_out()` places all pieces at one scale, the largest it finds, and `most_scale` itself where it can:
/// then a page is filled at a given density. `std::nullopt` says that there is
/// no room at any scale. All the rest of packing is the library's: `Page_packer` makes pieces of charts,
/// weights and groups, fills pages, keeps locked charts in their places, and checks what comes back.
template <typename E>
concept PageEngine = requires(const E& e, const Page_task& task, const Execution& execution)
{
  {
    e.lay_out(task, execution)
    } -> std::same_as<std::optional<Page_layout>>;
};

/// \brief A page engine that says, by a static constant `heeds_obstacles` that is true, that it keeps pieces
/// away from obstacles. The library fills pages with obstacles for all other engines.
template <typename E>
concept ObstaclePageEngine = PageEngine<E> && E::heeds_obstacles;

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
  /// Holds an engine of any type.
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
  /// A packer from an engine.
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
#include <Atlas/packing/internal/pages/Page_engine_impl.h>
#include <Atlas/packing/internal/pages/Page_packer_impl.h>
#endif

#endif
