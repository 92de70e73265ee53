// SPDX-License-Identifier: MIT
// A glTF document with new coordinates is the same document in all else.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/core/errors.h>
#include <Atlas/image/Image.h>

#include "gltf_builder.h"
#include "temporary_folder.h"
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <tiny_gltf.h>
#include <utility>
#include <vector>

using namespace Atlas;

namespace {

using Json = nlohmann::json;

using test::Builder;

/// A quad of two triangles that two nodes show, one of them mirrored; with a skin, a morph target, an
/// animation, a camera, extras, a material with three textures, and a line that is no business of an atlas.
Builder rich_scene()
{
  Builder b;
  Json attributes = {
      {"POSITION", b.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, 3, 5126, "VEC3")},
      {"TEXCOORD_0", b.add<float>({0, 1, 1, 1, 1, 0, 0, 0}, 2, 5126, "VEC2")},
      {"TEXCOORD_1", b.add<std::uint16_t>({0, 0, 9, 0, 9, 9, 0, 9}, 2, 5123, "VEC2")},
      {"COLOR_0",
       b.add<std::uint8_t>({9, 8, 7, 255, 6, 5, 4, 255, 3, 2, 1, 255, 0, 9, 8, 255}, 4, 5121, "VEC4")},
      {"JOINTS_0", b.add<std::uint8_t>({0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0}, 4, 5121, "VEC4")},
      {"WEIGHTS_0", b.add<float>({1, 0, 0, 0, .5, .5, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, 4, 5126, "VEC4")}};
  b.json["accessors"][2]["normalized"] = b.json["accessors"][3]["normalized"] = true;
  b.json["accessors"][0]["min"] = {0, 0, 0};
  b.json["accessors"][0]["max"] = {1, 1, 0};
  const std::size_t shift = b.add<float>({0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4}, 3, 5126, "VEC3"),
                    indices = b.add<std::uint16_t>({0, 1, 2, 0, 2, 3}, 1, 5123, "SCALAR"),
                    matrices = b.add<float>(std::vector<float>(32, 0.5f), 16, 5126, "MAT4"),
                    times = b.add<float>({0, 1}, 1, 5126, "SCALAR"),
                    moves = b.add<float>({0, 0, 0, 1, 2, 3}, 3, 5126, "VEC3");
  b.json.update(Json::parse(R"({
    "meshes": [{"name": "quad", "weights": [0.25], "extras": {"targetNames": ["up"]},
                "primitives": [{"material": 0, "targets": [{}]}, {"attributes": {}, "mode": 1}]}],
    "nodes": [{"name": "root", "children": [1, 2, 3, 4], "extras": {"id": 7}},
              {"name": "left", "mesh": 0, "skin": 0},
              {"name": "right", "mesh": 0, "translation": [5, 0, 0], "scale": [-1, 1, 1]},
              {"name": "bone", "extensions": {"EXT_unknown": {"a": 1}}},
              {"name": "eye", "camera": 0}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}],
    "skins": [{"joints": [3, 0]}],
    "animations": [{"channels": [{"sampler": 0, "target": {"node": 3, "path": "translation"}}], "samplers": [{}]}],
    "scenes": [{"nodes": [0]}],
    "extensionsUsed": ["EXT_unknown", "KHR_texture_transform"],
    "extensionsRequired": ["EXT_unknown"],
    "images": [{"uri": "tex.png"}],
    "textures": [{"source": 0}],
    "materials": [{"name": "skin", "alphaMode": "MASK", "emissiveFactor": [0, 0, 1],
                   "normalTexture": {"index": 0, "texCoord": 1},
                   "occlusionTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"texCoord": 1}}},
                   "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "baseColorFactor": [1, 0.5, 0.5, 1],
                                            "roughnessFactor": 0.25}}]
  })"));
  Json& primitives = b.json["meshes"][0]["primitives"];
  primitives[0]["attributes"] = attributes;
  primitives[0]["indices"] = indices;
  primitives[0]["targets"][0]["POSITION"] = shift;
  primitives[1]["attributes"]["POSITION"] = attributes["POSITION"];
  b.json["skins"][0]["inverseBindMatrices"] = matrices;
  b.json["animations"][0]["samplers"][0]["input"] = times;
  b.json["animations"][0]["samplers"][0]["output"] = moves;
  return b;
}

/// A document as written, and its bytes.
struct Written
{
  Json json;
  tinygltf::Model model;

  explicit Written(const std::string& glb)
  {
    std::uint32_t length = 0;
    std::memcpy(&length, &glb[12], sizeof length);
    json = Json::parse(glb.substr(20, length));
    tinygltf::TinyGLTF loader;
    std::string error, warning;
    EXPECT_TRUE(loader.LoadBinaryFromMemory(&model, &error, &warning,
                                            reinterpret_cast<const unsigned char*>(glb.data()),
                                            static_cast<unsigned>(glb.size()), ""))
        << error;
  }

