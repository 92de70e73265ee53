// SPDX-License-Identifier: MIT
// Several pages through every format and into pictures.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/bake/bake_texture.h>
#include <Atlas/image/Image.h>
#include <Atlas/image/pages.h>

#include "temporary_folder.h"
#include <gtest/gtest.h>
#include <string>
#include <tiny_gltf.h>
#include <vector>

using namespace Atlas;

namespace {

/// A row of squares, one per page, all in the same place of their page; the last page is in the second row of
/// tiles.
Polygon_soup squares(const std::vector<Index>& pages = {0, 1, 9, 10, 25})
{
  Polygon_soup soup;
  for (Index i = 0; i < pages.size(); ++i) {
    soup.points.insert(soup.points.end(), {{i + 0., 0, 0}, {i + .5, 0, 0}, {i + .5, 1, 0}, {i + 0., 1, 0}});
    for (Index k = 0; k < 4; ++k)
      soup.vertices.push_back(4 * i + k);
    soup.close_face();
    soup.uv.insert(soup.uv.end(), {{.125, .25}, {.375, .25}, {.375, .5}, {.125, .5}});
    soup.face_page.push_back(pages[i]);
  }
  return soup;
}

std::size_t count(const std::string& text, const std::string& what)
{
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++n;
  return n;
}

/// A page of one colour per number.
Image plain_page(Index page)
{
  return Image(8, 8, Color{static_cast<std::uint8_t>(10 * page), 100, 7});
}

tinygltf::Model loaded(const std::string& glb)
{
  tinygltf::Model model;
  std::string error, warning;
  EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromMemory(&model, &error, &warning,
                                                        reinterpret_cast<const unsigned char*>(glb.data()),
                                                        static_cast<unsigned>(glb.size())));
  return model;
}

} // namespace

TEST(Pages, udim_tiles_there_and_back)
{
  Polygon_soup soup = squares();
  const Polygon_soup before = soup;
  soup.uv = udim_uv(soup);
  EXPECT_EQ(soup.uv[4 * 1], Point_2(1.125, .25));
  EXPECT_EQ(soup.uv[4 * 2], Point_2(9.125, .25));
  EXPECT_EQ(soup.uv[4 * 3], Point_2(.125, 1.25));
  EXPECT_EQ(soup.uv[4 * 4], Point_2(5.125, 2.25));
  soup.face_page.clear();
  EXPECT_EQ(separate_udim(soup), 26u);
  EXPECT_EQ(soup.face_page, before.face_page);
  EXPECT_EQ(soup.uv, before.uv);
}

TEST(Pages, faces_outside_of_the_tiles_or_up_to_their_border)
{
  Polygon_soup soup = squares({0, 0, 0});
  for (std::size_t c = 0; c < 4; ++c) {
    soup.uv[c] = Point_2(soup.uv[c].x() * 4 + .5, soup.uv[c].y() * 4 - 1); // [1, 2] x [0, 1]
    soup.uv[4 + c] = Point_2(-3, .5);
    soup.uv[8 + c] = Point_2(NAN, .5);
  }
  separate_udim(soup);
  EXPECT_EQ(soup.face_page, (std::vector<Index>{1, 0, 0}));
  EXPECT_EQ(soup.uv[0], Point_2(0, 0));
  EXPECT_EQ(soup.uv[2], Point_2(1, 1));
  EXPECT_EQ(soup.uv[5], Point_2(-3, .5));
}

TEST(Pages, names_of_files)
{
  EXPECT_EQ(page_file_name("a b.png", 0, 1), "a b.png");
  EXPECT_EQ(page_file_name("a b.png", 0, 2), "a b.1001.png");
  EXPECT_EQ(page_file_name("a.b.png", 11, 12), "a.b.1012.png");
  EXPECT_EQ(page_file_name("a", 1, 2), "a.1002");
}

