// SPDX-License-Identifier: MIT
#include <Atlas/IO/read_polygon_soup.h>

#include "soups.h"
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

using namespace Atlas;

namespace {

/// The error of a broken file, without the folder.
std::string error_of(const std::string& name, const std::string& text)
{
  const test::Temporary_folder folder;
  const auto path = folder.write(name, text);
  try {
    read_polygon_soup(path);
  } catch (const IO_error& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.find('\n'), std::string::npos);
    EXPECT_EQ(what.rfind(folder.path().string(), 0), 0u);
    return what.substr(folder.path().string().size() + 1);
  }
  return "no error";
}

using test::append;
using test::Faces;
using test::faces_of;
using test::read_text;
const Faces one_triangle = {{0, 1, 2}};
const std::vector<Point_3> corner_points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

std::string binary_stl(std::string header, std::uint32_t count)
{
  header.resize(80, ' ');
  append(header, count);
  for (const float x : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, -0.f, 1.f, 0.f})
    append(header, x);
  return header + std::string(2, '\0');
}

std::string binary_ply(std::endian order)
{
  std::string bytes = std::string("ply\nformat binary_") + (order == std::endian::little ? "little" : "big") +
                      "_endian 1.0\nelement vertex 3\nproperty double x\nproperty float y\nproperty float z\n"
                      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Point_3& p : corner_points) {
    append(bytes, p.x(), order);
    append(bytes, static_cast<float>(p.y()), order);
    append(bytes, static_cast<float>(p.z()), order);
    bytes += std::string("\xff\x00\x33", 3);
  }
  bytes += '\3';
  for (const std::int32_t v : {0, 1, 2})
    append(bytes, v, order);
  return bytes;
}

} // namespace

TEST(Read_obj, understands_all_forms_of_corners)
{
  const Polygon_soup soup =
      read_text("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt .25 .5\nvt 1\nvn 0 0 1\n"
                         "f 1 2 3\nf 1/1 2/2 3/1\nf 1//1 2//1 3//1\nf 1/1/1 2/2/ -1/-1/-1\n");
  EXPECT_EQ(soup.points, corner_points);
  EXPECT_EQ(faces_of(soup), (Faces{{0, 1, 2}, {0, 1, 2}, {0, 1, 2}, {0, 1, 2}}));
  ASSERT_EQ(soup.uv.size(), 12u);
  EXPECT_TRUE(std::isnan(soup.uv[0].x()) && std::isnan(soup.uv[6].y()));
  EXPECT_EQ(soup.uv[3], Point_2(0.25, 0.5));
  EXPECT_EQ(soup.uv[4], Point_2(1, 0));
  EXPECT_EQ(soup.uv[11], Point_2(1, 0));
  const Index n = no_index;
  EXPECT_EQ(soup.corner_normal, (std::vector<Index>{n, n, n, n, n, n, 0, 0, 0, 0, n, 0}));
}

TEST(Read_obj, relative_indices_count_back_from_where_they_stand)
{
  const Polygon_soup soup =
      read_text("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -1 -2 -3\n");
  EXPECT_EQ(faces_of(soup), (Faces{{0, 1, 2}, {3, 2, 1}}));
}

