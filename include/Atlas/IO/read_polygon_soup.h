// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_READ_POLYGON_SOUP_H
#define ATLAS_IO_READ_POLYGON_SOUP_H

#include <Atlas/IO/read_gltf.h>
#include <Atlas/IO/read_obj.h>
#include <Atlas/IO/read_off.h>
#include <Atlas/IO/read_ply.h>
#include <Atlas/IO/read_stl.h>
#include <Atlas/soup/Polygon_soup.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace Atlas {

/// \brief Reads a mesh file; its extension tells the format: .obj, .off, .ply, .stl, .gltf, .glb, in any
/// case. Needs the library tinygltf. \throw IO_error with one line that names the file, the line and what is
/// wrong
inline Polygon_soup read_polygon_soup(const std::filesystem::path& path)
{
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".obj")
    return read_obj(path);
  if (extension == ".off" || extension == ".coff")
    return read_off(path);
  if (extension == ".ply")
    return read_ply(path);
  if (extension == ".stl")
    return read_stl(path);
  if (extension == ".gltf" || extension == ".glb")
    return read_gltf(path);
  if (!std::filesystem::exists(path))
    throw IO_error(path.string() + ": cannot read: No such file or directory");
  throw IO_error(path.string() + ": unknown extension '" + extension +
                 "'; known are .obj .off .ply .stl .gltf .glb");
}

} // namespace Atlas

#endif