  /// The bytes of an accessor's rows.
  std::vector<std::string> rows(const Json& accessor) const
  {
    const tinygltf::Accessor& a = model.accessors[accessor.get<std::size_t>()];
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(a.bufferView)];
    const auto width =
        static_cast<std::size_t>(tinygltf::GetNumComponentsInType(std::uint32_t(a.type)) *
                                 tinygltf::GetComponentSizeInBytes(std::uint32_t(a.componentType)));
    std::vector<std::string> result;
    for (std::size_t i = 0; i < a.count; ++i) {
      const auto begin = model.buffers[0].data.begin() +
                         std::ptrdiff_t(view.byteOffset + a.byteOffset + i * std::size_t(a.ByteStride(view)));
      result.emplace_back(begin, begin + std::ptrdiff_t(width));
    }
    return result;
  }
};

/// New coordinates for both quads: the triangles of the first are cut apart, those of the second hang
/// together.
void give_coordinates(Polygon_soup& soup)
{
  soup.uv = {{0, 0},  {.5, 0},   {.5, .5},   {.5, .5}, {1, 1},     {.5, 1},
             {0, .5}, {.25, .5}, {.25, .75}, {0, .5},  {.25, .75}, {0, .75}};
  for (const std::size_t f : {2, 3}) // of the mirrored node
    std::swap(soup.uv[3 * f + 1], soup.uv[3 * f + 2]);
}

} // namespace

TEST(Rewrite_gltf, all_but_the_coordinates_stays)
{
  const test::Temporary_folder folder;
  Builder b = rich_scene();
  write_png(folder / "tex.png", Image(4, 4, {255, 0, 0}));
  const auto path = folder.write("a.gltf", b.text());
  Polygon_soup soup = read_polygon_soup(path);
  ASSERT_EQ(soup.number_of_faces(), 4u);
  EXPECT_EQ(soup.warnings.size(), 1u);
  give_coordinates(soup);
  const Written out(glb_bytes(path, soup));
  for (const char* key :
       {"nodes", "skins", "animations", "cameras", "scenes", "extensionsUsed", "extensionsRequired"}) {
    Json expected = b.json[key];
    if (std::string(key) == "nodes")
      expected[2]["mesh"] = 1; // it has coordinates of its own
    EXPECT_EQ(out.json[key], expected) << key;
  }
  Json material = b.json["materials"][0]; // textures show the sets that they did
  material["normalTexture"]["texCoord"] = 2;
  material["occlusionTexture"]["texCoord"] = 1;
  material["occlusionTexture"]["extensions"]["KHR_texture_transform"]["texCoord"] = 2;
  material["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 1;
  EXPECT_EQ(out.json["materials"][0], material);
  EXPECT_EQ(out.json["images"][0]["mimeType"], "image/png");
  EXPECT_EQ(out.model.images[0].width, 4);

  const Json& cut = out.json["meshes"][0]["primitives"][0];
  EXPECT_EQ(out.json["meshes"][0]["name"], "quad");
  EXPECT_EQ(out.json["meshes"][0]["weights"], b.json["meshes"][0]["weights"]);
  EXPECT_EQ(out.json["meshes"][0]["extras"], b.json["meshes"][0]["extras"]);
  EXPECT_EQ(out.json["meshes"][0]["primitives"][1], b.json["meshes"][0]["primitives"][1]);
  for (const auto& [name, accessor] : cut["attributes"].items()) {
    const auto rows = out.rows(accessor);
    ASSERT_EQ(rows.size(), 6u) << name; // the corners 0 and 2 are there twice
    if (name != "TEXCOORD_0") {
      EXPECT_EQ(rows[4], rows[0]) << name;
      EXPECT_EQ(rows[5], rows[2]) << name;
    }
  }
  EXPECT_EQ(out.rows(cut["targets"][0]["POSITION"]).size(), 6u);
  EXPECT_EQ(out.rows(cut["attributes"]["JOINTS_0"])[3], std::string("\1\1\0\0", 4));
  EXPECT_TRUE(cut["attributes"].contains("TEXCOORD_2"));
  EXPECT_EQ(out.model.accessors[cut["attributes"]["TEXCOORD_2"].get<std::size_t>()].componentType, 5123);
  const Json& whole = out.json["meshes"][1]["primitives"][0];
  EXPECT_EQ(whole["indices"],
            b.json["meshes"][0]["primitives"][0]["indices"]); // nothing to split, nothing to change
  EXPECT_EQ(whole["attributes"]["POSITION"], b.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"]);
}

TEST(Rewrite_gltf, comes_back_with_the_coordinates_in_any_set)
{
  const test::Temporary_folder folder;
  Builder b = rich_scene();
  const auto path = folder.write("a.gltf", b.text());
  Polygon_soup soup = read_polygon_soup(path);
  give_coordinates(soup);
  for (const int set : {0, 1, 2, 4}) {
    Gltf_changes changes;
    changes.uv_set = set;
    changes.base_color_png = png_bytes(Image(2, 2, {0, 255, 0}));
    changes.has_base_factors = true;
    folder.write("b.glb", glb_bytes(path, soup, changes));
    const Polygon_soup back = read_polygon_soup(folder / "b.glb");
    ASSERT_EQ(back.first, soup.first);
    EXPECT_EQ(back.uv, soup.uv) << set;
    EXPECT_TRUE(back.colors.empty());
    for (std::size_t c = 0; c < soup.number_of_corners(); ++c)
      EXPECT_EQ(back.points[back.vertices[c]], soup.points[soup.vertices[c]]);
    const Source_textures textures = read_textures(folder / "b.glb", back);
    EXPECT_EQ(textures.textures[0].image.pixels, std::vector<Color>(4, Color{0, 255, 0}));
    EXPECT_EQ(textures.textures[0].factor, (std::array<double, 3>{1, 1, 1}));
    const Written out(test::bytes_of(folder / "b.glb"));
    EXPECT_EQ(out.json["materials"][0]["alphaMode"], "MASK");
    EXPECT_EQ(out.json["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"], .25);
    for (int n = 0; n <= std::max(set, 2); ++n)
      EXPECT_TRUE(
          out.json["meshes"][0]["primitives"][0]["attributes"].contains("TEXCOORD_" + std::to_string(n)));
  }
}

TEST(Rewrite_gltf, nodes_with_the_same_coordinates_share_their_mesh)
{
  const test::Temporary_folder folder;
  Builder b = rich_scene();
  b.json["nodes"][2].erase("scale");
  const auto path = folder.write("a.gltf", b.text());
  Polygon_soup soup = read_polygon_soup(path);
  soup.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
  const Written out(glb_bytes(path, soup));
  EXPECT_EQ(out.json["meshes"].size(), 1u);
  EXPECT_EQ(out.json["nodes"], b.json["nodes"]);
}

TEST(Rewrite_gltf, strips_and_primitives_without_indices_or_material)
{
  const test::Temporary_folder folder;
  Builder b;
  b.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, 3, 5126, "VEC3");
  b.json["accessors"][0]["min"] = {0, 0, 0};
  b.json["accessors"][0]["max"] = {1, 1, 0};
  b.json.update(Json::parse(R"({"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 5}]}],
                                "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}]})"));
  const auto path = folder.write("a.gltf", b.text());
  Polygon_soup soup = read_polygon_soup(path);
  soup.uv.assign(6, Point_2(0, 0));
  for (std::size_t c = 0; c < 6; ++c)
    soup.uv[c] = Point_2(soup.points[soup.vertices[c]].x(), soup.points[soup.vertices[c]].y());
  Gltf_changes changes;
  changes.base_color_png = png_bytes(Image(2, 2, {0, 255, 0}));
  folder.write("b.glb", glb_bytes(path, soup, changes));
  const Polygon_soup back = read_polygon_soup(folder / "b.glb");
  EXPECT_EQ(back.uv, soup.uv);
  EXPECT_EQ(back.vertices, soup.vertices);
  EXPECT_EQ(back.material_names, std::vector<std::string>{default_material_name});
  soup.close_face();
  EXPECT_THROW(glb_bytes(path, soup), Invalid_argument);
}