TEST(Pages, obj_with_tiles)
{
  const test::Temporary_folder folder;
  const Polygon_soup soup = squares();
  write_obj(folder / "a.obj", soup, "t.png");
  Polygon_soup back = read_polygon_soup(folder / "a.obj");
  EXPECT_EQ(back.uv, udim_uv(soup));
  separate_udim(back);
  EXPECT_EQ(back.uv, soup.uv);
  EXPECT_EQ(back.face_page, soup.face_page);
  const std::string mtl = test::bytes_of(folder / "a.mtl");
  EXPECT_EQ(count(mtl, "newmtl"), 1u);
  EXPECT_EQ(count(mtl, "map_Kd t.<UDIM>.png\n"), 1u);
}

TEST(Pages, obj_with_materials)
{
  const test::Temporary_folder folder;
  Polygon_soup soup = squares({0, 1, 1, 0});
  soup.material_names = {"wood"};
  soup.face_material = {0, 0, no_index, 0};
  write_obj(folder / "a.obj", soup, "t.png", Page_style::materials);
  const Polygon_soup back = read_polygon_soup(folder / "a.obj");
  EXPECT_EQ(back.uv, soup.uv);
  std::vector<std::string> names;
  for (const Index m : back.face_material)
    names.push_back(back.material_names[m]);
  EXPECT_EQ(names, (std::vector<std::string>{"wood.1001", "wood.1002", "atlas.1002", "wood.1001"}));
  const std::string mtl = test::bytes_of(folder / "a.mtl");
  for (const std::string& name : names)
    EXPECT_EQ(count(mtl, "newmtl " + name + '\n'), 1u);
  EXPECT_EQ(count(mtl, "map_Kd t.1001.png\n"), 2u);
  EXPECT_EQ(count(mtl, "map_Kd t.1002.png\n"), 2u);
}

TEST(Pages, ply_of_both_styles)
{
  const test::Temporary_folder folder;
  const Polygon_soup soup = squares({0, 2, 1});
  write_ply(folder / "a.ply", soup, "t.png", Ply_texcoord_style::wedge);
  const Polygon_soup wedge = read_polygon_soup(folder / "a.ply");
  EXPECT_EQ(wedge.uv, soup.uv);
  EXPECT_EQ(wedge.face_page, soup.face_page);
  EXPECT_EQ(wedge.page_textures, (std::vector<std::string>{"t.1001.png", "t.1002.png", "t.1003.png"}));
  write_ply(folder / "b.ply", soup, "t.png", Ply_texcoord_style::vertex);
  Polygon_soup vertex = read_polygon_soup(folder / "b.ply");
  EXPECT_TRUE(vertex.face_page.empty());
  separate_udim(vertex);
  EXPECT_EQ(vertex.uv, soup.uv);
  EXPECT_EQ(vertex.face_page, soup.face_page);
}

TEST(Pages, ply_names_all_of_them_even_if_faces_are_on_one)
{
  Polygon_soup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  soup.vertices = {0, 1, 2};
  soup.close_face();
  soup.uv = {{0, 0}, {1, 0}, {0, 1}};
  const auto has = [](const std::string& bytes, const char* name) {
    return bytes.find(std::string("comment TextureFile ") + name + '\n') != std::string::npos;
  };
  EXPECT_TRUE(has(ply_bytes(soup, "t.png"), "t.png"));
  const std::string bytes = ply_bytes(soup, "t.png", Ply_texcoord_style::wedge, 2);
  EXPECT_TRUE(has(bytes, "t.1001.png") && has(bytes, "t.1002.png"));
}

