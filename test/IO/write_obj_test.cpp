// SPDX-License-Identifier: MIT
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/image/internal/Output_file.h>

#include "temporary_folder.h"
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

using namespace Atlas;

namespace {

/// A soup that has everything, with numbers that need all their digits.
Polygon_soup rich_soup()
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  Polygon_soup soup;
  for (int i = 0; i < 50; ++i) {
    soup.points.emplace_back(number(random), number(random) * 1e30, number(random) * 1e-30);
    soup.colors.push_back({.1f, static_cast<float>(i) / 50, .3f, 1});
    soup.normals.emplace_back(number(random), number(random), number(random));
  }
  soup.material_names = {"red", "blue"};
  soup.group_names = {"one", "two words"};
  for (Index f = 0; f < 40; ++f) {
    for (Index i = 0; i < 3 + f % 4; ++i) {
      soup.vertices.push_back((7 * f + 3 * i) % 50);
      soup.corner_normal.push_back(f % 7 == 0 ? no_index : (f + i) % 50);
      soup.uv.emplace_back(static_cast<float>(number(random)), f % 5 == 0 ? NAN : 0.125);
    }
    soup.close_face();
    soup.face_material.push_back(f < 5 ? no_index : f % 2);
    soup.face_group.push_back(f < 3 ? no_index : f / 20);
  }
  return soup;
}

bool is_same(const Point_2& p, const Point_2& q)
{
  return p == q || !std::isfinite(p.x() + p.y() + q.x() + q.y());
}

} // namespace

TEST(Write_obj, comes_back_the_same_to_the_last_bit)
{
  const test::Temporary_folder folder;
  const Polygon_soup soup = rich_soup();
  write_obj(folder / "ü a.obj", soup, "t.png");
  const Polygon_soup back = read_polygon_soup(folder / "ü a.obj");
  EXPECT_EQ(back.points, soup.points);
  EXPECT_EQ(back.first, soup.first);
  EXPECT_EQ(back.vertices, soup.vertices);
  EXPECT_EQ(back.colors, soup.colors);
  EXPECT_EQ(back.normals, soup.normals);
  EXPECT_EQ(back.corner_normal, soup.corner_normal);
  ASSERT_EQ(back.uv.size(), soup.uv.size());
  for (std::size_t c = 0; c < soup.uv.size(); ++c)
    EXPECT_TRUE(is_same(back.uv[c], soup.uv[c])) << c;
  EXPECT_EQ(back.material_libraries, std::vector<std::string>{"ü a.mtl"});
  for (std::size_t f = 5; f < 40; ++f)
    EXPECT_EQ(back.material_names[back.face_material[f]], soup.material_names[soup.face_material[f]]);
  for (std::size_t f = 3; f < 40; ++f)
    EXPECT_EQ(back.group_names[back.face_group[f]], soup.group_names[soup.face_group[f]]);
  EXPECT_EQ(test::bytes_of(folder / "ü a.mtl").find("map_Kd t.png"),
            test::bytes_of(folder / "ü a.mtl").find("map_Kd"));
}

TEST(Write_obj, equal_coordinates_are_written_once)
{
  Polygon_soup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  soup.vertices = {0, 1, 2, 2, 1, 3};
  soup.first = {0, 3, 6};
  soup.uv = {{0, 0}, {1, 0}, {0, 1}, {0, 1}, {1, 0}, {1, 1}};
  EXPECT_EQ(obj_text(soup, ""),
            "# written by Atlas\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
            "vt 1 1\nf 1/1 2/2 3/3\nf 3/3 2/2 4/4\n");
}

TEST(Write_obj, indices_that_do_not_exist_come_out_as_they_came_in)
{
  const test::Temporary_folder folder;
  const std::string text = "v 0 0 0\nf 1 0 9000\n";
  write_obj(folder / "b.obj", read_polygon_soup(folder.write("a.obj", text)));
  EXPECT_EQ(test::bytes_of(folder / "b.obj"), "# written by Atlas\n" + text);
}

TEST(Output_files, appear_whole_or_not_at_all)
{
  const test::Temporary_folder folder;
  const Polygon_soup soup = rich_soup();
  std::filesystem::create_directory(folder / "taken.obj");
  EXPECT_THROW(write_obj(folder / "taken.obj", soup, "t.png"), IO_error);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"taken.obj"}); // no MTL file either
  EXPECT_THROW(write_obj(folder / "no/such/folder.obj", soup), IO_error);
  EXPECT_THROW(write_obj("/dev/full", soup), IO_error);
  {
    internal::Output_files files;
    files.add(folder / "a", "text");
    EXPECT_EQ(folder.names().size(), 2u);
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"taken.obj"});
}

TEST(Output_files, replace_files_and_follow_links)
{
  const test::Temporary_folder folder;
  folder.write("old", "old");
  std::filesystem::create_symlink("old", folder / "link");
  internal::write_whole_file(folder / "link", "new");
  EXPECT_EQ(test::bytes_of(folder / "old"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  internal::write_whole_file("/dev/null", "gone");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}
