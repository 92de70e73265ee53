// SPDX-License-Identifier: MIT
#include <Atlas/IO/internal/find_file.h>
#include <Atlas/IO/internal/gltf_texture.h>
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/bake/bake_texture.h>
#include <Atlas/image/Image.h>

#include "temporary_folder.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <tiny_gltf.h>
#include <utility>
#include <vector>

using namespace Atlas;

namespace {

Image noise(std::size_t size, unsigned seed = 1)
{
  std::mt19937 random(seed);
  Image image(size, size);
  for (Color& color : image.pixels)
    for (auto& component : color)
      component = static_cast<std::uint8_t>(random());
  return image;
}

/// A square on the whole page.
Polygon_soup square()
{
  Polygon_soup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  soup.vertices = {0, 1, 2, 3};
  soup.close_face();
  soup.uv = soup.old_uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  return soup;
}

Source_textures textures_of(const Image& image)
{
  Source_textures source;
  source.textures.emplace_back();
  source.textures[0].image = image;
  source.face_texture = {0};
  return source;
}

/// A JPEG file of 8 x 8 pixels of the colour (200, 100, 50).
constexpr const char* jpeg_hex =
    "ffd8ffe000104a46494600010100000100010000ffdb0084000201010101010201010102020202020403020202020504"
    "040304060506060605060606070908060709070606080b08090a0a0a0a0a06080b0c0b0a0c090a0a0a01020202020202"
    "050303050a0706070a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a"
    "0a0a0a0a0a0a0a0a0a0affc00011080008000803011100021101031101ffc401a2000001050101010101010000000000"
    "0000000102030405060708090a0b100002010303020403050504040000017d0102030004110512213141061351610722"
    "7114328191a1082342b1c11552d1f02433627282090a161718191a25262728292a3435363738393a434445464748494a"
    "535455565758595a636465666768696a737475767778797a838485868788898a92939495969798999aa2a3a4a5a6a7a8"
    "a9aab2b3b4b5b6b7b8b9bac2c3c4c5c6c7c8c9cad2d3d4d5d6d7d8d9dae1e2e3e4e5e6e7e8e9eaf1f2f3f4f5f6f7f8f9"
    "fa0100030101010101010101010000000000000102030405060708090a0b110002010204040304070504040001027700"
    "0102031104052131061241510761711322328108144291a1b1c109233352f0156272d10a162434e125f11718191a2627"
    "28292a35363738393a434445464748494a535455565758595a636465666768696a737475767778797a82838485868788"
    "898a92939495969798999aa2a3a4a5a6a7a8a9aab2b3b4b5b6b7b8b9bac2c3c4c5c6c7c8c9cad2d3d4d5d6d7d8d9dae2"
    "e3e4e5e6e7e8e9eaf2f3f4f5f6f7f8f9faffda000c03010002110311003f00a15fcb07f6c1ffd9";

std::string bytes_of_hex(const std::string& hex)
{
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  return bytes;
}

} // namespace

TEST(Transfer_texture, to_the_same_coordinates_changes_nothing)
{
  const Image image = noise(32);
  EXPECT_EQ(transfer_texture(square(), 32, textures_of(image)).pixels, image.pixels);
}

TEST(Transfer_texture, turns_with_the_coordinates)
{
  const Image image = noise(32);
  Polygon_soup soup = square();
  soup.uv = {{1, 0}, {1, 1}, {0, 1}, {0, 0}}; // a quarter turn counterclockwise
  const Image turned = transfer_texture(soup, 32, textures_of(image));
  for (std::size_t y = 0; y < 32; ++y)
    for (std::size_t x = 0; x < 32; ++x)
      EXPECT_EQ(turned.at(x, y), image.at(31 - y, x));
}

TEST(Transfer_texture, to_fewer_texels_takes_means_and_to_more_interpolates)
{
  const Image image = noise(32);
  EXPECT_EQ(transfer_texture(square(), 16, textures_of(image)).pixels, halved(image).pixels);
  const Image finer = transfer_texture(square(), 64, textures_of(image));
  // Texel 2 i + 1 is a quarter of a pixel right of pixel i.
  for (std::size_t k = 0; k < 3; ++k) {
    const double above = .75 * image.at(4, 9)[k] + .25 * image.at(5, 9)[k],
                 below = .75 * image.at(4, 10)[k] + .25 * image.at(5, 10)[k];
    EXPECT_NEAR(finer.at(9, 19)[k], .75 * above + .25 * below, .51);
  }
}