TEST(Pages, glb_has_a_texture_and_a_primitive_per_page)
{
  Polygon_soup soup = squares({2, 0, 1, 0});
  std::vector<std::string> pngs;
  for (const Index page : {0, 1, 2})
    pngs.push_back(png_bytes(plain_page(page)));
  tinygltf::Model model = loaded(glb_bytes(soup, pngs));
  const auto primitives = model.meshes.at(0).primitives;
  ASSERT_EQ(primitives.size(), 3u);
  const Index page_of_primitive[] = {2, 0, 1}; // in the order of the faces
  const std::size_t corners[] = {6, 12, 6};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& material = model.materials.at(primitives[i].material);
    EXPECT_EQ(material.name, "atlas." + std::to_string(udim_tile(page_of_primitive[i])));
    const auto& texture = model.textures.at(material.pbrMetallicRoughness.baseColorTexture.index);
    EXPECT_EQ(model.images.at(texture.source).image.at(0), 10 * page_of_primitive[i]);
    EXPECT_EQ(model.accessors.at(primitives[i].indices).count, corners[i]);
  }

  model = loaded(glb_bytes(soup, pngs[0]));
  EXPECT_EQ(model.textures.size(), 1u);
  for (const auto& material : model.materials)
    EXPECT_EQ(material.pbrMetallicRoughness.baseColorTexture.index, 0);
}

TEST(Pages, pictures_show_one_page_or_all_on_a_sheet)
{
  Polygon_soup soup = squares({0, 2});
  for (std::size_t c = 4; c < 8; ++c)
    soup.uv[c] = Point_2(soup.uv[c].x() + .5, soup.uv[c].y()); // [.625, .875] x [.25, .5]
  const std::vector<Index> charts = {0, 1};
  const Color background = draw_atlas(soup, charts, 64, {}, 1).at(16, 40);
  const Image first = draw_atlas(soup, charts, 64, {}, 0), third = draw_atlas(soup, charts, 64, {}, 2);
  EXPECT_NE(first.at(16, 40), background);
  EXPECT_EQ(first.at(48, 40), background);
  EXPECT_EQ(third.at(16, 40), background);
  EXPECT_NE(third.at(48, 40), background);
  EXPECT_EQ(draw_stretch(soup, {1, 1}, 64, 1).pixels, std::vector<Color>(64 * 64, background));

  const Polygon_soup sheet = sheet_of_pages(soup);
  EXPECT_EQ(sheet.number_of_pages(), 1u);
  EXPECT_EQ(sheet.uv[0], Point_2(.0625, .625)); // top left
  EXPECT_EQ(sheet.uv[4], Point_2(.3125, .125)); // bottom left
  const Image all = sheet_of_images({plain_page(1), plain_page(2), plain_page(3)});
  EXPECT_EQ(all.width, 16u);
  EXPECT_EQ(all.at(0, 0)[0], 10);
  EXPECT_EQ(all.at(8, 0)[0], 20);
  EXPECT_EQ(all.at(0, 15)[0], 30);
}

TEST(Pages, that_are_not_square_make_a_sheet_of_their_shape)
{
  const Image sheet =
      sheet_of_images({Image(8, 4, {1, 1, 1}), Image(8, 4, {2, 2, 2}), Image(8, 4, {3, 3, 3})});
  EXPECT_EQ(sheet.width, 16u);
  EXPECT_EQ(sheet.height, 8u);
  EXPECT_EQ(sheet.at(7, 3)[0], 1);
  EXPECT_EQ(sheet.at(8, 3)[0], 2);
  EXPECT_EQ(sheet.at(7, 4)[0], 3);
}

TEST(Pages, each_is_baked_for_itself)
{
  Polygon_soup soup = squares({0, 1});
  soup.colors.assign(8, {1, 0, 0, 1});
  std::fill(soup.colors.begin() + 4, soup.colors.end(), std::array<float, 4>{0, 0, 1, 1});
  EXPECT_EQ(bake_vertex_colors(soup, 8, 0).pixels, std::vector<Color>(64, Color{255, 0, 0}));
  EXPECT_EQ(bake_vertex_colors(soup, 8, 1).pixels, std::vector<Color>(64, Color{0, 0, 255}));
  const auto x_is_large = [](const Point_3& p) { return p.x() >= 1 ? Color{9, 9, 9} : Color{1, 1, 1}; };
  EXPECT_EQ(bake_procedural(soup, 8, x_is_large, 1).pixels, std::vector<Color>(64, Color{9, 9, 9}));
}
