// SPDX-License-Identifier: MIT
// What is written as glTF and PLY is read back; formats with one set of attributes per vertex split vertices.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/image/Image.h>
#include <Atlas/soup/internal/split_vertices.h>

#include "temporary_folder.h"
#include <cmath>
#include <cstddef>
#include <cstring>
#include <gtest/gtest.h>
#include <string>
#include <tiny_gltf.h>
#include <vector>

using namespace Atlas;

namespace {

/// Two triangles that share an edge in space; `is_cut`: not on the page.
Polygon_soup two_triangles(bool is_cut)
{
  Polygon_soup soup;
  soup.points = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {1, 1, .125}, {0, 1, 0}}; // no face uses the first
  soup.vertices = {1, 2, 3, 1, 3, 4};
  soup.first = {0, 3, 6};
  const double shift = is_cut ? 0.25 : 0;
  soup.uv = {{0, 0}, {.5, 0}, {.5, .5}, {0, shift}, {.5, .5 + shift}, {0, .5 + shift}};
  soup.colors = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}};
  soup.normals = {{0, 0, 1}};
  soup.corner_normal.assign(6, 0);
  soup.material_names = {"red", "blue"};
  soup.face_material = {1, 0};
  return soup;
}

/// Checks that the corners of all faces have the same positions, coordinates and colours.
void expect_same_corners(const Polygon_soup& a, const Polygon_soup& b)
{
  ASSERT_EQ(a.first, b.first);
  for (std::size_t c = 0; c < a.number_of_corners(); ++c) {
    EXPECT_EQ(a.points[a.vertices[c]], b.points[b.vertices[c]]) << c;
    EXPECT_EQ(a.uv[c], b.uv[c]) << c;
    EXPECT_EQ(a.colors[a.vertices[c]], b.colors[b.vertices[c]]) << c;
    EXPECT_EQ(a.normals[a.corner_normal[c]], b.normals[b.corner_normal[c]]) << c;
  }
}

} // namespace

