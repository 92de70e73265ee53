// SPDX-License-Identifier: MIT
// glTF files whose numbers are compressed say the same as those that are not.
#include <Atlas/IO/internal/gltf_codecs.h>
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/core/errors.h>

#include "gltf_builder.h"
#include "temporary_folder.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <gtest/gtest.h>
#include <memory>
#include <meshoptimizer.h>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

using namespace Atlas;

namespace {

using Json = nlohmann::json;
using test::Builder;

constexpr std::size_t side = 9; ///< vertices of a grid, 81 in all
constexpr std::size_t vertices = side * side;

/// A bent grid: x, y in [0, 1], z = x y.
std::vector<float> positions()
{
  std::vector<float> result;
  for (std::size_t i = 0; i < vertices; ++i) {
    const float x = static_cast<float>(i % side) / (side - 1), y = static_cast<float>(i / side) / (side - 1);
    result.insert(result.end(), {x, y, x * y});
  }
  return result;
}

std::vector<std::uint32_t> triangles()
{
  std::vector<std::uint32_t> result;
  const auto n = static_cast<std::uint32_t>(side);
  for (std::uint32_t y = 0; y + 1 < n; ++y)
    for (std::uint32_t x = 0; x + 1 < n; ++x) {
      const std::uint32_t a = y * n + x, b = a + 1, c = a + n, d = c + 1;
      result.insert(result.end(), {a, b, d, a, d, c});
    }
  return result;
}

Builder scene(const char* extension)
{
  Builder b;
  b.json.update(Json::parse(R"({"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
                                "nodes": [{"mesh": 0, "name": "grid"}], "scenes": [{"nodes": [0]}]})"));
  b.json["extensionsUsed"] = {extension};
  b.json["extensionsRequired"] = {extension};
  return b;
}

/// The grid as it is read, each corner within so much of where it was; triangles may begin elsewhere.
void expect_grid(const Polygon_soup& soup, double tolerance)
{
  const auto indices = triangles();
  const auto p = positions();
  ASSERT_EQ(soup.number_of_faces(), indices.size() / 3);
  EXPECT_EQ(soup.group_names, std::vector<std::string>{"grid"});
  EXPECT_TRUE(soup.warnings.empty());
  double volume = 0; // of the columns below the faces: faces are all there, once, and the right way around
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    const Point_3 &a = soup.points[soup.face(f)[0]], &b = soup.points[soup.face(f)[1]],
                  &c = soup.points[soup.face(f)[2]];
    volume +=
        ((b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x())) * (a.z() + b.z() + c.z()) / 6;
    for (const Point_3& q : {a, b, c}) {
      EXPECT_NEAR(q.z(), q.x() * q.y(), 3 * tolerance);
      EXPECT_NEAR(q.x() * (side - 1), std::round(q.x() * (side - 1)), (side - 1) * tolerance);
    }
  }
  double expected = 0;
  for (std::size_t i = 0; i < indices.size(); i += 3)
    expected += (p[3 * indices[i] + 2] + p[3 * indices[i + 1] + 2] + p[3 * indices[i + 2] + 2]) /
                (6 * double(side - 1) * (side - 1));
  EXPECT_NEAR(volume, expected, 4 * tolerance);
}

std::string compressed_by_draco()
{
  draco::Mesh mesh;
  mesh.set_num_points(vertices);
  draco::GeometryAttribute attribute;
  attribute.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
  const int id = mesh.AddAttribute(attribute, true, vertices);
  const auto p = positions();
  for (std::uint32_t i = 0; i < vertices; ++i)
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &p[3 * i]);
  const auto indices = triangles();
  for (std::size_t i = 0; i < indices.size(); i += 3)
    mesh.AddFace({draco::PointIndex(indices[i]), draco::PointIndex(indices[i + 1]),
                  draco::PointIndex(indices[i + 2])});
  draco::Encoder encoder;
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
  return std::string(buffer.data(), buffer.size());
}

