// SPDX-License-Identifier: MIT
// Arguments of the segmentation that cannot be are told by name, in every build.
#include <Atlas/core/errors.h>
#include <Atlas/parameterization/Distortion_optimizer.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/segmentation/Feature_segmentation.h>
#include <Atlas/segmentation/Merged_segmentation.h>
#include <Atlas/segmentation/Normal_segmentation.h>
#include <Atlas/segmentation/Patch_segmentation.h>
#include <Atlas/segmentation/Region_growing_segmentation.h>
#include <Atlas/segmentation/Variational_segmentation.h>
#include <Atlas/segmentation/cut_to_discs.h>
#include <Atlas/segmentation/merge_charts.h>
#include <Atlas/segmentation/smooth_borders.h>

#include "segmentation_checks.h"
#include "test_meshes.h"
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

namespace Atlas::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Expects the call to throw `Invalid_argument` for the argument of that name.
template <typename Call>
void expect_fault(const std::string& argument, Call call)
{
  try {
    call();
    ADD_FAILURE() << "nothing is said of " << argument;
  } catch (const Invalid_argument& fault) {
    EXPECT_EQ(fault.argument(), argument);
    EXPECT_EQ(std::string(fault.what()).rfind(argument, 0), 0u) << fault.what();
  }
}

/// Expects the value to be refused as that member, wherever options enter with it.
template <typename Options, typename Value, typename Use>
void expect_faults(const std::string& argument, Value Options::*member, const std::vector<Value>& values,
                   Use use)
{
  for (const Value value : values) {
    Options options;
    options.*member = value;
    expect_fault(argument, [&] { use(options); });
  }
}

Surface sheet()
{
  return surface_of(planar_grid(4, 4));
}

Segmentation halves(const Surface& surface)
{
  Segmentation segmentation = one_chart(surface);
  for (Index t = 0; t < segmentation.chart.size(); ++t)
    segmentation.chart[t] = 2 * t >= segmentation.chart.size();
  segmentation.number_of_charts = 2;
  return segmentation;
}

TEST(Segmentation_arguments, Merge_options)
{
  const Surface surface = sheet();
  const auto merge = [&](const Merge_options& options) {
    Segmentation segmentation = halves(surface);
    merge_charts(surface, segmentation, options, LSCM_parameterizer<>(), Identity_optimizer());
  };
  const auto construct = [](const Merge_options& options) {
    Merged_segmentation(Patch_segmentation(), LSCM_parameterizer<>(), Identity_optimizer(), options);
  };
  const auto both = [&](const std::string& argument, auto member, const auto& values) {
    expect_faults(argument, member, values, merge);
    expect_faults(argument, member, values, construct);
  };
  using O = Merge_options;
  const std::vector<double> no_shares{-0.1, 1.1, nan, infinity};
  both("max_distortion", &O::max_distortion, std::vector<double>{0.99, -1, nan, -infinity});
  both("share_for_trials", &O::share_for_trials, std::vector<double>{0, -0.1, 1.1, nan});
  both("max_area_share", &O::max_area_share, std::vector<double>{0, -0.1, 1.1, nan});
  both("solidity_of_large_charts", &O::solidity_of_large_charts, no_shares);
  both("min_solidity", &O::min_solidity, no_shares);
  both("min_gap", &O::min_gap, no_shares);
  both("max_misfit", &O::max_misfit, std::vector<double>{-0.1, nan});
  both("triangles_per_chart", &O::triangles_per_chart, std::vector<double>{0, -1, nan});
  both("batch", &O::batch, std::vector<std::size_t>{0});
  both("orders", &O::orders, std::vector<std::size_t>{0, 7});
  both("min_chart_area", &O::min_chart_area, std::vector<double>{-0.1, nan});
  Merge_options widest;
  widest.max_distortion = widest.max_misfit = infinity;
  EXPECT_NO_THROW(merge(widest));
  EXPECT_NO_THROW(merge(few_seams_options()));
  EXPECT_NO_THROW(merge(conformal_options()));
}

TEST(Segmentation_arguments, Smoothing_options)
{
  const Surface surface = sheet();
  const auto smooth = [&](const Smoothing_options& options) {
    Segmentation segmentation = halves(surface);
    smooth_borders(surface, segmentation, options);
  };
  using O = Smoothing_options;
  expect_faults("rings", &O::rings, {-1}, smooth);
  expect_faults("rounds", &O::rounds, {-1}, smooth);
  expect_faults("sharp_angle", &O::sharp_angle, {0., -1., nan}, smooth);
  expect_faults("sharp_discount", &O::sharp_discount, {-0.1, 1.1, nan}, smooth);
  EXPECT_NO_THROW(smooth({0, 0, infinity, 1}));
}