TEST(Split_vertices, splits_only_where_corners_differ)
{
  const internal::Split_vertices whole = internal::split_vertices(two_triangles(false)),
                                 cut = internal::split_vertices(two_triangles(true));
  EXPECT_EQ(whole.original, (std::vector<Index>{1, 2, 3, 4}));
  EXPECT_EQ(whole.corner, (std::vector<Index>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(cut.original, (std::vector<Index>{1, 2, 3, 1, 3, 4}));
  EXPECT_EQ(cut.corner, (std::vector<Index>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(cut.uv[3], Point_2(0, 0.25));
}

TEST(Write_glb, comes_back_the_same)
{
  const test::Temporary_folder folder;
  for (const bool is_cut : {false, true}) {
    Polygon_soup soup = two_triangles(is_cut);
    soup.face_material = {0, 1}; // in the order of the primitives
    write_glb(folder / "a.glb", soup, png_bytes(checkerboard(16, 4)));
    const Polygon_soup back = read_polygon_soup(folder / "a.glb");
    expect_same_corners(soup, back);
    EXPECT_EQ(back.material_names, soup.material_names);
    EXPECT_EQ(back.face_material, soup.face_material);
  }
}

TEST(Write_glb, carries_the_texture)
{
  const std::string png = png_bytes(checkerboard(16, 4));
  const std::string bytes = glb_bytes(two_triangles(true), png);
  EXPECT_NE(bytes.find(png), std::string::npos);
  EXPECT_NE(bytes.find("\"mimeType\":\"image/png\""), std::string::npos);
  EXPECT_NE(bytes.find("\"baseColorTexture\":{\"index\":0}"), std::string::npos);
}

TEST(Write_glb, models_far_from_the_origin_or_huge_keep_their_shape)
{
  const test::Temporary_folder folder;
  Polygon_soup soup = two_triangles(true);
  for (const double scale : {1e30, 1e-30})
    for (const double shift : {0., 1e6}) {
      Polygon_soup moved = soup;
      for (Point_3& p : moved.points)
        p = Point_3(scale * (p.x() + shift), scale * (p.y() - shift), scale * p.z());
      write_glb(folder / "a.glb", moved, "");
      const Polygon_soup back = read_polygon_soup(folder / "a.glb");
      for (std::size_t c = 0; c < 6; ++c)
        EXPECT_LT(
            std::sqrt((back.points[back.vertices[c]] - moved.points[moved.vertices[c]]).squared_length() /
                      scale / scale),
            1e-6);
    }
}

TEST(Write_glb, leaves_out_faces_without_a_shape)
{
  const test::Temporary_folder folder;
  Polygon_soup soup = two_triangles(true);
  soup.vertices[0] = 77;
  soup.points[0] = Point_3(NAN, INFINITY, 0);
  write_glb(folder / "a.glb", soup, "");
  EXPECT_EQ(read_polygon_soup(folder / "a.glb").number_of_faces(), 1u);
}

TEST(Write_glb, colours_are_light)
{
  // sRGB 0.50196, which is 128 of 255, is the light 0.2158605 (IEC 61966-2-1); it comes back as it was.
  const test::Temporary_folder folder;
  Polygon_soup soup = two_triangles(true);
  soup.colors.assign(soup.points.size(), {128.f / 255, 1, 0, .5f});
  write_glb(folder / "a.glb", soup, "");
  tinygltf::TinyGLTF loader;
  tinygltf::Model model;
  std::string error, warning;
  ASSERT_TRUE(loader.LoadBinaryFromFile(&model, &error, &warning, (folder / "a.glb").string()));
  const auto& accessor =
      model.accessors[static_cast<std::size_t>(model.meshes[0].primitives[0].attributes.at("COLOR_0"))];
  const auto& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
  float written[4];
  std::memcpy(written, &model.buffers[0].data[view.byteOffset], sizeof written);
  EXPECT_NEAR(written[0], 0.2158605f, 1e-6);
  EXPECT_EQ(written[1], 1);
  EXPECT_EQ(written[2], 0);
  EXPECT_EQ(written[3], .5f);
  EXPECT_NEAR(read_polygon_soup(folder / "a.glb").colors[0][0], 128.f / 255, 1e-6);
}

TEST(Write_ply, keeps_colours_of_faces)
{
  const test::Temporary_folder folder;
  Polygon_soup soup = two_triangles(true);
  soup.face_colors = {{1, 0, .2f, 1}, {0, 1, 0, 1}};
  write_ply(folder / "a.ply", soup, "");
  EXPECT_EQ(read_polygon_soup(folder / "a.ply").face_colors, soup.face_colors);
}

TEST(Write_ply, both_styles_come_back_the_same)
{
  const test::Temporary_folder folder;
  for (const Ply_texcoord_style style : {Ply_texcoord_style::wedge, Ply_texcoord_style::vertex}) {
    const Polygon_soup soup = two_triangles(true);
    write_ply(folder / "a.ply", soup, "t.png", style);
    const Polygon_soup back = read_polygon_soup(folder / "a.ply");
    expect_same_corners(soup, back);
    EXPECT_EQ(back.points.size(), style == Ply_texcoord_style::wedge ? 5u : 6u);
    EXPECT_NE(test::bytes_of(folder / "a.ply").find("comment TextureFile t.png\n"), std::string::npos);
  }
}

TEST(Write_ply, polygons_of_many_corners)
{
  const test::Temporary_folder folder;
  Polygon_soup soup;
  for (Index i = 0; i < 300; ++i) {
    soup.points.emplace_back(std::cos(i / 50.), std::sin(i / 50.), 0);
    soup.vertices.push_back(i);
    soup.uv.emplace_back(i / 512., .5);
  }
  soup.close_face();
  write_ply(folder / "a.ply", soup, "");
  const Polygon_soup back = read_polygon_soup(folder / "a.ply");
  EXPECT_EQ(back.vertices, soup.vertices);
  EXPECT_EQ(back.uv, soup.uv);
  EXPECT_EQ(back.points, soup.points);
}
