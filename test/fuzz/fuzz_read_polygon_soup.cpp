// SPDX-License-Identifier: MIT
// Any bytes as a mesh file: either a soup that keeps its promises, or an IO_error of one line. The first byte
// tells the format, the others are the file.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/core/errors.h>
#include <Atlas/image/internal/Output_file.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <unistd.h>

namespace {

using namespace Atlas;

/// Tells what is wrong and ends, so that the fuzzer keeps the input.
void require(bool is_true, const char* what)
{
  if (is_true)
    return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

constexpr std::array extensions{".obj", ".off", ".ply", ".stl", ".glb", ".gltf"};

/// A file in memory, where there is a file system for it.
std::filesystem::path place_of_file(const char* extension)
{
  const std::filesystem::path shared = "/dev/shm";
  const auto folder = std::filesystem::is_directory(shared) ? shared : std::filesystem::temp_directory_path();
  return folder / ("atlas-fuzz-" + std::to_string(::getpid() + 10'000'000) + extension);
}

template <typename Values>
void require_indices(const Values& values, std::size_t size, const char* what)
{
  for (const Index i : values)
    require(i == no_index || i < size, what);
}

void check(const Polygon_soup& soup)
{
  const std::size_t faces = soup.number_of_faces(), corners = soup.number_of_corners();
  require(faces > 0, "there is a face");
  require(soup.first.front() == 0 && soup.first.back() == corners, "faces cover the corners");
  for (std::size_t f = 0; f < faces; ++f)
    require(soup.first[f] <= soup.first[f + 1], "faces are in order");
  require(soup.uv.empty() || soup.uv.size() == corners, "coordinates per corner");
  require(soup.colors.empty() || soup.colors.size() == soup.points.size(), "colours per vertex");
  require(soup.face_colors.empty() || soup.face_colors.size() == faces, "colours per face");
  require(soup.face_page.empty() || soup.face_page.size() == faces, "pages per face");
  require(soup.corner_normal.empty() || soup.corner_normal.size() == corners, "normals per corner");
  require(soup.face_material.empty() || soup.face_material.size() == faces, "materials per face");
  require(soup.face_group.empty() || soup.face_group.size() == faces, "groups per face");
  require_indices(soup.corner_normal, soup.normals.size(), "normals exist");
  require_indices(soup.face_material, soup.material_names.size(), "materials exist");
  require_indices(soup.face_group, soup.group_names.size(), "groups exist");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size == 0)
    return 0;
  const std::filesystem::path path = place_of_file(extensions[data[0] % extensions.size()]);
  internal::write_whole_file(path, {reinterpret_cast<const char*>(data) + 1, size - 1});
  try {
    const Polygon_soup soup = read_polygon_soup(path);
    check(soup);
    const Surface surface = build_surface(soup.points, soup.first, soup.vertices);
    for (const Index c : surface.corner)
      require(c < soup.number_of_corners(), "corners of triangles exist");
    require(!obj_text(soup, "a.mtl").empty(), "whatever has been read can be written");
  } catch (const IO_error& error) {
    const std::string_view message = error.what();
    require(message.find('\n') == message.npos, "messages have one line");
    require(message.substr(0, path.string().size()) == path.string(), "messages begin with the file");
  }
  std::filesystem::remove(path);
  return 0;
}