TEST(Transfer_texture, outside_of_the_unit_square)
{
  const Image image = noise(8);
  Source_textures source = textures_of(image);
  Polygon_soup soup = square();
  for (Point_2& p : soup.old_uv)
    p = Point_2(p.x() - 3, p.y() + 5);
  EXPECT_EQ(transfer_texture(soup, 8, source).pixels, image.pixels);
  source.textures[0].wrap_u = Texture_wrap::mirror;
  const Image mirrored = transfer_texture(soup, 8, source);
  EXPECT_EQ(mirrored.at(2, 3), image.at(5, 3));
  source.textures[0].wrap_u = source.textures[0].wrap_v = Texture_wrap::clamp;
  EXPECT_EQ(transfer_texture(soup, 8, source).pixels, std::vector<Color>(64, image.at(0, 0)));
}

TEST(Transfer_texture, colours_without_pictures_and_faces_without_textures)
{
  Source_textures source = textures_of(noise(4));
  source.textures[0].factor = {0, 1, 0};
  const Image green = transfer_texture(square(), 4, source);
  for (std::size_t i = 0; i < 16; ++i)
    EXPECT_EQ(green.pixels[i], (Color{0, noise(4).pixels[i][1], 0}));
  source.textures[0].image = Image();
  EXPECT_EQ(transfer_texture(square(), 4, source).pixels, std::vector<Color>(16, Color{0, 255, 0}));
  source.face_texture = {no_index};
  EXPECT_EQ(transfer_texture(square(), 4, source, 0, Execution(), {1, 2, 3}).pixels,
            std::vector<Color>(16, Color{1, 2, 3}));
  source = textures_of(noise(4));
  Polygon_soup soup = square();
  soup.old_uv.assign(4, Point_2(NAN, 0));
  EXPECT_EQ(transfer_texture(soup, 4, source).pixels, std::vector<Color>(16, Color{255, 255, 255}));
}

TEST(Read_textures, of_obj_ply_and_glb)
{
  const test::Temporary_folder folder;
  const Image image = noise(16);
  write_png(folder / "a b.png", image);
  Polygon_soup soup = square();
  write_obj(folder / "m.obj", soup, "a b.png");
  write_ply(folder / "m.ply", soup, "a b.png");
  write_glb(folder / "m.glb", soup, png_bytes(image));
  folder.write("50 % \xc3\xbc.png", png_bytes(image));
  folder.write("files.glb", glb_bytes(soup, {"50 % \xc3\xbc.png"}, Gltf_textures::files));
  for (const char* name : {"m.obj", "m.ply", "m.glb", "files.glb"}) {
    Polygon_soup back = read_polygon_soup(folder / name);
    const Source_textures source = read_textures(folder / name, back);
    back.old_uv = back.uv;
    EXPECT_EQ(transfer_texture(back, 16, source).pixels, image.pixels) << name;
  }
}

TEST(Read_textures, one_per_page)
{
  const test::Temporary_folder folder;
  Polygon_soup soup = square();
  soup.points.insert(soup.points.end(), soup.points.begin(), soup.points.end());
  soup.vertices = {0, 1, 2, 3, 4, 5, 6, 7};
  soup.first = {0, 4, 8};
  soup.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {1, 1}, {0, 1}};
  soup.face_page = {0, 1};
  const Image images[] = {noise(8, 1), noise(8, 2)};
  for (const Index page : {0, 1})
    write_png(folder / page_file_name("t.png", page, 2), images[page]);
  write_obj(folder / "udim.obj", soup, "t.png");
  write_obj(folder / "materials.obj", soup, "t.png", Page_style::materials);
  write_ply(folder / "m.ply", soup, "t.png");
  write_glb(folder / "m.glb", soup, std::vector<std::string>{png_bytes(images[0]), png_bytes(images[1])});
  for (const char* name : {"udim.obj", "materials.obj", "m.ply", "m.glb"}) {
    Polygon_soup back = read_polygon_soup(folder / name);
    const Source_textures source = read_textures(folder / name, back);
    back.old_uv = back.uv;
    if (std::string(name) == "udim.obj")
      separate_udim(back);
    back.face_page.assign(back.number_of_faces(), 0);
    std::fill(back.face_page.begin() + static_cast<std::ptrdiff_t>(back.number_of_faces() / 2),
              back.face_page.end(), 1);
    for (const Index page : {0, 1})
      EXPECT_EQ(transfer_texture(back, 8, source, page).pixels, images[page].pixels) << name << ' ' << page;
  }
}

