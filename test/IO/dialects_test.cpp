// SPDX-License-Identifier: MIT
// What programs write that is not quite what the formats say.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/image/internal/text_bytes.h>

#include "soups.h"
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <vector>

using namespace Atlas;

namespace {

using test::append;
using test::Faces;
using test::faces_of;
using test::read_text;
using Color4 = std::array<float, 4>;
const std::vector<Point_3> square_points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const Faces square_faces = {{0, 1, 2}, {0, 2, 3}};

/// The square as binary STL. \param attributes  of the two triangles
std::string binary_square(std::string header, std::uint32_t count,
                          std::array<std::uint16_t, 2> attributes = {})
{
  header.resize(80, ' ');
  append(header, count);
  for (std::size_t t = 0; t < 2; ++t) {
    header += std::string(12, '\0');
    for (const Index v : square_faces[t])
      for (int k = 0; k < 3; ++k)
        append(header, static_cast<float>(square_points[v][k]));
    append(header, attributes[t]);
  }
  return header;
}

const std::string text_square =
    "solid My part\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1.0e0 0 0\n"
    "vertex 1 1 0\nendloop\nendfacet\nfacet normal nan nan nan\nouter loop\n"
    "vertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid My part\n";

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::string upper_case(std::string text)
{
  for (char& c : text)
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

void expect_square(const Polygon_soup& soup)
{
  EXPECT_EQ(soup.points, square_points);
  EXPECT_EQ(faces_of(soup), square_faces);
}

std::string utf16(const std::string& ascii, bool is_big_endian, bool has_mark)
{
  std::string result = !has_mark ? "" : is_big_endian ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : ascii)
    result += is_big_endian ? std::string{'\0', c} : std::string{c, '\0'};
  return result;
}

const std::string obj_square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";

std::string ply_header(const std::string& list, const std::string& more = "")
{
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 2\nproperty list " +
         list + '\n' + more + "end_header\n";
}

const std::string ply_rows = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

} // namespace

TEST(Stl_dialects, words_in_any_case_and_spacing)
{
  expect_square(read_text("a.stl", text_square));
  expect_square(read_text("a.stl", upper_case(replaced(text_square, "nan", "0"))));
  expect_square(
      read_text("a.stl", replaced(replaced(text_square, "endloop", "end loop"), "endsolid", "End Solid")));
  expect_square(read_text("a.stl", replaced(text_square, "endfacet", "end facet")));
  expect_square(read_text(
      "a.stl", replaced(replaced(text_square, "outer loop\n", "outer loop "), "\nendloop", " endloop")));
  expect_square(read_text("a.stl", utf16(text_square, false, true)));
}

TEST(Stl_dialects, text_with_more_than_facets)
{
  EXPECT_TRUE(read_text("a.stl", text_square).warnings.empty());
  expect_square(read_text("a.stl", replaced(text_square, "outer loop", "outerloop")));
  expect_square(read_text("a.stl", replaced(text_square, "\n", " ")));
  expect_square(read_text("a.stl", "\n  " + text_square + "\x1A"));
  expect_square(read_text("a.stl", text_square + std::string(500, '\0')));
  expect_square(read_text("a.stl", replaced(text_square, "My part", "facet vertex")));
  const Polygon_soup commented = read_text("a.stl", "; by hand\n# really\n" + text_square);
  expect_square(commented);
  EXPECT_EQ(commented.warnings,
            std::vector<std::string>{"line 1 is passed over, as it begins with ';', and so "
                                     "are others that begin with no keyword"});
  expect_square(read_text("a.stl", replaced(text_square, "endfacet\n", "endfacet\ncolor 1 0 0\n")));
}

TEST(Stl_dialects, binary_with_bytes_behind_the_last_triangle)
{
  for (const std::uint32_t count : {0u, 2u, 0xFFFFFFFFu})
    expect_square(read_text("a.stl", binary_square("x", count) + "ab"));
  expect_square(read_text("a.stl", binary_square("x", 2) + std::string(1000, '\0')));
  expect_square(read_text("a.stl", binary_square("\xFF\xFE", 2)));
  EXPECT_THROW(read_text("a.stl", binary_square("x", 3).substr(0, 170)), IO_error);
}

