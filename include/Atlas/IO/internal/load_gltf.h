// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_LOAD_GLTF_H
#define ATLAS_IO_INTERNAL_LOAD_GLTF_H

#include <Atlas/core/errors.h>
#include <Atlas/image/internal/Text_scanner.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
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

/// The JSON of a glTF file, which is the file, or the first chunk of a binary one.
inline std::string_view gltf_json(std::string_view bytes)
{
  if (!bytes.starts_with("glTF") || bytes.size() < 20)
    return bytes;
  std::uint32_t length = 0;
  for (std::size_t i = 4; i-- > 0;)
    length = length << 8 | static_cast<unsigned char>(bytes[12 + i]);
  return bytes.substr(20, length);
}

/// Fails, by name, for files whose numbers are compressed.
inline void check_gltf_compression(const std::string& bytes, const std::string& file)
{
  const nlohmann::json json = nlohmann::json::parse(gltf_json(bytes), nullptr, false);
  if (!json.is_object() || !json.contains("extensionsRequired"))
    return;
  for (const auto& extension : json["extensionsRequired"])
    for (const char* name :
         {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"})
      if (extension == name)
        throw IO_error(file + ": its numbers are compressed (" + name +
                       "), which is not supported; write it without compression");
}

/// Parses a glTF file, text or binary, with the loader's way to load pictures. \throw IO_error
inline tinygltf::Model load_gltf(const std::filesystem::path& path, tinygltf::TinyGLTF& loader)
{
  const std::string bytes = read_whole_file(path), folder = path.parent_path().string();
  check_gltf_compression(bytes, path.string());
  const auto size = static_cast<unsigned>(bytes.size());
  tinygltf::Model model;
  std::string error, warning;
  bool is_loaded = false;
  try {
    const auto* const data = bytes.data();
    is_loaded = bytes.substr(0, 4) == "glTF"
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
