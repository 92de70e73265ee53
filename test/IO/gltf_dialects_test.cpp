// SPDX-License-Identifier: MIT
// glTF as older programs and careless ones write it.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/core/errors.h>
#include <Atlas/image/Image.h>

#include "gltf_builder.h"
#include "temporary_folder.h"
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

using namespace Atlas;

namespace {

using Json = nlohmann::json;
using test::Builder;

/// A square with two sets of coordinates, of which a material shows the second.
Builder square_scene()
{
  Builder b;
  b.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, 3, 5126, "VEC3");
  b.add<float>({.5, .5, .5, .5, .5, .5, .5, .5}, 2, 5126, "VEC2");
  b.add<float>({0, 1, 1, 1, 1, 0, 0, 0}, 2, 5126, "VEC2");
  b.add<std::uint16_t>({0, 1, 2, 0, 2, 3}, 1, 5123, "SCALAR");
  b.json.update(Json::parse(R"({
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1, "TEXCOORD_1": 2}, "indices": 3,
                                "material": 0}]}],
    "nodes": [{"mesh": 0}],
    "scenes": [{"nodes": [0]}],
    "images": [{"uri": "tex.png"}],
    "textures": [{"source": 0}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1}}}]
  })"));
  return b;
}

const char* const old_extension = "KHR_materials_pbrSpecularGlossiness";

std::string error_of(const std::filesystem::path& path)
{
  try {
    read_polygon_soup(path);
  } catch (const IO_error& error) {
    return std::string(error.what()).substr(path.string().size());
  }
  return "no error";
}

} // namespace

TEST(Gltf_dialects, diffuse_colours_of_the_extension_before_roughness)
{
  const test::Temporary_folder folder;
  write_png(folder / "tex.png", Image(2, 2, {255, 0, 0}));
  Builder b = square_scene();
  b.json["extensionsUsed"] = {old_extension};
  Json& material = b.json["materials"][0];
  material = {{"extensions",
               {{old_extension,
                 {{"diffuseTexture", {{"index", 0}, {"texCoord", 1}}}, {"diffuseFactor", {1, .5, 1, .25}}}}}},
              {"alphaMode", "BLEND"}};
  const auto path = folder.write("a.gltf", b.text());
  const Polygon_soup soup = read_polygon_soup(path);
  EXPECT_EQ(soup.uv[1], Point_2(1, 0));
  const Source_textures source = read_textures(path, soup);
  EXPECT_EQ(source.textures[0].image.pixels, std::vector<Color>(4, Color{255, 0, 0}));
  EXPECT_NEAR(source.textures[0].factor[1], .735, .001); // as sRGB
  EXPECT_EQ(source.textures[0].opacity, .25);

  // A base colour of the core prevails.
  material["pbrMetallicRoughness"]["baseColorFactor"] = {0, 0, 1, 1};
  const auto both = folder.write("b.gltf", b.text());
  EXPECT_EQ(read_textures(both, soup).textures[0].factor, (std::array<double, 3>{0, 0, 1}));

  // A bake takes the place of both, for programs of either kind.
  Gltf_changes changes;
  changes.base_color_png = png_bytes(Image(2, 2, {0, 255, 0}));
  changes.has_base_factors = true;
  const std::string glb = glb_bytes(path, soup, changes);
  const Json out = Json::parse(glb.substr(20, glb.find("BIN", 20) - 24));
  const Json expected = {{"index", 1}};
  EXPECT_EQ(out["materials"][0]["extensions"][old_extension], (Json{{"diffuseTexture", expected}}));
  EXPECT_EQ(out["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"], expected);
}

TEST(Gltf_dialects, numbers_of_sets_with_a_point)
{
  const test::Temporary_folder folder;
  Builder b = square_scene();
  Json& texture = b.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  texture["texCoord"] = 0;
  texture["extensions"]["KHR_texture_transform"]["texCoord"] = 1.0;
  EXPECT_EQ(read_polygon_soup(folder.write("a.gltf", b.text())).uv[1], Point_2(1, 0));
}