TEST(Read_gltf, extensions_that_do_not_touch_geometry_are_passed_over)
{
  const test::Temporary_folder folder;
  for (const char* name : {"EXT_texture_webp", "KHR_lights_punctual", "VRMC_vrm"}) {
    Builder b = rich_scene();
    b.json["extensionsRequired"] = {name};
    const Polygon_soup soup = read_polygon_soup(folder.write("a.gltf", b.text()));
    EXPECT_EQ(soup.number_of_faces(), 4u);
    EXPECT_EQ(soup.warnings,
              std::vector<std::string>{std::string("the file requires ") + name + ", which is passed over"});
  }
}

TEST(Read_gltf, coordinates_of_any_set_and_of_texture_transforms)
{
  const test::Temporary_folder folder;
  for (const int set : {0, 2}) {
    Builder b = rich_scene();
    Json& primitive = b.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_2"] = b.add<float>({.5, .5, .5, .5, .5, .5, .5, .5}, 2, 5126, "VEC2");
    Json& texture = b.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    texture["texCoord"] = set;
    EXPECT_EQ(read_polygon_soup(folder.write("a.gltf", b.text())).uv[0],
              set == 2 ? Point_2(.5, .5) : Point_2(0, 0));
    texture["texCoord"] = 2 - set; // overridden
    texture["extensions"]["KHR_texture_transform"]["texCoord"] = set;
    EXPECT_EQ(read_polygon_soup(folder.write("a.gltf", b.text())).uv[0],
              set == 2 ? Point_2(.5, .5) : Point_2(0, 0));
  }
}
