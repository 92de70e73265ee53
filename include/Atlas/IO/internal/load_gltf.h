// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_LOAD_GLTF_H
#define ATLAS_IO_INTERNAL_LOAD_GLTF_H

#include <Atlas/IO/internal/find_file.h>
#include <Atlas/IO/internal/glb.h>
#include <Atlas/IO/internal/read_gltf_file.h>
#include <Atlas/core/errors.h>
#include <Atlas/image/internal/Reading_listener.h>
#include <Atlas/image/internal/Text_scanner.h>
#include <Atlas/image/internal/text_bytes.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
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

/// The file that a buffer or a picture of a glTF file names, from the folder of that, as a URI; none if it
/// names none, or one that is not there. See `find_file()`.
inline std::optional<std::string> found_name(const nlohmann::ordered_json& item,
                                             const std::filesystem::path& folder)
{
  const auto uri = item.is_object() ? item.find("uri") : item.end();
  if (uri == item.end() || !uri->is_string() || uri->get_ref<const std::string&>().starts_with("data:"))
    return std::nullopt;
  const auto found = find_file(folder, uri->get_ref<const std::string&>());
  if (!found)
    return std::nullopt;
  if (reading_listener())
    (void)read_whole_file(*found); // tinygltf does not tell of what it reads
  std::string name;
  for (const char c : found->lexically_relative(folder).generic_string())
    name += c == '%' ? "%25" : std::string(1, c);
  return name;
}

/// The text of a glTF file in which files are called by the names that they have. A binary file stays as it
/// is. Functions of tinygltf that read files are not exchanged instead, since a program that links libdraco,
/// too, may get other ones by their names.
inline std::string with_found_names(std::string bytes, const std::filesystem::path& folder)
{
  using Json = nlohmann::ordered_json;
  Json json = is_glb(bytes) ? Json() : Json::parse(bytes, nullptr, false);
  bool is_changed = false;
  for (const char* key : {"buffers", "images"})
    if (json.is_object() && json.contains(key) && json[key].is_array())
      for (Json& item : json[key])
        if (const auto name = found_name(item, folder); name && item["uri"] != *name) {
          item["uri"] = *name;
          is_changed = true;
        }
  if (is_changed)
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
  return bytes;
}

/// Whether a file that cannot be read, or has nothing in it, is one of glTF 1.0.
inline bool is_gltf_1(std::string_view bytes)
{
  if (is_glb(bytes))
    return bytes.size() > 4 && bytes[4] == 1;
  const auto json = nlohmann::json::parse(bytes, nullptr, false);
  if (!json.is_object())
    return false;
  const auto asset = json.find("asset"), meshes = json.find("meshes");
  const auto* const version = asset != json.end() && asset->is_object() && asset->contains("version")
                                  ? (*asset)["version"].get_ptr<const std::string*>()
                                  : nullptr;
  return (version && version->starts_with("1.")) || (meshes != json.end() && meshes->is_object());
}

/// Parses a glTF file, text or binary, with the loader's way to load pictures. \throw IO_error
inline tinygltf::Model load_gltf(const std::filesystem::path& path, tinygltf::TinyGLTF& loader)
{
  const std::string folder = path.parent_path().string(),
                    bytes = with_found_names(read_gltf_file(path), folder);
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
  if ((!is_loaded || model.meshes.empty()) && is_gltf_1(bytes))
    throw IO_error(path.string() + ": glTF 1.0, of which nothing is read; write it as glTF 2.0");
  if (!is_loaded)
    throw IO_error(path.string() + ": " + (error.empty() ? "not a glTF file" : one_line(error)));
  return model;
}

} // namespace Atlas::internal

#endif