TEST(Segmentation_arguments, Feature_options)
{
  const Surface surface = sheet();
  const auto detect = [&](const Feature_options& options) { (void)detect_features(surface, options); };
  const auto segment = [&](const Feature_options& options) {
    Feature_segmentation model;
    model.features = options;
    (void)model.segment(surface);
  };
  const auto both = [&](const std::string& argument, auto member, const auto& values) {
    expect_faults(argument, member, values, detect);
    expect_faults(argument, member, values, segment);
  };
  using O = Feature_options;
  both("sharp_edge_share", &O::sharp_edge_share, std::vector<double>{-0.1, 1.1, nan});
  both("max_string_length", &O::max_string_length, std::vector<int>{0, -5});
  both("min_feature_length", &O::min_feature_length, std::vector<int>{-1});
  both("min_feature_length_of_small_meshes", &O::min_feature_length_of_small_meshes,
       std::vector<double>{-1, nan});
  both("neighborhood_rings", &O::neighborhood_rings, std::vector<int>{-1});
  both("min_contrast", &O::min_contrast, std::vector<double>{-1, nan});
  both("plateau_tolerance", &O::plateau_tolerance, std::vector<double>{-0.1, 1.1, nan});
  both("hard_angle", &O::hard_angle, std::vector<double>{-1, nan});
  both("normal_filter_rounds", &O::normal_filter_rounds, std::vector<int>{-1});
}

TEST(Segmentation_arguments, Feature_segmentation_and_growth)
{
  const Surface surface = sheet();
  const auto segment = [&](const Feature_segmentation& model) { (void)model.segment(surface); };
  using F = Feature_segmentation;
  expect_faults("sock_ratio", &F::sock_ratio, {0., -1., nan}, segment);
  expect_faults("min_chart_area", &F::min_chart_area, {-0.1, 1.1, nan}, segment);
  const std::vector<double> distance(surface.number_of_triangles(), 1);
  const auto expand = [&](const Growth_options& options) { (void)expand_charts(surface, distance, options); };
  expect_faults("merge_depth", &Growth_options::merge_depth, {-0.1, 1.1, nan}, expand);
  expect_faults("noise_depth", &Growth_options::noise_depth, {-0.1, 1.1, nan}, expand);
  expect_fault("distance", [&] { (void)expand_charts(surface, {1, 2}); });
  expect_fault("is_feature", [&] { (void)distance_to_features(surface, {}); });
}

TEST(Segmentation_arguments, Options_of_planar_groupings)
{
  const auto variational = [](const Variational_segmentation::Options& options) {
    Variational_segmentation model(options);
  };
  using V = Variational_segmentation::Options;
  expect_faults("max_spread", &V::max_spread, {0., -1., nan}, variational);
  expect_faults("small_share", &V::small_share, {-0.1, 1.1, nan}, variational);
  expect_faults("compactness", &V::compactness, {-0.1, nan}, variational);
  expect_faults("iterations", &V::iterations, {0, -1}, variational);
  expect_faults("fine_iterations", &V::fine_iterations, {0, 9}, variational);
  const auto grown = [](const Region_growing_segmentation::Options& options) {
    Region_growing_segmentation model(options);
  };
  using R = Region_growing_segmentation::Options;
  expect_faults("planarity_weight", &R::planarity_weight, {-1., nan}, grown);
  expect_faults("compactness_weight", &R::compactness_weight, {-1., nan}, grown);
  expect_faults("max_cost", &R::max_cost, {-1., nan, infinity}, grown);
  expect_faults("max_spread", &R::max_spread, {-1., nan}, grown);
  const auto by_normal = [](const Normal_segmentation::Options& options) {
    Normal_segmentation model(options);
  };
  using N = Normal_segmentation::Options;
  expect_faults("cells_per_side", &N::cells_per_side, {0, -3, 1001}, by_normal);
  expect_faults("min_share", &N::min_share, {-0.1, 1.1, nan}, by_normal);
}

TEST(Segmentation_arguments, Segmentations_of_other_surfaces)
{
  const Surface surface = sheet();
  const auto expect_faults_of = [&](const std::string& argument, const Segmentation& wrong) {
    Segmentation s = wrong;
    const std::vector<Index> first{0};
    expect_fault(argument, [&] { (void)cut_to_discs(surface, s, first); });
    expect_fault(argument, [&] { smooth_borders(surface, s); });
    expect_fault(argument,
                 [&] { merge_charts(surface, s, {}, LSCM_parameterizer<>(), Identity_optimizer()); });
  };
  Segmentation few = halves(surface), no_cuts = few, beyond = few;
  few.chart.pop_back();
  no_cuts.cut.clear();
  beyond.chart.back() = 2;
  expect_faults_of("segmentation.chart", few);
  expect_faults_of("segmentation.cut", no_cuts);
  expect_faults_of("segmentation.chart", beyond);
  expect_fault("segmentation.chart", [&] { cut_to_discs(surface, few); });
  expect_fault("segmentation.cut", [&] { cut_to_discs(surface, no_cuts); });
  Segmentation right = halves(surface);
  const std::vector<Index> third{2};
  expect_fault("charts", [&] { (void)cut_to_discs(surface, right, third); });
}

} // namespace
} // namespace Atlas::test
