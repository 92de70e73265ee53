// SPDX-License-Identifier: MIT
// The concepts ask for what they say and for nothing else: each has an archetype that can do exactly what the
// concept requires, and near misses that must be refused.
#include <Atlas/core/concepts.h>
#include <Atlas/generate_atlas.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/parameterization/LSCM_traits.h>

#include "test_meshes.h"
#include <gtest/gtest.h>
#include <span>
#include <vector>

namespace Atlas::test {
namespace {

/// A policy that can be made and copied, and nothing else.
class Policy
{
public:
  explicit Policy(int) {}
  Policy(const Policy&) = default;
  Policy& operator=(const Policy&) = delete;
};

struct Segmentation_archetype : Policy
{
  using Policy::Policy;
  Segmentation segment(const Surface&, const Execution&) const { return {}; }
};
static_assert(ChartSegmentation<Segmentation_archetype>);

struct Segmentation_that_changes_itself
{
  Segmentation segment(const Surface&, const Execution&) { return {}; }
};
struct Segmentation_that_changes_the_surface
{
  Segmentation segment(Surface&, const Execution&) const { return {}; }
};
struct Segmentation_without_cuts
{
  std::vector<Index> segment(const Surface&, const Execution&) const { return {}; }
};
static_assert(!ChartSegmentation<Segmentation_that_changes_itself>);
static_assert(!ChartSegmentation<Segmentation_that_changes_the_surface>);
static_assert(!ChartSegmentation<Segmentation_without_cuts>);
static_assert(!ChartSegmentation<int>);

struct Parameterizer_archetype : Policy
{
  using Policy::Policy;
  Chart_status parameterize(Chart&, const Execution&) const { return Chart_status::valid; }
};
static_assert(ChartParameterizer<Parameterizer_archetype>);

struct Parameterizer_that_changes_itself
{
  Chart_status parameterize(Chart&, const Execution&) { return Chart_status::valid; }
};
struct Parameterizer_that_answers_yes_or_no
{
  bool parameterize(Chart&, const Execution&) const { return true; }
};
struct Parameterizer_of_copies
{
  Chart_status parameterize(Chart&&, const Execution&) const { return Chart_status::valid; }
};
static_assert(!ChartParameterizer<Parameterizer_that_changes_itself>);
static_assert(!ChartParameterizer<Parameterizer_that_answers_yes_or_no>);
static_assert(!ChartParameterizer<Parameterizer_of_copies>);
static_assert(!ChartParameterizer<Segmentation_archetype>);

struct Optimizer_archetype : Policy
{
  using Policy::Policy;
  Chart_status optimize(Chart&, const Execution&) const { return Chart_status::valid; }
};
static_assert(UVOptimizer<Optimizer_archetype>);

struct Optimizer_that_keeps_quiet
{
  void optimize(Chart&, const Execution&) const {}
};
struct Optimizer_that_cannot_be_stopped
{
  Chart_status optimize(Chart&) const { return Chart_status::valid; }
};
static_assert(!UVOptimizer<Optimizer_that_keeps_quiet>);
static_assert(!UVOptimizer<Optimizer_that_cannot_be_stopped>);
static_assert(!UVOptimizer<Parameterizer_archetype>);

struct Validator_archetype : Policy
{
  using Policy::Policy;
  Chart_verdict validate(const Chart&, const Execution&) const { return {}; }
};
static_assert(ChartValidator<Validator_archetype>);

struct Validator_without_culprits
{
  Chart_status validate(const Chart&, const Execution&) const { return {}; }
};
struct Validator_that_moves_vertices
{
  Chart_verdict validate(Chart&, const Execution&) const { return {}; }
};
static_assert(!ChartValidator<Validator_without_culprits>);
static_assert(!ChartValidator<Validator_that_moves_vertices>);

struct Splitter_archetype : Policy
{
  using Policy::Policy;
  std::vector<Index> split(const Chart&, const Chart_verdict&) const { return {}; }
};
static_assert(ChartSplitter<Splitter_archetype>);

struct Splitter_without_a_verdict
{
  std::vector<Index> split(const Chart&) const { return {}; }
};
struct Splitter_that_answers_yes_or_no
{
  bool split(const Chart&, const Chart_verdict&) const { return {}; }
};
static_assert(!ChartSplitter<Splitter_without_a_verdict>);
static_assert(!ChartSplitter<Splitter_that_answers_yes_or_no>);
static_assert(!ChartSplitter<Validator_archetype>);

// What policies may tell besides is asked of them only where they do.
struct Segmentation_with_a_bound : Segmentation_archetype
{
  Distortion_bound bound() const { return {}; }
};
static_assert(BoundedSegmentation<Segmentation_with_a_bound>);
static_assert(!BoundedSegmentation<Segmentation_archetype>);
static_assert(!RecordingParameterizer<Parameterizer_archetype>);

struct Packer_archetype : Policy
{
  using Policy::Policy;
  Packing pack(std::span<const Chart>, const Page_options&, const Execution&) const { return {}; }
};
static_assert(ChartPacker<Packer_archetype>);

struct Packer_that_moves_vertices
{
  Packing pack(std::span<Chart>, const Page_options&, const Execution&) const { return {}; }
};
struct Packer_of_one_page
{
  std::vector<Placement> pack(std::span<const Chart>, const Page_options&, const Execution&) const
  {
    return {};
  }
};
struct Packer_that_changes_itself
{
  Packing pack(std::span<const Chart>, const Page_options&, const Execution&) { return {}; }
};
static_assert(!ChartPacker<Packer_that_moves_vertices>);
static_assert(!ChartPacker<Packer_of_one_page>);
static_assert(!ChartPacker<Packer_that_changes_itself>);

class Solver_archetype
{
public:
  Solver_archetype() = default;
  Solver_archetype(const Solver_archetype&) = delete;
  Solver_archetype& operator=(const Solver_archetype&) = delete;
  bool factorize(const LSCM_system&, const Execution&) { return false; }
  bool solve(std::span<std::complex<double>>) { return false; }
};
struct Traits_archetype : Policy
{
  using Policy::Policy;
  using Solver = Solver_archetype;
  std::vector<LSCM_pin> pins(const Chart&) const { return {}; }
};
static_assert(LSCMSolver<Solver_archetype>);
static_assert(LSCMTraits<Traits_archetype>);

struct Solver_that_must_be_told : Solver_archetype
{
  explicit Solver_that_must_be_told(int) {}
};
struct Solver_of_real_systems
{
  bool factorize(const LSCM_system&, const Execution&) { return false; }
  bool solve(std::span<double>) { return false; }
};
struct Traits_without_solver : Policy
{
  std::vector<LSCM_pin> pins(const Chart&) const { return {}; }
};
struct Traits_with_pins_without_places : Traits_archetype
{
  std::vector<Index> pins(const Chart&) const { return {}; }
};
static_assert(!LSCMSolver<Solver_that_must_be_told>);
static_assert(!LSCMSolver<Solver_of_real_systems>);
static_assert(!LSCMTraits<Traits_without_solver>);
static_assert(!LSCMTraits<Traits_with_pins_without_places>);

// The whole pipeline compiles with archetypes, so it asks no more of a policy than its concept does (and a
// copy).
[[maybe_unused]] Atlas_report run_with_archetypes(const Surface& surface, std::vector<Point_2>& uv)
{
  return generate_atlas(surface, uv,
                        parameters::segmentation(Segmentation_archetype(0))
                            .parameterizer(Parameterizer_archetype(0))
                            .optimizer(Optimizer_archetype(0))
                            .validator(Validator_archetype(0))
                            .splitter(Splitter_archetype(0))
                            .packer(Packer_archetype(0)));
}
[[maybe_unused]] Chart_status run_with_archetypes(Chart& chart)
{
  return LSCM_parameterizer<Traits_archetype>(Traits_archetype(0)).parameterize(chart, Execution());
}

// That this file compiles is the test; a solver that gives up shows that the archetypes are really called.
TEST(Concepts, ArchetypesAreModelsAndNearMissesAreNot)
{
  Chart chart = chart_of(planar_grid(2, 2));
  EXPECT_EQ(run_with_archetypes(chart), Chart_status::solver_failed);
}

} // namespace
} // namespace Atlas::test