Builder draco_scene(const std::string& bytes)
{
  Builder b = scene("KHR_draco_mesh_compression");
  b.json["accessors"] = {{{"componentType", 5126}, {"count", vertices}, {"type", "VEC3"}},
                         {{"componentType", 5123}, {"count", triangles().size()}, {"type", "SCALAR"}}};
  b.json["bufferViews"] = {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", bytes.size()}}};
  b.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
  b.data = bytes;
  return b;
}

/// Adds a view that stands for rows of a second buffer, which has no bytes.
void add_compressed_view(Builder& b, const std::string& bytes, std::size_t count, std::size_t stride,
                         const Json& more)
{
  Json compressed = {{"buffer", 0},
                     {"byteOffset", b.data.size()},
                     {"byteLength", bytes.size()},
                     {"byteStride", stride},
                     {"count", count}};
  compressed.update(more);
  b.data += bytes;
  b.json["bufferViews"].push_back({{"buffer", 1},
                                   {"byteLength", count * stride},
                                   {"extensions", {{"EXT_meshopt_compression", compressed}}}});
}

std::string text_with_fallback(Builder& b)
{
  Json json = Json::parse(b.text());
  json["buffers"].push_back(
      {{"byteLength", 1 << 20}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  return json.dump();
}

template <typename Encode>
std::string encoded(std::size_t bound, const Encode& encode)
{
  std::string bytes(bound, '\0');
  bytes.resize(encode(reinterpret_cast<unsigned char*>(bytes.data()), bound));
  return bytes;
}

/// With positions of 16 bits, to be scaled by their node, and indices of either mode.
Builder meshopt_scene(const char* mode)
{
  Builder b = scene("EXT_meshopt_compression");
  b.json["extensionsRequired"].push_back("KHR_mesh_quantization");
  b.json["nodes"][0]["scale"] = {2, 2, 2};
  std::vector<std::uint16_t> rows;
  const auto p = positions();
  for (std::size_t i = 0; i < vertices; ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      rows.push_back(static_cast<std::uint16_t>(std::lround(p[3 * i + k] / 2 * 65535)));
    rows.push_back(0); // rows of four bytes
  }
  add_compressed_view(b,
                      encoded(meshopt_encodeVertexBufferBound(vertices, 8),
                              [&](unsigned char* at, std::size_t n) {
                                return meshopt_encodeVertexBuffer(at, n, rows.data(), vertices, 8);
                              }),
                      vertices, 8, {{"mode", "ATTRIBUTES"}});
  b.json["bufferViews"][0]["byteStride"] = 8;
  const auto indices = triangles();
  const bool is_list = std::string(mode) == "TRIANGLES";
  meshopt_encodeIndexVersion(1);
  add_compressed_view(
      b,
      encoded(100000,
              [&](unsigned char* at, std::size_t n) {
                return is_list ? meshopt_encodeIndexBuffer(at, n, indices.data(), indices.size())
                               : meshopt_encodeIndexSequence(at, n, indices.data(), indices.size());
              }),
      indices.size(), 4, {{"mode", mode}});
  b.json["accessors"] = {
      {{"bufferView", 0},
       {"componentType", 5123},
       {"normalized", true},
       {"count", vertices},
       {"type", "VEC3"}},
      {{"bufferView", 1}, {"componentType", 5125}, {"count", indices.size()}, {"type", "SCALAR"}}};
  return b;
}

/// The same document with new coordinates: nothing in it is compressed or says so.
void expect_rewritten(const test::Temporary_folder& folder, const std::filesystem::path& path,
                      double tolerance)
{
  Polygon_soup soup = read_polygon_soup(path);
  for (const Index v : soup.vertices)
    soup.uv.emplace_back(soup.points[v].x(), soup.points[v].y());
  const std::string bytes = glb_bytes(path, soup);
  EXPECT_EQ(bytes.find("_compression"), std::string::npos);
  const Polygon_soup back = read_polygon_soup(folder.write("back.glb", bytes));
  expect_grid(back, tolerance);
  ASSERT_EQ(back.uv.size(), back.vertices.size());
  for (std::size_t c = 0; c < back.uv.size(); ++c)
    EXPECT_NEAR(back.uv[c].x(), back.points[back.vertices[c]].x(), 1e-6);
}

TEST(Compressed_gltf, draco)
{
  const test::Temporary_folder folder;
  const auto path = folder.write("a.gltf", draco_scene(compressed_by_draco()).text());
  expect_grid(read_polygon_soup(path), 1e-4);
  expect_rewritten(folder, path, 1e-4);
}

TEST(Compressed_gltf, bounds_are_those_of_the_numbers_that_draco_gives)
{
  const test::Temporary_folder folder;
  Builder b = draco_scene(compressed_by_draco());
  b.json["accessors"][0]["min"] = {-.01, -.01, -.01};
  b.json["accessors"][0]["max"] = {1.01, 1.01, 1.01};
  const auto path = folder.write("a.gltf", b.text());
  Polygon_soup soup = read_polygon_soup(path);
  soup.uv.assign(soup.number_of_corners(), Point_2(0, 0));
  const std::string glb = glb_bytes(path, soup);
  const Json json = Json::parse(glb.substr(20, glb.find("BIN", 20) - 24));
  const Json& accessor =
      json["accessors"][json["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
  for (int k = 0; k < 3; ++k) {
    double low = 1, high = 0;
    for (const Point_3& p : soup.points) {
      low = std::min(low, p[k]);
      high = std::max(high, p[k]);
    }
    EXPECT_EQ(accessor["min"][std::size_t(k)].get<double>(), low);
    EXPECT_EQ(accessor["max"][std::size_t(k)].get<double>(), high);
  }
}

TEST(Compressed_gltf, meshopt)
{
  const test::Temporary_folder folder;
  for (const char* mode : {"TRIANGLES", "INDICES"}) {
    Builder b = meshopt_scene(mode);
    const auto path = folder.write("a.gltf", text_with_fallback(b));
    expect_grid(read_polygon_soup(path), 1e-4);
    expect_rewritten(folder, path, 1e-4);
  }
}

TEST(Compressed_gltf, filters_of_meshopt)
{
  const float normals[] = {.6f, 0, .8f, 0, 0, -.6f, -.8f, 0, 1, 0, 0, 0, .48f, .6f, .64f, 0};
  std::array<std::int8_t, 16> packed{};
  meshopt_encodeFilterOct(packed.data(), 4, 4, 8, normals);
  const std::string bytes =
      encoded(meshopt_encodeVertexBufferBound(4, 4), [&](unsigned char* at, std::size_t n) {
        return meshopt_encodeVertexBuffer(at, n, packed.data(), 4, 4);
      });
  const auto rows = internal::decode_meshopt(bytes, {4, 4, "ATTRIBUTES", "OCTAHEDRAL"});
  ASSERT_TRUE(rows);
  for (std::size_t i = 0; i < 16; ++i)
    EXPECT_NEAR(static_cast<signed char>((*rows)[i]) / 127.0, normals[i], .02) << i;
  EXPECT_FALSE(internal::decode_meshopt(bytes, {4, 4, "ATTRIBUTES", "COLOR"}));
  EXPECT_FALSE(internal::decode_meshopt(bytes, {4, 3, "ATTRIBUTES", "NONE"}));
  EXPECT_FALSE(internal::decode_meshopt(bytes, {4, 4, "ATTRIBUTES", "QUATERNION"}));
  EXPECT_FALSE(internal::decode_meshopt(bytes, {std::size_t(1) << 40, 4, "ATTRIBUTES", "NONE"}));
  EXPECT_FALSE(internal::decode_meshopt(bytes.substr(0, 3), {4, 4, "ATTRIBUTES", "NONE"}));
}

TEST(Compressed_gltf, what_is_broken_is_an_error_that_names_the_extension)
{
  const test::Temporary_folder folder;
  const auto error_of = [&](const std::string& text) {
    try {
      read_polygon_soup(folder.write("a.gltf", text));
    } catch (const IO_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string bytes = compressed_by_draco();
  EXPECT_NE(
      error_of(draco_scene(bytes.substr(0, bytes.size() / 2)).text()).find("KHR_draco_mesh_compression"),
      std::string::npos);
  Builder other_width = draco_scene(bytes);
  other_width.json["accessors"][0]["type"] = "VEC2";
  EXPECT_NE(error_of(other_width.text()).find("KHR_draco_mesh_compression"), std::string::npos);
  Builder b = meshopt_scene("TRIANGLES");
  b.data[0] = 0;
  EXPECT_NE(error_of(text_with_fallback(b)).find("EXT_meshopt_compression"), std::string::npos);
  Builder no_mode = meshopt_scene("TRIANGLES");
  no_mode.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"].erase("mode");
  EXPECT_NE(error_of(text_with_fallback(no_mode)).find("compressed"), std::string::npos);
  Builder outside = meshopt_scene("TRIANGLES");
  outside.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["byteOffset"] = -1;
  EXPECT_NE(error_of(text_with_fallback(outside)).find("longer than its buffer"), std::string::npos);
}

} // namespace