TEST(Gltf_dialects, names_of_files_as_in_mtl)
{
  const test::Temporary_folder folder;
  std::filesystem::create_directories(folder / "sub");
  write_png(folder / "sub/my Tex.png", Image(2, 2, {255, 0, 0}));
  for (const char* name :
       {"sub/my%20Tex.png", "SUB/MY TEX.PNG", ".\\sub\\my Tex.png", "C:\\Users\\me\\sub\\my Tex.png"}) {
    Builder b = square_scene();
    b.json["images"][0]["uri"] = name;
    b.text(); // to have the bytes
    folder.write("Data 1.bin", b.data);
    b.json["buffers"] = {{{"byteLength", b.data.size()}, {"uri", "data%201.BIN"}}};
    const auto path = folder.write("a.gltf", b.json.dump());
    const Source_textures source = read_textures(path, read_polygon_soup(path));
    EXPECT_TRUE(source.warnings.empty()) << name;
    EXPECT_EQ(source.textures[0].image.pixels, std::vector<Color>(4, Color{255, 0, 0})) << name;
  }
}

TEST(Gltf_dialects, text_in_utf16)
{
  const test::Temporary_folder folder;
  std::string wide = "\xFF\xFE";
  for (const char c : square_scene().text())
    wide += {c, '\0'};
  EXPECT_EQ(read_polygon_soup(folder.write("a.gltf", wide)).number_of_faces(), 2u);
}

TEST(Gltf_dialects, version_1_and_files_that_are_cut_off_are_called_so)
{
  const test::Temporary_folder folder;
  const std::string of_version_1 = ": glTF 1.0, of which nothing is read; write it as glTF 2.0";
  EXPECT_EQ(error_of(folder.write("a.gltf", R"({"asset": {"version": "1.0"}, "meshes": {"m": {}}})")),
            of_version_1);
  EXPECT_EQ(error_of(folder.write("a.gltf", R"({"meshes": {"m": {}}})")), of_version_1);
  EXPECT_EQ(error_of(folder.write("a.glb", std::string("glTF\1\0\0\0\x18\0\0\0\4\0\0\0\0\0\0\0{}  ", 24))),
            of_version_1);
  Builder b = square_scene();
  const auto path = folder.write("b.gltf", b.text());
  const std::string glb = glb_bytes(path, read_polygon_soup(path));
  EXPECT_EQ(error_of(folder.write("b.glb", glb.substr(0, 100))),
            ": the file ends after 100 of its " + std::to_string(glb.size()) + " bytes");
}

TEST(Gltf_dialects, what_is_broken_where_nothing_shows_it_does_not_count)
{
  const test::Temporary_folder folder;
  Builder b = square_scene();
  b.add<std::uint16_t>({0, 1, 2, 7, 1, 2, 0, 2, 3}, 1, 5123, "SCALAR");
  b.json["meshes"][0]["primitives"][0]["indices"] = 4; // the second triangle names a vertex that is not there
  b.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 100000}, {"byteLength", 8}});
  b.json["accessors"].push_back({{"bufferView", 5}, {"componentType", 5126}, {"count", 1}, {"type", "VEC2"}});
  const auto path = folder.write("a.gltf", b.text());
  const Polygon_soup soup = read_polygon_soup(path);
  ASSERT_EQ(soup.number_of_faces(), 3u);
  const Polygon_soup back = read_polygon_soup(folder.write("b.glb", glb_bytes(path, soup)));
  EXPECT_EQ(back.vertices, (std::vector<Index>{0, 1, 2, 0, 2, 3}));

  b.json["animations"] = {{{"samplers", {{{"input", 5}, {"output", 5}}}}, {"channels", Json::array()}}};
  const auto used = folder.write("c.gltf", b.text());
  EXPECT_THROW(glb_bytes(used, read_polygon_soup(used)), IO_error);
}