TEST(Stl_dialects, wrong_counts_give_way_to_the_size)
{
  EXPECT_TRUE(read_text("a.stl", binary_square("x", 2)).warnings.empty());
  for (const std::uint32_t count : {0u, 1u, 3u, 0xFFFFFFFFu}) {
    const Polygon_soup soup = read_text("a.stl", binary_square("x", count));
    expect_square(soup);
    EXPECT_EQ(soup.warnings, std::vector<std::string>{"the header tells of " + std::to_string(count) +
                                                      " triangles, but there are 2"});
  }
  expect_square(read_text("a.stl", binary_square("solid with zeros\0", 0)));
}

TEST(Stl_dialects, colours_of_facets)
{
  EXPECT_TRUE(read_text("a.stl", binary_square("x", 2)).face_colors.empty());
  // VisCAM: the highest bit tells that there is a colour, of which blue comes first.
  const Polygon_soup viscam = read_text("a.stl", binary_square("x", 2, {0x8000 | 31, 0}));
  EXPECT_EQ(viscam.face_colors, (std::vector<Color4>{{0, 0, 1, 1}, {1, 1, 1, 1}}));
  // Magics: the highest bit tells that there is none, and the header has one for these; red comes first.
  const Polygon_soup magics = read_text("a.stl", binary_square("COLOR=\xFF\x33\xCC\xFF", 2, {31, 0x8000}));
  EXPECT_EQ(magics.face_colors, (std::vector<Color4>{{1, 0, 0, 1}, {1, .2f, .8f, 1}}));
}

TEST(Ply_dialects, names_types_and_line_ends)
{
  for (const char* list :
       {"uchar int vertex_indices", "uint8 int64 vertex_indices", "uchar uint64 vertex_index",
        "uchar int vertex_indexes", "int uint indices", "uchar int corners"})
    expect_square(read_text("a.ply", ply_header(list) + ply_rows));
  const std::string header = ply_header("uchar int vertex_indices");
  expect_square(read_text("a.ply", header + replaced(ply_rows, "\n", " ")));
  expect_square(read_text("a.ply", header + replaced(ply_rows, " ", "\n")));
  expect_square(read_text("a.ply", header + replaced(ply_rows, "0 0\n1", "\n0 0\n\n1")));
  expect_square(
      read_text("a.ply", header + replaced(ply_rows, "\n", " 77\n"))); // values beyond those declared
  EXPECT_THROW(read_text("a.ply", header + replaced(ply_rows, "\n", " ") + "7"), IO_error);
  EXPECT_THROW(read_text("a.ply", header + ply_rows.substr(0, ply_rows.size() - 3)), IO_error);
}

TEST(Ply_dialects, names_in_any_case_and_number)
{
  const std::string text = ply_header("uchar int vertex_indices") + ply_rows;
  expect_square(read_text("a.ply", replaced(text, "ply\n", "PLY\n")));
  expect_square(read_text("a.ply", replaced(text, "float ", "float32 ")));
  expect_square(read_text("a.ply", replaced(replaced(text, "face", "Faces"), "vertex 4", "vertices 4")));
  expect_square(read_text("a.ply", replaced(replaced(text, "float x", "float X"), "vertex_", "Vertex_")));
  expect_square(read_text("a.ply", ply_header("float float vertex_indices") + ply_rows));
  EXPECT_THROW(read_text("a.ply", ply_header("uchar float weights") + ply_rows), IO_error);
}

TEST(Ply_dialects, binary_indices_of_64_bits)
{
  std::string bytes = replaced(ply_header("uchar int64 vertex_indices"), "ascii", "binary_little_endian");
  for (const Point_3& p : square_points)
    for (int k = 0; k < 3; ++k)
      append(bytes, static_cast<float>(p[k]));
  for (const auto& face : square_faces) {
    bytes += '\3';
    for (const Index v : face)
      append(bytes, std::int64_t(v));
  }
  expect_square(read_text("a.ply", bytes));
}

TEST(Ply_dialects, binary_behind_carriage_returns)
{
  std::string bytes =
      replaced(replaced(ply_header("uchar int vertex_indices"), "ascii", "binary_big_endian"), "\n", "\r");
  for (const Point_3& p : square_points)
    for (int k = 0; k < 3; ++k)
      append(bytes, static_cast<float>(10 + p[k]), std::endian::big);
  for (const auto& face : {std::array<int, 3>{0, 1, 2}, {0, 2, 10}}) { // 10 is a line feed
    bytes += '\3';
    for (const int v : face)
      append(bytes, v, std::endian::big);
  }
  const Polygon_soup soup = read_text("a.ply", bytes);
  EXPECT_EQ(soup.points[1], Point_3(11, 10, 10));
  EXPECT_EQ(faces_of(soup), (Faces{{0, 1, 2}, {0, 2, 10}}));
}