TEST(Read_textures, what_mtl_files_say)
{
  const test::Temporary_folder folder;
  write_png(folder / "my tex.png", noise(4));
  folder.write("a.mtl", "# x\nnewmtl flat\nKd 0.25 0.5 1\nmap_Ka no.png\nnewmtl picture\nKd 0 0 0\n"
                        "map_Kd -s 2 2 -clamp on -mm 0 1 .\\my tex.png\n");
  const auto mesh = folder.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl flat\n"
                                          "f 1 2 3\nusemtl picture\nf 1 2 3\nusemtl nobody\nf 1 2 3\n");
  const Source_textures source = read_textures(mesh, read_polygon_soup(mesh));
  EXPECT_EQ(source.face_texture, (std::vector<Index>{no_index, 0, 1, no_index}));
  EXPECT_EQ(source.textures[0].factor, (std::array<double, 3>{.25, .5, 1}));
  EXPECT_TRUE(source.textures[0].image.pixels.empty());
  EXPECT_EQ(source.textures[1].image.pixels, noise(4).pixels);
  EXPECT_EQ(source.textures[1].factor, (std::array<double, 3>{1, 1, 1}));
  EXPECT_EQ(source.textures[1].wrap_v, Texture_wrap::clamp);

  EXPECT_EQ(source.textures[1].transform, (std::array<double, 6>{2, 0, 0, 0, 2, 0}));
  EXPECT_EQ(source.warnings, std::vector<std::string>{"no material library has the material 'nobody'"});
}

TEST(Read_textures, mtl_files_as_programs_write_them)
{
  const test::Temporary_folder folder;
  write_png(folder / "my tex.png", noise(4));
  const auto read = [&](const std::string& name, const std::string& mtl,
                        const std::string& library = "a.mtl") {
    folder.write("a.mtl", mtl);
    const auto mesh = folder.write("a.obj", "mtllib " + library + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl " +
                                                name + "\nf 1 2 3\n");
    return read_textures(mesh, read_polygon_soup(mesh));
  };
  for (const char* name : {"red", "RED", "\"red\"", "red # of the roof"})
    for (const char* mtl : {"newmtl red\nmap_Kd my tex.png\n", "NEWMTL \"red\"\nMAP_KD my tex.png # lost\n",
                            "newmtl Red # mine\nmap_kd ./my%20tex.png\n"}) {
      const Source_textures source = read(name, std::string(mtl) + "newmtl other\n", "a.mtl # all");
      ASSERT_EQ(source.face_texture, std::vector<Index>{0}) << name << ", " << mtl;
      EXPECT_EQ(source.textures[0].image.pixels, noise(4).pixels) << name << ", " << mtl;
      EXPECT_TRUE(source.warnings.empty()) << name << ", " << mtl;
    }
  for (const char* bad : {"Kd spectral a.rfl 1", "Kd xyz 1 1 1", "Kd 0,8 0,8 0,8", "Kd", "d", "Tr x"}) {
    const Source_textures source =
        read("m", std::string("newmtl m\nKd 1 0 0\n") + bad + "\nmap_Kd my tex.png\n");
    ASSERT_EQ(source.textures.size(), 1u) << bad;
    EXPECT_EQ(source.textures[0].image.pixels, noise(4).pixels) << bad;
    ASSERT_EQ(source.warnings.size(), 1u) << bad;
    EXPECT_EQ(source.warnings[0].find("a.mtl:3: "), 0u) << source.warnings[0];
  }
  for (const char* both : {"d 0.5\nTr 1", "Tr 1\nd 0.5", "Tr 0.5"}) // programs do not agree on Tr
    EXPECT_EQ(read("m", std::string("newmtl m\n") + both + "\n").textures[0].opacity, .5) << both;
}

