// SPDX-License-Identifier: MIT
// Several models as one, and back.
#include <Atlas/soup/Joined_soups.h>

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

using namespace Atlas;

namespace {

/// Two triangles with all attributes.
Polygon_soup rich()
{
  Polygon_soup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  soup.first = {0, 3, 6};
  soup.vertices = {0, 1, 2, 0, 2, 3};
  soup.colors.assign(4, {0.5f, 0.25f, 0, 1});
  soup.face_colors = {{1, 0, 0, 1}, {0, 0, 1, 1}};
  soup.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
  soup.normals = {{0, 0, 1}, {0, 0, -1}};
  soup.corner_normal = {0, 0, 1, no_index, 1, 1};
  soup.material_names = {"wood", "iron"};
  soup.face_material = {1, no_index};
  soup.group_names = {"lid"};
  soup.face_group = {no_index, 0};
  return soup;
}

/// A quad, and a face with vertices that do not exist; no attribute.
Polygon_soup plain()
{
  Polygon_soup soup;
  soup.points = {{5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}};
  soup.first = {0, 4, 7};
  soup.vertices = {0, 1, 2, 3, 4, 6, no_index};
  return soup;
}

Polygon_soup with_material(const char* name)
{
  Polygon_soup soup = plain();
  soup.material_names = {"glass", name};
  soup.face_material = {1, 0};
  return soup;
}

void expect_equal(const Polygon_soup& a, const Polygon_soup& b)
{
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.first, b.first);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.colors, b.colors);
  EXPECT_EQ(a.face_colors, b.face_colors);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.corner_normal, b.corner_normal);
  EXPECT_EQ(a.group_names, b.group_names);
  EXPECT_EQ(a.face_group, b.face_group);
  ASSERT_EQ(a.face_material.size(), b.face_material.size());
  for (std::size_t f = 0; f < a.face_material.size(); ++f) {
    const Index m = a.face_material[f], n = b.face_material[f];
    ASSERT_EQ(m == no_index, n == no_index);
    EXPECT_TRUE(m == no_index || a.material_names[m] == b.material_names[n]);
  }
}

TEST(JoinedSoups, ComeApartAgain)
{
  const std::vector<Polygon_soup> soups = {plain(), rich(), with_material("wood"), Polygon_soup(), rich()};
  const Joined_soups joined(soups);
  ASSERT_EQ(joined.number_of_parts(), soups.size());
  for (std::size_t i = 0; i < soups.size(); ++i) {
    SCOPED_TRACE(i);
    expect_equal(joined.part(i), soups[i]);
  }
  EXPECT_EQ(joined.part(1).uv, rich().uv);
  EXPECT_EQ(joined.first_vertex(2), 8u);
  EXPECT_EQ(joined.first_face(2), 4u);
}

TEST(JoinedSoups, WholeHasTheAttributesOfAll)
{
  const Joined_soups joined({plain(), rich(), with_material("wood")});
  const Polygon_soup& whole = joined.whole();
  ASSERT_EQ(whole.number_of_faces(), 6u);
  EXPECT_EQ(whole.colors.size(), 12u);
  EXPECT_EQ(whole.colors[0], (std::array<float, 4>{1, 1, 1, 1}));
  ASSERT_EQ(whole.uv.size(), whole.number_of_corners());
  EXPECT_TRUE(std::isnan(whole.uv[0].x()));
  EXPECT_EQ(whole.uv[8], Point_2(1, 0));
  EXPECT_EQ(whole.material_names, (std::vector<std::string>{"wood", "iron", "glass"}));
  EXPECT_EQ(whole.face_material, (std::vector<Index>{no_index, no_index, 1, no_index, 0, 2}));
  EXPECT_EQ(whole.corner_normal[7], 0u);
  // What does not exist in the first model is no vertex of the second.
  for (std::size_t c = 4; c < 7; ++c)
    EXPECT_GE(whole.vertices[c], whole.points.size());
}

TEST(JoinedSoups, PartsHaveWhatIsDoneToTheWhole)
{
  Joined_soups joined({rich(), plain()});
  Polygon_soup& whole = joined.whole();
  whole.old_uv = whole.uv;
  for (std::size_t c = 0; c < whole.uv.size(); ++c)
    whole.uv[c] = Point_2(static_cast<double>(c), 0);
  whole.face_page = {0, 1, 2, 3};
  whole.colors.clear();
  const Polygon_soup first = joined.part(0), second = joined.part(1);
  EXPECT_EQ(first.old_uv, rich().uv);
  EXPECT_TRUE(first.colors.empty());
  EXPECT_EQ(first.uv.back(), Point_2(5, 0));
  EXPECT_TRUE(second.old_uv.empty());
  EXPECT_EQ(second.uv.front(), Point_2(6, 0));
  EXPECT_EQ(second.uv.size(), 7u);
  EXPECT_EQ(second.face_page, (std::vector<Index>{2, 3}));
}

TEST(JoinedSoups, OneModelStaysAsItIs)
{
  Polygon_soup soup = rich();
  soup.material_names = {"wood", "wood"};
  const Joined_soups joined({soup});
  expect_equal(joined.whole(), soup);
  EXPECT_EQ(joined.whole().face_material, soup.face_material);
  EXPECT_EQ(joined.whole().uv, soup.uv);
}

} // namespace