TEST(Ply_dialects, headers_with_lines_of_no_keyword)
{
  const std::string header = replaced(ply_header("uchar int vertex_indices"), "element vertex",
                                      "Created by Blender3D 247\nelement vertex");
  const Polygon_soup soup = read_text("a.ply", header + ply_rows);
  expect_square(soup);
  EXPECT_EQ(soup.warnings, std::vector<std::string>{
                               "line 3 of the header is taken for a comment: it begins with 'Created'"});
}

TEST(Ply_dialects, strips_of_triangles)
{
  // Every second triangle is turned; -1 ends a strip; triangles that name a vertex twice only lead on.
  const std::string header =
      replaced(replaced(ply_header("int int vertex_indices"), "face 2", "face 1"), "face", "tristrips");
  const Polygon_soup soup =
      read_text("a.ply", header + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n13 1 2 0 3 -1 0 1 2 -1 1 1 2 0\n");
  EXPECT_EQ(faces_of(soup), (Faces{{1, 2, 0}, {0, 2, 3}, {0, 1, 2}, {2, 1, 0}}));
  const Polygon_soup of_unsigned =
      read_text("a.ply", replaced(header, "int int", "int uint") +
                             "0 0 0\n1 0 0\n1 1 0\n0 1 0\n7 0 1 2 4294967295 0 2 3\n");
  EXPECT_EQ(faces_of(of_unsigned), square_faces);
}

TEST(Ply_dialects, colours_of_faces_and_of_floats)
{
  const std::string colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  const std::string rows = replaced(replaced(ply_rows, "0 1 2", "0 1 2 255 0 51"), "0 2 3", "0 2 3 0 255 0");
  const std::vector<Color4> expected{{1, 0, .2f, 1}, {0, 1, 0, 1}};
  EXPECT_EQ(read_text("a.ply", ply_header("uchar int vertex_indices", colors) + rows).face_colors, expected);
  // Floats that go beyond 1 count to 255.
  const std::string floats = replaced(colors, "uchar", "float");
  EXPECT_EQ(read_text("a.ply", ply_header("uchar int vertex_indices", floats) + rows).face_colors, expected);
  EXPECT_EQ(read_text("a.ply", ply_header("uchar int vertex_indices", floats) +
                                   replaced(replaced(rows, "255", "1"), "51", "0.2"))
                .face_colors,
            expected);
}

TEST(Ply_dialects, elements_of_one_name_with_other_properties)
{
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
      "property float u\nproperty float v\nproperty float red\nproperty float green\nproperty float blue\n"
      "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\n"
      "element face 1\nproperty list uchar int vertex_indices\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "end_header\n0 0 0 .5 0 0 1 0\n1 0 0 1 0 0 1 0\n0 1 0\n3 0 1 2\n3 0 1 2 255 0 0\n";
  const Polygon_soup soup = read_text("a.ply", text);
  EXPECT_EQ(soup.colors, (std::vector<Color4>{{0, 1, 0, 1}, {0, 1, 0, 1}, {1, 1, 1, 1}}));
  EXPECT_EQ(soup.face_colors, (std::vector<Color4>{{1, 1, 1, 1}, {1, 0, 0, 1}}));
  ASSERT_EQ(soup.uv.size(), 6u);
  EXPECT_EQ(soup.uv[1], Point_2(1, 0));
  EXPECT_TRUE(std::isnan(soup.uv[2].x())) << "the third vertex has no coordinates";
}

TEST(Off_dialects, counts_behind_the_word_and_colours_of_faces)
{
  const std::string rows = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  expect_square(read_text("a.off", "OFF4 2 0\n" + rows));
  expect_square(read_text("a.off", "OFF 4 2 0\n" + rows));
  expect_square(
      read_text("a.off", "NOFF4 2 0\n" + replaced(replaced(rows, " 0\n", " 0 0 0 1\n"), "0 2 3", "0 2 3")));
  EXPECT_TRUE(read_text("a.off", "OFF4 2 0\n" + rows).face_colors.empty());
  const auto colors = [&](const std::string& first, const std::string& second) {
    return read_text("a.off", "OFF\n4 2 0\n" + replaced(replaced(rows, "0 1 2", "0 1 2 " + first), "0 2 3",
                                                        "0 2 3 " + second))
        .face_colors;
  };
  EXPECT_EQ(colors("255 0 51", "0 255 0 0"), (std::vector<Color4>{{1, 0, .2f, 1}, {0, 1, 0, 0}}));
  EXPECT_EQ(colors("1 0 0.2 1", ""), (std::vector<Color4>{{1, 0, .2f, 1}, {1, 1, 1, 1}}));
  EXPECT_EQ(colors("", "0 1 0"), (std::vector<Color4>{{1, 1, 1, 1}, {0, 1, 0, 1}}));
  EXPECT_EQ(colors("", "255 1 1"), (std::vector<Color4>{{1, 1, 1, 1}, {1, 1.f / 255, 1.f / 255, 1}}));
  EXPECT_TRUE(colors("7", "8").empty()); // places in a table
}

TEST(Off_dialects, words_and_rows)
{
  const std::string rows = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  for (const char* start : {"off\n4 2 0\n", "4 2 0\n", "OFF\n4 2\n", "OFF4 2\n0\n", "OFF\n4\n2\n0\n"})
    expect_square(read_text("a.off", start + rows));
  expect_square(read_text("a.off", "OFF 4 2 0 " + replaced(rows, "\n", " ")));
  expect_square(read_text("a.off", "OFF\n4\n2 0\n" + replaced(rows, " ", "\n")));
  EXPECT_THROW(read_text("a.off", "OFF 4 2 0 " + replaced(rows, "\n", " ") + "7"), IO_error);
  EXPECT_THROW(read_text("a.off", "nOFF\n3\n4 2 0\n" + rows), IO_error);
}

TEST(Off_dialects, colours_of_vertices_that_the_header_does_not_tell)
{
  const auto colors = [](const std::string& a, const std::string& b) {
    return read_text("a.off", "OFF\n3 1 0\n0 0 0 " + a + "\n1 0 0 " + b + "\n0 1 0 0 0 0\n3 0 1 2\n").colors;
  };
  EXPECT_EQ(colors("255 0 51", "0 255 0 255"),
            (std::vector<Color4>{{1, 0, .2f, 1}, {0, 1, 0, 1}, {0, 0, 0, 1}}));
  EXPECT_TRUE(colors("0 0 1", "0 0 -1").empty()) << "normals";
  EXPECT_TRUE(colors("0 0 1", "").empty());
  EXPECT_TRUE(colors("0 0 1", "1 2 3 4 5").empty());
}

TEST(Obj_dialects, words_and_numbers)
{
  expect_square(read_text("a.obj", upper_case(obj_square)));
  expect_square(read_text("a.obj", replaced(obj_square, "f 1 2 3", "f +1 2.0 3.000/")));
  expect_square(read_text("a.obj", "# of C:\\models\\\n" + replaced(obj_square, "f 1 2", "# \\\nf 1 \\\n2")));
  expect_square(read_text("a.obj", "# x\n" + replaced(obj_square, "\n", "\r")));
  expect_square(read_text("a.obj", replaced(obj_square, "\n", "\r\r\n")));
  const Polygon_soup no_numbers =
      read_text("a.obj", "v 1.#QNAN -1.#IND 0\nv 1.#INF -1.#INF00 1#x\nv 0 1 0\nf 1 2 3\n");
  EXPECT_TRUE(std::isnan(no_numbers.points[0].x()) && std::isnan(no_numbers.points[0].y()));
  EXPECT_EQ(no_numbers.points[1], Point_3(INFINITY, -INFINITY, 1));
}

TEST(Obj_dialects, what_the_surface_does_not_need_is_no_reason_to_refuse)
{
  const Polygon_soup soup = read_text(
      "a.obj", replaced(obj_square, "f 1 2 3", "vt\nvt .5 .25\nvn 1 a 0\nvn 0 0 1\nf 1/1/1 2/2/2 3/2/2"));
  expect_square(soup);
  EXPECT_TRUE(std::isnan(soup.uv[0].x()));
  EXPECT_EQ(soup.uv[1], Point_2(.5, .25));
  EXPECT_EQ(soup.corner_normal, (std::vector<Index>{no_index, 1, 1, no_index, no_index, no_index}));
  EXPECT_EQ(soup.warnings,
            std::vector<std::string>{
                "line 5: u is missing; texture coordinates and normals that cannot be read are passed over"});
}

TEST(Obj_dialects, encodings_and_zero_bytes)
{
  for (const bool is_big : {false, true})
    for (const bool has_mark : {false, true}) {
      std::string wide = !has_mark ? ""
                         : is_big  ? std::string("\0\0\xFE\xFF", 4)
                                   : std::string("\xFF\xFE\0\0", 4);
      for (const char c : obj_square)
        append(wide, std::uint32_t(static_cast<unsigned char>(c)),
               is_big ? std::endian::big : std::endian::little);
      expect_square(read_text("a.obj", wide));
    }
  const std::string zeros(4, '\0'); // in a file so short that they are more than one byte of a hundred
  expect_square(read_text("a.obj", zeros + obj_square));
  expect_square(read_text("a.obj", replaced(obj_square, "f 1 2 3", zeros + "f 1 2 3")));
  expect_square(read_text("a.obj", replaced(obj_square, "\n", std::string(1, '\0') + "\r\n")));
  for (const bool is_big : {false, true})
    for (const bool has_mark : {false, true})
      expect_square(read_text("a.obj", utf16(obj_square, is_big, has_mark)));
  expect_square(read_text("a.obj", obj_square + std::string(4096, '\0')));
  expect_square(read_text("a.obj", replaced(obj_square, "f 1 2 3", std::string("f 1 2 3") + '\0')));
  try {
    std::string noise;
    for (int i = 0; i < 1000; ++i)
      noise += static_cast<char>(i * i % 251);
    read_text("a.obj", noise);
    ADD_FAILURE();
  } catch (const IO_error& error) {
    EXPECT_NE(std::string(error.what()).find("not a text file"), std::string::npos) << error.what();
  }
}

TEST(Obj_dialects, names_in_utf16)
{
  std::string text = utf16("usemtl ", false, true);
  text += std::string("\xE4\x00\x3D\xD8\x00\xDE\n\0", 8); // a umlaut and a face outside of the first plane
  const Polygon_soup soup = read_text("a.obj", text + utf16(obj_square, false, false));
  EXPECT_EQ(soup.material_names, std::vector<std::string>{"\xC3\xA4\xF0\x9F\x98\x80"});
}

TEST(Obj_dialects, colours_of_255_and_of_zbrush)
{
  const Polygon_soup wide = read_text("a.obj", "v 0 0 0 255 0 51\nv 1 0 0 0 0 0\nv 1 1 0 1 1 1\nf 1 2 3\n");
  EXPECT_EQ(wide.colors,
            (std::vector<Color4>{{1, 0, .2f, 1}, {0, 0, 0, 1}, {1.f / 255, 1.f / 255, 1.f / 255, 1}}));
  const Polygon_soup painted =
      read_text("a.obj", obj_square + "#The following MRGB block\n#MRGB ffff0033ff00FF00\n#MRGB 00000000\n");
  EXPECT_EQ(painted.colors, (std::vector<Color4>{{1, 0, .2f, 1}, {0, 1, 0, 1}, {0, 0, 0, 1}, {1, 1, 1, 1}}));
}

TEST(Dialects, colours_that_are_not_told_are_white_beside_any_others)
{
  const Polygon_soup obj = read_text("a.obj", "v 0 0 0\nv 1 0 0 0 255 0\nv 0 1 0\nf 1 2 3\n");
  const std::vector<Color4> expected{{1, 1, 1, 1}, {0, 1, 0, 1}, {1, 1, 1, 1}};
  EXPECT_EQ(obj.colors, expected);
  const std::string position = "property float x\nproperty float y\nproperty float z\n";
  const Polygon_soup ply = read_text(
      "a.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" + position + "element vertex 1\n" + position +
                   "property float red\nproperty float green\nproperty float blue\nelement vertex 1\n" +
                   position + "element face 1\nproperty list int int vertex_indices\nend_header\n" +
                   "0 0 0\n1 0 0 0 255 0\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(ply.colors, expected);
}

TEST(Text_bytes, are_shown_without_what_is_no_text)
{
  EXPECT_EQ(internal::printable("plain \xC3\xA4\xE2\x82\xAC"), "plain \xC3\xA4\xE2\x82\xAC");
  EXPECT_EQ(internal::printable(std::string_view("a\0\x1B\x7F", 4)), "a\\x00\\x1B\\x7F");
  EXPECT_EQ(internal::printable("\xC3(\xE2\x82"), "\\xC3(\\xE2\\x82");
}