TEST(Read_textures, a_library_that_is_not_there_or_no_text)
{
  const test::Temporary_folder folder;
  const auto mesh = folder.write("b.obj", "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
  folder.write("b.mtl", "newmtl m\nKd 1 0 0\n");
  const Source_textures renamed = read_textures(mesh, read_polygon_soup(mesh));
  EXPECT_EQ(renamed.face_texture, std::vector<Index>{0});
  EXPECT_EQ(renamed.warnings, (std::vector<std::string>{"there is no material library 'gone.mtl'",
                                                        "the material library 'b.mtl' takes its place"}));
  for (const std::string& bytes : {std::string(), std::string(60, '\2')}) {
    folder.write("gone.mtl", bytes);
    const Source_textures source = read_textures(mesh, read_polygon_soup(mesh));
    EXPECT_EQ(source.face_texture, std::vector<Index>{no_index});
    ASSERT_EQ(source.warnings.size(), 1u);
    EXPECT_NE(source.warnings[0].find("gone.mtl"), std::string::npos) << source.warnings[0];
  }
}

TEST(Read_textures, transparency_of_another_size_or_alone)
{
  const test::Temporary_folder folder;
  write_png(folder / "plain.png", Image(2, 2, {200, 100, 50}));
  Image mask(4, 4, {0, 0, 0});
  mask.at(3, 0) = {255, 255, 255};
  write_png(folder / "mask.png", mask);
  const auto mesh = folder.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
  std::vector<std::uint8_t> alpha(16, 0);
  alpha[3] = 255;
  folder.write("a.mtl", "newmtl m\nmap_Kd plain.png\nmap_d mask.png\n");
  const Image both = read_textures(mesh, read_polygon_soup(mesh)).textures[0].image;
  EXPECT_EQ(both.alpha, alpha);
  EXPECT_EQ(both.pixels, Image(4, 4, {200, 100, 50}).pixels);
  folder.write("a.mtl", "newmtl m\nKd 1 0 0.5\nmap_d mask.png\n");
  const Source_texture alone = read_textures(mesh, read_polygon_soup(mesh)).textures[0];
  EXPECT_EQ(alone.image.alpha, alpha);
  EXPECT_EQ(alone.image.pixels, Image(4, 4).pixels);
  EXPECT_EQ(alone.factor, (std::array<double, 3>{1, 0, .5}));
}

TEST(Read_textures, what_cannot_be_read_is_told_and_its_plain_colour_counts)
{
  const test::Temporary_folder folder;
  folder.write("a.mtl", "newmtl gone\nKd 0.25 0.5 1\nmap_Kd gone.png\nnewmtl broken\nmap_Kd broken.png\n"
                        "newmtl there\nmap_Kd there.png\n");
  folder.write("broken.png", "no picture");
  write_png(folder / "there.png", noise(4));
  const auto mesh =
      folder.write("a.obj", "mtllib a.mtl none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl gone\nf 1 2 3\n"
                            "usemtl broken\nf 1 2 3\nusemtl there\nf 1 2 3\n");
  const Source_textures source = read_textures(mesh, read_polygon_soup(mesh));
  EXPECT_EQ(source.face_texture, (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(source.textures[0].factor, (std::array<double, 3>{.25, .5, 1}));
  EXPECT_EQ(source.textures[2].image.pixels, noise(4).pixels);
  ASSERT_EQ(source.warnings.size(), 3u);
  EXPECT_EQ(source.warnings[0], "there is no material library 'none.mtl'");
  EXPECT_EQ(source.warnings[1], "there is no picture 'gone.png'");
  EXPECT_NE(source.warnings[2].find("not a picture"), std::string::npos);

  const auto alone = folder.write("b.obj", "mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
  EXPECT_EQ(read_textures(alone, read_polygon_soup(alone)).face_texture, std::vector<Index>{no_index});
}

TEST(Read_textures, names_of_files_as_programs_write_them)
{
  const test::Temporary_folder folder;
  std::filesystem::create_directories(folder / "sub");
  write_png(folder / "sub/my Tex.png", noise(4));
  folder.write("one two.mtl", "newmtl other\nKd 0 1 0\n");
  for (const char* name :
       {"sub/my Tex.png", "sub\\my Tex.png", "SUB/MY TEX.PNG", "\"sub/my Tex.png\"",
        "C:\\Users\\me\\sub\\my Tex.png", "/home/me/SUB/my tex.png", "./sub/../sub/my Tex.png"})
    for (const char* library :
         {"one two.mtl A.MTL", "a.mtl", "\"a.mtl\"", ".\\a.mtl one two.mtl", "a.mtl  one two.mtl"}) {
      folder.write("a.mtl", std::string("newmtl m\nmap_Kd ") + name + "\n");
      const auto mesh = folder.write("a.obj", std::string("mtllib ") + library +
                                                  "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
      const Source_textures source = read_textures(mesh, read_polygon_soup(mesh));
      EXPECT_TRUE(source.warnings.empty()) << name << ", " << library;
      ASSERT_EQ(source.textures.size(), 1u) << name << ", " << library;
      EXPECT_EQ(source.textures[0].image.pixels, noise(4).pixels) << name << ", " << library;
    }
  EXPECT_FALSE(internal::find_file(folder.path(), "none.png"));
  EXPECT_FALSE(internal::find_file(folder.path(), "sub"));
}

TEST(Read_textures, a_library_of_one_material_is_that_of_faces_without)
{
  const test::Temporary_folder folder;
  const auto mesh = folder.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.write("a.mtl", "newmtl one\nKd 1 0 0\n");
  EXPECT_EQ(read_textures(mesh, read_polygon_soup(mesh)).face_texture, std::vector<Index>{0});
  folder.write("a.mtl", "newmtl one\nKd 1 0 0\nnewmtl two\nKd 0 1 0\n");
  EXPECT_EQ(read_textures(mesh, read_polygon_soup(mesh)).face_texture, std::vector<Index>{no_index});
}

TEST(Transfer_texture, scale_and_offset_of_mtl)
{
  // Left half red, right half blue.
  Image halves(8, 8, {255, 0, 0});
  for (std::size_t y = 0; y < 8; ++y)
    for (std::size_t x = 4; x < 8; ++x)
      halves.at(x, y) = {0, 0, 255};
  const test::Temporary_folder folder;
  write_png(folder / "tex.png", halves);
  const auto baked = [&](const std::string& options) {
    folder.write("a.mtl", "newmtl m\nmap_Kd " + options + " tex.png\n");
    const auto mesh =
        folder.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 0.5 0\nvt 0.5 1\n"
                              "vt 0 1\nusemtl m\nf 1/1 2/2 3/3 4/4\n");
    Polygon_soup soup = read_polygon_soup(mesh);
    soup.old_uv = soup.uv;
    soup.uv = square().uv;
    const Image image = transfer_texture(soup, 16, read_textures(mesh, soup));
    return std::array<Color, 2>{image.at(4, 8), image.at(11, 8)};
  };
  const Color red{255, 0, 0}, blue{0, 0, 255};
  EXPECT_EQ(baked(""), (std::array<Color, 2>{red, red}));
  EXPECT_EQ(baked("-o 0.5 0 0"), (std::array<Color, 2>{blue, blue}));
  EXPECT_EQ(baked("-s 2 2 1"), (std::array<Color, 2>{red, blue}));
  EXPECT_EQ(baked("-s 2 1 -o 0.5"), (std::array<Color, 2>{blue, red}));
}

TEST(Transfer_texture, alpha_goes_along_and_what_cannot_be_seen_has_no_colour)
{
  // A white disc that is opaque, on black that is transparent.
  Image leaf(16, 16, {0, 0, 0});
  leaf.alpha.assign(256, 0);
  for (std::size_t i = 0; i < 256; ++i)
    if (const double x = double(i % 16) - 7.5, y = double(i / 16) - 7.5; x * x + y * y < 36) {
      leaf.pixels[i] = {255, 255, 255};
      leaf.alpha[i] = 255;
    }
  EXPECT_EQ(transfer_texture(square(), 16, textures_of(leaf)).alpha, leaf.alpha);
  for (const std::size_t size : {8u, 32u}) {
    const Image baked = transfer_texture(square(), size, textures_of(leaf));
    ASSERT_EQ(baked.alpha.size(), size * size);
    bool is_between = false;
    for (std::size_t i = 0; i < size * size; ++i) {
      is_between = is_between || (baked.alpha[i] > 0 && baked.alpha[i] < 255);
      EXPECT_EQ(baked.pixels[i], baked.alpha[i] > 0 ? (Color{255, 255, 255}) : (Color{0, 0, 0})) << i;
    }
    EXPECT_TRUE(is_between);
    EXPECT_EQ(decode_image(png_bytes(baked), "").alpha, baked.alpha);
  }
  Source_textures half = textures_of(noise(4));
  half.textures[0].opacity = 0.5;
  EXPECT_EQ(transfer_texture(square(), 4, half).alpha, std::vector<std::uint8_t>(16, 128));
  EXPECT_TRUE(transfer_texture(square(), 4, textures_of(noise(4))).alpha.empty());
}

TEST(Transfer_texture, factors_and_colours_of_vertices_multiply_light)
{
  Source_textures source = textures_of(Image(4, 4, {128, 128, 128}));
  Polygon_soup soup = square();
  soup.colors.assign(4, {.5f, .5f, .5f, 1});
  EXPECT_EQ(transfer_texture(soup, 4, source).pixels[0], (Color{128, 128, 128})); // as in OBJ files
  source.textures[0].multiplies_colors = true;
  // sRGB 0.5 is the light 0.214 (IEC 61966-2-1); the product 0.0462 is sRGB 0.238.
  EXPECT_EQ(transfer_texture(soup, 4, source).pixels[0], (Color{61, 61, 61}));
  source.textures[0].image = Image();
  source.textures[0].factor = {.5, 1, 0};
  EXPECT_EQ(transfer_texture(soup, 4, source).pixels[0], (Color{60, 128, 0}));
}

TEST(Read_textures, gltf_moves_coordinates)
{
  tinygltf::Value::Object transform;
  const auto pair = [](double x, double y) {
    return tinygltf::Value(tinygltf::Value::Array{tinygltf::Value(x), tinygltf::Value(y)});
  };
  transform["offset"] = pair(.25, .5);
  transform["scale"] = pair(2, 3);
  const auto moved = [&](double u, double v, double angle) { // v upwards
    transform["rotation"] = tinygltf::Value(angle);
    Source_texture texture;
    texture.transform = internal::texture_transform(tinygltf::Value(transform));
    return texture.transformed(Point_2(u, v));
  };
  const auto expect_near = [](const Point_2& p, double u, double v) {
    EXPECT_NEAR(p.x(), u, 1e-12);
    EXPECT_NEAR(p.y(), v, 1e-12);
  };
  // In the coordinates of glTF: (u, w) -> (2 u + .25, 3 w + .5), w = 1 - v.
  expect_near(moved(.5, 1, 0), 1.25, .5);
  expect_near(moved(.5, 0, 0), 1.25, 1 - 3.5);
  // A quarter turn counterclockwise takes the u axis, seen with w downwards, to the upward one.
  expect_near(moved(.5, 1, M_PI / 2), .25, 1 - (-1 + .5));
}

TEST(Read_image, jpeg_and_what_is_no_picture)
{
  const Image image = decode_image(bytes_of_hex(jpeg_hex), "a.jpg");
  ASSERT_EQ(image.width, 8u);
  for (const Color& color : image.pixels)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(color[k], (Color{200, 100, 50})[k], 3);
  try {
    decode_image("GIF89a", "b.gif");
    FAIL();
  } catch (const IO_error& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, 7), "b.gif: ");
  }
}
