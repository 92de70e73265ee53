// SPDX-License-Identifier: MIT
#include <Atlas/segmentation/Feature_segmentation.h>
#include <Atlas/segmentation/internal/features/detect_features.h>

#include "segmentation_shapes.h"
#include <array>
#include <map>

namespace Atlas {
namespace {

using test::Soup;

std::size_t number_of_features(const std::vector<std::uint8_t>& is_feature)
{
  return static_cast<std::size_t>(std::count(is_feature.begin(), is_feature.end(), 1)) / 2;
}

/// Marks edges of a flat sheet as sharp and runs Algorithm 1 on them: creases along the middle row.
class Creases : public testing::Test
{
protected:
  static constexpr Index m = 60, n = 10;

  /// The number of features found with sharp edges at the given places of the row.
  std::vector<Index> run(const std::function<bool(Index)>& is_sharp, int rings = 1)
  {
    sharpness_.assign(surface_.opposite.size(), 0.01f);
    for (Index i = 0; i < m; ++i)
      if (is_sharp(i))
        sharpness_[edge(i, n / 2)] = sharpness_[surface_.opposite[edge(i, n / 2)]] = 1;
    return trace(rings);
  }

  /// Places in the middle row where features are, and m + j for features anywhere else.
  std::vector<Index> trace(int rings)
  {
    internal::Feature_tracer tracer(surface_, submesh_, sharpness_, 0.5f, 5, 15, rings);
    is_feature_ = tracer.run(CGAL_PI);
    std::vector<Index> found;
    for (Index h = 0; h < surface_.opposite.size(); ++h)
      if (is_feature_[h]) {
        EXPECT_TRUE(is_feature_[surface_.opposite[h]]);
        Index place = m + h;
        for (Index i = 0; i < m; ++i)
          if (edge(i, n / 2) == h || surface_.opposite[edge(i, n / 2)] == h)
            place = i;
        found.push_back(place);
      }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  /// The halfedge from column i to i + 1 on row j, seen from the cell above.
  static Index edge(Index i, Index j) { return 3 * (2 * (j * m + i)); }

  static std::vector<Index> range(Index a, Index b)
  {
    std::vector<Index> r(b - a);
    std::iota(r.begin(), r.end(), a);
    return r;
  }

  Surface surface_ = test::surface_of(test::planar_grid(m, n));
  internal::Submesh submesh_ = internal::surface_connectivity(surface_);
  std::vector<float> sharpness_;
  std::vector<std::uint8_t> is_feature_;
};

TEST_F(Creases, A_long_one_is_followed_to_its_ends)
{
  // The string that leaves the end may hang over by as many edges as keep its mean above the threshold.
  const std::vector<Index> found = run([](Index i) { return i >= 10 && i < 40; });
  ASSERT_FALSE(found.empty());
  for (const Index i : range(10, 40))
    EXPECT_TRUE(std::binary_search(found.begin(), found.end(), i)) << i;
  EXPECT_LE(found.size(), 30u + 2 * 3);
}

TEST_F(Creases, Fifteen_edges_and_less_are_noise)
{
  EXPECT_TRUE(run([](Index i) { return i >= 10 && i < 20; }).empty());
}

TEST_F(Creases, Short_gaps_are_bridged_and_long_ones_are_not)
{
  const auto covers = [](const std::vector<Index>& found, Index a, Index b) {
    const std::vector<Index> all = range(a, b);
    return std::includes(found.begin(), found.end(), all.begin(), all.end());
  };
  EXPECT_TRUE(covers(run([](Index i) { return i >= 10 && i < 50 && i != 29 && i != 30; }), 10, 50));
  const std::vector<Index> found = run([](Index i) { return i >= 5 && i < 55 && (i < 25 || i >= 35); });
  EXPECT_TRUE(covers(found, 5, 25));
  EXPECT_TRUE(covers(found, 35, 55));
  EXPECT_FALSE(covers(found, 25, 35));
}

TEST_F(Creases, Neighborhoods_keep_further_features_away)
{
  // Three sharp rows side by side, the middle one sharpest: one feature.
  const auto three_rows = [&](int rings) {
    sharpness_.assign(surface_.opposite.size(), 0.01f);
    for (Index i = 0; i < m; ++i)
      for (Index j : {n / 2 - 1, n / 2, n / 2 + 1})
        sharpness_[edge(i, j)] = sharpness_[surface_.opposite[edge(i, j)]] = j == n / 2 ? 1.f : 0.8f;
    return trace(rings).size();
  };
  EXPECT_EQ(three_rows(2), m);
  EXPECT_GE(three_rows(0), 2 * m);
}

TEST(Feature_detection, The_rims_of_a_cylinder)
{
  for (const bool quads : {false, true}) {
    const Surface surface = test::surface_of(test::capped_cylinder(quads));
    const std::vector<std::uint8_t> is_feature = detect_features(surface);
    EXPECT_EQ(number_of_features(is_feature), 2 * 48u);
    for (Index h = 0; h < is_feature.size(); ++h)
      if (is_feature[h]) {
        const Point_3 &p = surface.point(h), &q = surface.point(next_halfedge(h));
        EXPECT_EQ(p.z(), q.z());
        EXPECT_TRUE(p.z() == 0 || p.z() == 3);
        EXPECT_FALSE(surface.is_diagonal(h));
      }
  }
}

TEST(Feature_detection, Even_curvature_has_no_features)
{
  EXPECT_EQ(number_of_features(detect_features(test::surface_of(test::sphere(4)))), 0u);
  EXPECT_EQ(number_of_features(detect_features(test::surface_of(test::ellipsoid(2)))), 0u);
  EXPECT_EQ(number_of_features(detect_features(test::surface_of(test::planar_grid(30, 30)))), 0u);
}

TEST(Feature_detection, What_the_paper_does_not_have_can_be_turned_off)
{
  // A prism of twelve sides: rims of twelve edges are too short for the paper.
  const Surface prism = test::surface_of(test::lathe({{0, 0}, {1, 0}, {1, 3}, {0, 3}}, 12, 6));
  Feature_options options;
  options.min_contrast = 0; // or the twelve edges between the sides are no features
  EXPECT_GE(number_of_features(detect_features(prism, options)), 2 * 12u);
  options.min_feature_length_of_small_meshes = INFINITY;
  EXPECT_EQ(number_of_features(detect_features(prism, options)), 0u);
  options.min_feature_length = 11;
  EXPECT_GE(number_of_features(detect_features(prism, options)), 2 * 12u);

  // Forty-eight sides, all equally sharp, are many times five percent: either none of them are, or all.
  const Surface drum = test::surface_of(test::capped_cylinder());
  options = Feature_options();
  options.min_contrast = 0;
  EXPECT_EQ(number_of_features(detect_features(drum, options)), 2 * 48u);
  options.plateau_tolerance = 0;
  EXPECT_GT(number_of_features(detect_features(drum, options)), 2 * 48u + 100);
}

TEST(Feature_detection, Hard_angle_takes_short_features_too)
{
  const Surface surface = test::surface_of(test::cube());
  EXPECT_EQ(number_of_features(detect_features(surface)), 0u);
  Feature_options options;
  options.hard_angle = 1;
  EXPECT_EQ(number_of_features(detect_features(surface, options)), 12u);
}

TEST(Feature_detection, Filtered_normals_find_the_edges_of_a_noisy_cube)
{
  // Every vertex is off by up to two fifths of an edge, in all directions.
  const Index n = 40;
  const Surface clean = test::surface_of(test::noisy_cube(n, 0));
  const Surface noisy = test::surface_of(test::noisy_cube(n, 0.4 / n));
  const auto edge_of_cube = [&](Index h) { // (axis, place), or nothing
    const Point_3 &p = clean.point(h), &q = clean.point(next_halfedge(h));
    std::array<int, 3> place{};
    int fixed = 0;
    for (int i = 0; i < 3; ++i) {
      const bool is_fixed = p[i] == q[i] && (p[i] == 0 || p[i] == 1);
      place[i] = is_fixed ? static_cast<int>(p[i]) : 2;
      fixed += is_fixed;
    }
    return fixed == 2 ? place : std::array<int, 3>{};
  };
  const auto features_on_edges = [&](int rounds) {
    Feature_options options;
    options.normal_filter_rounds = rounds;
    const std::vector<std::uint8_t> is_feature = detect_features(noisy, options);
    std::map<std::array<int, 3>, int> count;
    for (Index h = 0; h < is_feature.size(); ++h)
      if (is_feature[h] && h < noisy.opposite[h])
        ++count[edge_of_cube(h)];
    return count;
  };
  std::map<std::array<int, 3>, int> found = features_on_edges(10);
  EXPECT_LE(found[(std::array<int, 3>{})], static_cast<int>(2 * n)); // of 28800 edges
  found.erase(std::array<int, 3>{});
  EXPECT_EQ(found.size(), 12u);
  for (const auto& [edge, number] : found)
    EXPECT_GE(number, static_cast<int>(n * 8 / 10));
  // Without the filter noise is as sharp as the edges.
  int least = n;
  for (const auto& [edge, number] : features_on_edges(0))
    least = std::min(least, number);
  EXPECT_LT(least, static_cast<int>(n / 2));
}

TEST(Feature_detection, Scale_does_not_matter_and_wishes_do)
{
  Soup soup = test::glove();
  Surface surface = test::surface_of(soup);
  const std::vector<std::uint8_t> is_feature = detect_features(surface);
  EXPECT_GT(number_of_features(is_feature), 4 * 28u);
  for (Point_3& p : soup.points)
    p = Point_3(p.x() * 0x1p-20, p.y() * 0x1p-20, p.z() * 0x1p-20);
  EXPECT_EQ(detect_features(test::surface_of(soup)), is_feature);
  surface.constraint.assign(surface.opposite.size(), Edge_constraint::no_seam);
  EXPECT_EQ(number_of_features(detect_features(surface)), 0u);
}

} // namespace
} // namespace Atlas
