// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_LOAD_GLTF_H
#define ATLAS_IO_INTERNAL_LOAD_GLTF_H

#include <Atlas/IO/internal/find_file.h>
#include <Atlas/IO/internal/glb.h>
#include <Atlas/IO/internal/read_gltf_file.h>
#include <Atlas/core/errors.h>
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
#include <system_error>
#include <tiny_gltf.h>
#include <vector>

namespace Atlas::internal {

/// A message of tinygltf without line ends.
inline std::string one_line(std::string text)
{
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
    text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return printable(text);
}

/// \brief How tinygltf comes to the files that a glTF file names: as MTL files name theirs, see
/// `find_file()`.
class Gltf_files
{
public:
  /// Must live as long as the loader loads.
  Gltf_files(const std::filesystem::path& folder, tinygltf::TinyGLTF& loader) : folder_(folder)
  {
    set_callbacks<tinygltf::FsCallbacks>(loader);
  }

private:
  template <typename Callbacks>
  void set_callbacks(tinygltf::TinyGLTF& loader)
  {
    Callbacks callbacks{};
    callbacks.FileExists = [](const std::string& path, void* files) { return find(path, files).has_value(); };
    callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
    callbacks.ReadWholeFile = &read;
    callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                                  void*) { return false; };
    if constexpr (requires { callbacks.GetFileSizeInBytes; }) // of later versions
      callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string& path,
                                        void* files) {
        std::error_code error;
        const auto found = find(path, files);
        *size = found ? static_cast<std::size_t>(std::filesystem::file_size(*found, error)) : 0;
        return found && !error;
      };
    callbacks.user_data = this;
    loader.SetFsCallbacks(callbacks);
  }

  /// \param path  the folder and a name; tinygltf tries other folders, too
  static std::optional<std::filesystem::path> find(const std::string& path, void* files)
  {
    const std::string folder = static_cast<const Gltf_files*>(files)->folder_.string();
    const std::size_t length = folder.empty() || folder.ends_with('/') ? folder.size() : folder.size() + 1;
    if (!path.starts_with(folder) || path.size() <= length)
      return std::nullopt;
    return find_file(folder, path.substr(length));
  }

  static bool read(std::vector<unsigned char>* bytes, std::string* error, const std::string& path,
                   void* files)
  {
    try {
      const std::string contents = read_whole_file(find(path, files).value_or(path));
      bytes->assign(contents.begin(), contents.end());
      return true;
    } catch (const IO_error& exception) {
      *error += exception.what();
      return false;
    }
  }

  std::filesystem::path folder_;
};

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
  const std::string bytes = read_gltf_file(path), folder = path.parent_path().string();
  const Gltf_files files(folder, loader);
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