TEST(Read_obj, lines_may_end_and_go_on_in_any_way)
{
  const std::string plain = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3";
  for (const std::string& text :
       {plain, plain + "\n", std::string("\xEF\xBB\xBFv 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n"),
        std::string("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r"),
        std::string("\t v  0\t0 +0 # v\n\n v 1 0 \\\n 0\nv 0 1 0\nf 1\\\r\n 2\\\n 3"),
        std::string("v 0 0 0#v\nv 1 0 0\nv 0 1 0 # v\nf 1 2 3#f"),
        std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 \\")}) {
    const Polygon_soup soup = read_text("a.obj", text);
    EXPECT_EQ(soup.points, corner_points) << text;
    EXPECT_EQ(faces_of(soup), one_triangle) << text;
  }
}

TEST(Read_obj, keeps_colours_materials_and_groups)
{
  const Polygon_soup soup = read_text(
      "a.obj", "mtllib my lib.mtl\nv 0 0 0 1\nv 1 0 0 .5 .25 1\nv 0 1 0\nf 1 2 3\no big thing\nusemtl red\n"
               "f 1 2 3\nusemtl blue\nf 1 2 3\nusemtl red\ng\nf 1 2 3\nxyzzy 1 2\n");
  EXPECT_EQ(soup.colors, (std::vector<std::array<float, 4>>{{1, 1, 1, 1}, {.5f, .25f, 1, 1}, {1, 1, 1, 1}}));
  EXPECT_EQ(soup.material_libraries, std::vector<std::string>{"my lib.mtl"});
  EXPECT_EQ(soup.material_names, (std::vector<std::string>{"red", "blue"}));
  EXPECT_EQ(soup.face_material, (std::vector<Index>{no_index, 0, 1, 0}));
  EXPECT_EQ(soup.group_names, std::vector<std::string>{"big thing"});
  EXPECT_EQ(soup.face_group, (std::vector<Index>{no_index, 0, 0, no_index}));
}

TEST(Read_obj, keeps_faces_that_name_no_vertex)
{
  const Polygon_soup soup = read_text("a.obj", "v 0 0 0\nf 1 0 9000\nf -5 1 1\nf 1 1\n");
  EXPECT_EQ(faces_of(soup), (Faces{{0, no_index, 8999}, {no_index, 0, 0}, {0, 0}}));
}

TEST(Read_obj, numbers_of_any_size)
{
  const Polygon_soup soup = read_text("a.obj", "v 1e30 -1e-30 1e400\nv nan inf 0.1\nv 1e-400 0 0\nf 1 2 3");
  EXPECT_EQ(soup.points[0].x(), 1e30);
  EXPECT_EQ(soup.points[0].y(), -1e-30);
  EXPECT_TRUE(std::isinf(soup.points[0].z()));
  EXPECT_TRUE(std::isnan(soup.points[1].x()) && std::isinf(soup.points[1].y()));
  EXPECT_EQ(soup.points[1].z(), 0.1);
  EXPECT_EQ(soup.points[2].x(), 0);
}

TEST(Read_obj, errors_name_the_line)
{
  EXPECT_EQ(error_of("a.obj", ""), "a.obj: the file is empty");
  EXPECT_EQ(error_of("a.obj", "v 0 0 0\nv 1 0\nf 1 1 1\n"), "a.obj:2: z is missing");
  EXPECT_EQ(error_of("a.obj", "# c\n\nv 0 0 zero\n"), "a.obj:3: z is not a number: 'zero'");
  EXPECT_EQ(error_of("a.obj", "v 0 0 1,5\n"), "a.obj:1: z is not a number: '1,5'");
  EXPECT_EQ(error_of("a.obj", "v 0 \\\n0 0\nf 1 1 x"), "a.obj:3: vertex index is not an integer: 'x'");
  EXPECT_EQ(error_of("a.obj", "v 0 0 0\nf 1 1 1.5"), "a.obj:2: a corner is not of the form v/vt/vn: '.5'");
  EXPECT_EQ(error_of("a.obj", "v 0 0 0\nv 0 0 1\n"), "a.obj: no face in the file (2 lines, 2 vertices)");
  EXPECT_EQ(error_of("a.obj", "v 0 0 0\nf 1 1 \xFF\x1B[2J\xC3\xA4"),
            "a.obj:2: vertex index is not an integer: '\\xFF\\x1B[2J\xC3\xA4'");
}

TEST(Read_off, reads_all_kinds_of_vertices)
{
  const Polygon_soup plain =
      read_text("a.off", "OFF\n# c\n3 1 0\n0 0 0#c\n1 0 0 # c\n\n0 1 0\n3 0 1 2 255 0 0#red\n");
  EXPECT_EQ(plain.points, corner_points);
  EXPECT_EQ(faces_of(plain), one_triangle);
  const Polygon_soup full =
      read_text("a.off", "STCNOFF 3 1 0\n0 0 0 0 0 1 255 0 51 255 .5 .25\n"
                         "1 0 0 0 0 1 0 0 0 0 1 1\n0 1 0 0 0 1 0 0 0 255 0 1\n3 0 1 2\n");
  EXPECT_EQ(full.colors[0], (std::array<float, 4>{1, 0, .2f, 1}));
  EXPECT_EQ(full.uv, (std::vector<Point_2>{{.5, .25}, {1, 1}, {0, 1}}));
  EXPECT_EQ(full.normals.size(), 3u);
  EXPECT_EQ(full.corner_normal, (std::vector<Index>{0, 1, 2}));
  const Polygon_soup three =
      read_text("a.off", "COFF\n3 1 0\n0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n3 0 1 2\n");
  EXPECT_EQ(three.colors[2], (std::array<float, 4>{0, 0, 1, 1}));
}

TEST(Read_off, errors_name_the_line)
{
  EXPECT_EQ(error_of("a.off", "hello\n"),
            "a.off:1: an OFF file begins with the word OFF, this one with 'hello'");
  EXPECT_EQ(error_of("a.off", "OFF\n99999999 1 0\n"),
            "a.off:2: number of vertices is 99999999, more than the file can hold");
  EXPECT_EQ(error_of("a.off", "OFF\n2 1 0\n0 0 0\n"), "a.off:3: the file ends after 1 of 2 vertices");
  EXPECT_EQ(error_of("a.off", "OFF\n1 1 0\n0 0 0\n3 0 0\n"), "a.off:4: vertex index is missing");
}

TEST(Read_ply, reads_text_and_both_byte_orders)
{
  const std::string text =
      "ply\nformat ascii 1.0\ncomment hi\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 255 0 51\n1 0 0 255 0 51\n0 1 0 255 0 51\n3 0 1 2 77 88\n";
  for (const std::string& bytes : {text, binary_ply(std::endian::little), binary_ply(std::endian::big)}) {
    const Polygon_soup soup = read_text("a.ply", bytes);
    EXPECT_EQ(soup.points, corner_points);
    EXPECT_EQ(faces_of(soup), one_triangle);
    EXPECT_EQ(soup.colors.at(2), (std::array<float, 4>{1, 0, .2f, 1}));
  }
}

TEST(Read_ply, reads_three_dialects_of_texture_coordinates)
{
  const std::string vertices =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_index\n";
  const std::vector<Point_2> expected{{.5, .25}, {1, 0}, {0, 1}};
  EXPECT_EQ(read_text("a.ply", vertices + "property float texture_u\nproperty float texture_v\n" + faces +
                                   "end_header\n0 0 0 .5 .25\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n")
                .uv,
            expected);
  EXPECT_EQ(read_text("a.ply", vertices + faces +
                                   "property list uchar float texcoord\nproperty int texnumber\n" +
                                   "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 6 .5 .25 1 0 0 1 0\n")
                .uv,
            expected);
  EXPECT_EQ(
      read_text(
          "a.ply",
          vertices + faces +
              "element halfedge 3\nproperty int source\nproperty int target\nproperty float u\n"
              "property float v\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n2 0 .5 .25\n0 1 1 0\n1 2 0 1\n")
          .uv,
      expected);
}

TEST(Read_ply, errors_name_line_or_byte)
{
  EXPECT_EQ(error_of("a.ply", "plx\n"), "a.ply:1: a PLY file begins with the word ply");
  EXPECT_EQ(error_of("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty flout x\n"),
            "a.ply:4: unknown type 'flout'");
  EXPECT_EQ(error_of("a.ply", "ply\nformat ascii 1.0\nelement vertex 30000000\n"),
            "a.ply:3: element 'vertex' has 30000000 rows, more than the file can hold");
  const std::string whole = binary_ply(std::endian::little);
  const std::string error = error_of("a.ply", whole.substr(0, whole.size() - 3));
  EXPECT_EQ(error, "a.ply: byte " + std::to_string(whole.size() - 4) +
                       ": the file ends in the middle of vertex_indices");
}

TEST(Read_stl, text_and_binary_and_binary_that_says_solid)
{
  const std::string text =
      "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex -0 1 0\n"
      "endloop\nendfacet\nendsolid s\n";
  for (const std::string& bytes :
       {text, binary_stl("made by hand", 1), binary_stl("solid made by hand", 1)}) {
    const Polygon_soup soup = read_text("a.stl", bytes);
    EXPECT_EQ(soup.points, corner_points);
    EXPECT_EQ(faces_of(soup), one_triangle);
  }
  EXPECT_EQ(error_of("a.stl", binary_stl("x", 1).substr(0, 133)),
            "a.stl: byte 132: the file ends in the middle of an attribute");
  EXPECT_EQ(error_of("a.stl", "solid s\nvertex 1 2 3\n"), "a.stl:2: a vertex outside of a loop");
}

TEST(Read_stl, equal_corners_are_one_vertex)
{
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  EXPECT_EQ(faces_of(read_text("a.stl", "solid\n" + facet + facet + "endsolid\n")),
            (Faces{{0, 1, 2}, {0, 1, 2}}));
}

TEST(Read_gltf, applies_nodes_and_turns_v)
{
  std::string data;
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, .5f, .25f, 1.f, 1.f, 0.f, 0.f})
    append(data, x);
  for (const std::uint16_t i : std::array<std::uint16_t, 3>{0, 1, 2})
    append(data, i);
  data.resize(68, '\0');
  nlohmann::json json = {
      {"asset", {{"version", "2.0"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"children", {1}}, {"translation", {10, 0, 0}}}, {{"mesh", 0}, {"scale", {2, 2, -2}}}}},
      {"meshes",
       {{{"name", "m"},
         {"primitives",
          {{{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}, {"indices", 2}, {"material", 0}}}}}}},
      {"materials", {{{"name", "red"}}}},
      {"buffers", {{{"byteLength", 68}}}},
      {"bufferViews",
       {{{"buffer", 0}, {"byteLength", 36}},
        {{"buffer", 0}, {"byteOffset", 36}, {"byteLength", 24}},
        {{"buffer", 0}, {"byteOffset", 60}, {"byteLength", 6}}}},
      {"accessors",
       {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
        {{"bufferView", 1}, {"componentType", 5126}, {"count", 3}, {"type", "VEC2"}},
        {{"bufferView", 2}, {"componentType", 5123}, {"count", 3}, {"type", "SCALAR"}}}}};
  const auto glb = [&] {
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string bytes = "glTF";
    append(bytes, std::uint32_t(2));
    append(bytes, std::uint32_t(28 + text.size() + data.size()));
    append(bytes, std::uint32_t(text.size()));
    bytes += "JSON" + text;
    append(bytes, std::uint32_t(data.size()));
    bytes += std::string("BIN\0", 4) + data;
    return bytes;
  };
  const Polygon_soup soup = read_text("a.glb", glb());
  EXPECT_EQ(soup.points, (std::vector<Point_3>{{10, 0, 0}, {12, 0, 0}, {10, 2, 0}}));
  EXPECT_EQ(faces_of(soup), (Faces{{0, 2, 1}})); // the scale mirrors
  EXPECT_EQ(soup.uv, (std::vector<Point_2>{{.5, .75}, {0, 1}, {1, 0}}));
  EXPECT_EQ(soup.material_names, std::vector<std::string>{"red"});

  // The second set of coordinates, if the material says so; a material that does not exist is none.
  json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = 3;
  json["accessors"].push_back({{"bufferView", 1}, {"componentType", 5126}, {"count", 2}, {"type", "VEC2"}});
  EXPECT_EQ(read_text("a.glb", glb()).uv, soup.uv);
  json["materials"][0]["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}};
  EXPECT_TRUE(std::isnan(read_text("a.glb", glb()).uv[1].x()));
  json["meshes"][0]["primitives"][0]["material"] = 3;
  EXPECT_EQ(read_text("a.glb", glb()).face_material, std::vector<Index>{no_index});

  // A vertex that the primitive does not have is none of another one either.
  json["meshes"][0]["primitives"].push_back(json["meshes"][0]["primitives"][0]);
  data[60] = 3;
  EXPECT_EQ(faces_of(read_text("a.glb", glb())), (Faces{{no_index, 2, 1}, {no_index, 5, 4}}));

  json["accessors"][0]["count"] = 4;
  EXPECT_EQ(error_of("a.glb", glb()), "a.glb: buffer view 0 is too short for what is to be read from it");
  json["nodes"][1]["children"] = {0};
  EXPECT_NE(error_of("a.glb", glb()), "no error");
  EXPECT_NE(error_of("a.gltf", "{"), "no error");
}

TEST(Read_polygon_soup, tells_which_extensions_it_knows)
{
  EXPECT_EQ(read_text("A.OBJ", "v 0 0 0\nf 1 1 1").number_of_faces(), 1u);
  EXPECT_EQ(error_of("a.xyz", "1"),
            "a.xyz: unknown extension '.xyz'; known are .obj .off .ply .stl .gltf .glb");
  EXPECT_THROW(read_polygon_soup("/no/such/file.obj"), IO_error);
  EXPECT_THROW(read_polygon_soup("/tmp"), IO_error);
}
