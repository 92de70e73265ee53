// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_LOAD_GLTF_H
#define ATLAS_IO_INTERNAL_LOAD_GLTF_H

#include <Atlas/IO/internal/glb.h>
#include <Atlas/IO/internal/read_gltf_file.h>
#include <Atlas/core/errors.h>
#include <Atlas/image/internal/text_bytes.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <string>
#include <tiny_gltf.h>

namespace Atlas::internal {

/// A message of tinygltf without line ends.
inline std::string one_line(std::string text)
{
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
    text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return printable(text);
}

/// Parses a glTF file, text or binary, with the loader's way to load pictures. \throw IO_error
inline tinygltf::Model load_gltf(const std::filesystem::path& path, tinygltf::TinyGLTF& loader)
{
  const std::string bytes = read_gltf_file(path), folder = path.parent_path().string();
  const auto size = static_cast<unsigned>(bytes.size());
  tinygltf::Model model;
  std::string error, warning;
  bool is_loaded = false;
  try {
    const auto* const data = bytes.data();
    is_loaded = is_glb(bytes)
                    ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                                  reinterpret_cast<const unsigned char*>(data), size, folder)
                    : loader.LoadASCIIFromString(&model, &error, &warning, data, size, folder);
  } catch (const std::exception& exception) { // of the JSON parser below tinygltf
    error = exception.what();
  }
  if (!is_loaded)
    throw IO_error(path.string() + ": " + (error.empty() ? "not a glTF file" : one_line(error)));
  return model;
}

} // namespace Atlas::internal

#endif
