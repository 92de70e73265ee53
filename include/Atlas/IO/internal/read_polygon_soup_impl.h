// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_READ_POLYGON_SOUP_IMPL_H
#define ATLAS_IO_INTERNAL_READ_POLYGON_SOUP_IMPL_H

#include <Atlas/IO/internal/extension.h>
#include <Atlas/IO/internal/read_gltf.h>
#include <Atlas/IO/internal/read_obj.h>
#include <Atlas/IO/internal/read_off.h>
#include <Atlas/IO/internal/read_ply.h>
#include <Atlas/IO/internal/read_stl.h>
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/internal/library.h>

#include <string>

namespace Atlas {

ATLAS_INLINE Polygon_soup read_polygon_soup(const std::filesystem::path& path)
{
  const std::string extension = internal::lower_case_extension(path);
  if (extension == ".obj")
    return internal::read_obj(path);
  if (extension == ".off" || extension == ".coff")
    return internal::read_off(path);
  if (extension == ".ply")
    return internal::read_ply(path);
  if (extension == ".stl")
    return internal::read_stl(path);
  if (extension == ".gltf" || extension == ".glb")
    return internal::read_gltf(path);
  if (!std::filesystem::exists(path))
    throw IO_error(path.string() + ": cannot read: No such file or directory");
  throw IO_error(path.string() + ": unknown extension '" + extension +
                 "'; known are .obj .off .ply .stl .gltf .glb");
}

} // namespace Atlas

#endif
