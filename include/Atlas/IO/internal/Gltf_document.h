// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_GLTF_DOCUMENT_H
#define ATLAS_IO_INTERNAL_GLTF_DOCUMENT_H

#include <Atlas/IO/internal/glb.h>
#include <Atlas/IO/internal/read_gltf_file.h>
#include <Atlas/core/errors.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <tiny_gltf.h>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief A glTF file as it is written: its JSON, of which all that nobody asks for stays as it was, and the
/// bytes of its buffer views.
class Gltf_document
{
public:
  using Json = nlohmann::ordered_json;

  /// \param model  the same file, with the bytes of its buffers and, as they are, of its pictures
  Gltf_document(const std::filesystem::path& path, const tinygltf::Model& model) : name_(path.string())
  {
    const std::string bytes = read_gltf_file(path);
    json = Json::parse(gltf_json(bytes), nullptr, false);
    if (!json.is_object())
      throw IO_error(path.string() + ": not a glTF file");
    for (const tinygltf::BufferView& view : model.bufferViews) {
      const std::vector<unsigned char>* const data =
          view.buffer >= 0 && static_cast<std::size_t>(view.buffer) < model.buffers.size()
              ? &model.buffers[static_cast<std::size_t>(view.buffer)].data
              : nullptr;
      const std::size_t there = data ? data->size() : 0, offset = std::min(view.byteOffset, there);
      is_cut_.push_back(view.byteLength > there - offset);
      if (is_cut_.back()) { // which matters only if anything shows it
        views_.emplace_back();
        continue;
      }
      views_.emplace_back();
      if (data)
        views_.back().assign(data->begin() + static_cast<std::ptrdiff_t>(offset),
                             data->begin() + static_cast<std::ptrdiff_t>(offset + view.byteLength));
    }
    for (const char* key : lists) // so that places in the JSON stay where they are
      if (!json.contains(key))
        json[key] = Json::array();
    embed_pictures(model);
  }

  /// Adds a list of bytes. \return its number
  std::size_t add_view(std::string bytes, int target = 0)
  {
    Json view = {{"buffer", 0}, {"byteLength", bytes.size()}};
    if (target != 0)
      view["target"] = target;
    views_.push_back(std::move(bytes));
    json["bufferViews"].push_back(std::move(view));
    return views_.size() - 1;
  }

  std::size_t add_picture(std::string png)
  {
    json["images"].push_back({{"mimeType", "image/png"}, {"bufferView", add_view(std::move(png))}});
    return json["images"].size() - 1;
  }

  /// Makes a binary file. Bytes that nothing names any more are left out; numbers of views stay.
  std::string bytes()
  {
    if (has_known_extensions())
      clear_unused_items();
    std::vector<bool> is_used(views_.size(), false);
    mark_views(json, is_used);
    std::string data;
    for (std::size_t i = 0; i < views_.size(); ++i) {
      Json& view = json["bufferViews"][i];
      view["buffer"] = 0;
      if (view.contains("extensions"))
        view["extensions"].erase("EXT_meshopt_compression"); // of views that are there uncompressed as well
      if (!is_used[i]) {
        view = {{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 1}};
        continue;
      }
      if (i < is_cut_.size() && is_cut_[i])
        throw IO_error(name_ + ": a buffer view is longer than its buffer");
      data.resize((data.size() + 7) / 8 * 8, '\0');
      view["byteOffset"] = data.size();
      data += views_[i];
    }
    data.resize(std::max<std::size_t>((data.size() + 3) / 4 * 4, 4), '\0');
    for (const char* key : lists)
      if (json[key].empty())
        json.erase(key);
    json["buffers"] = Json::array({{{"byteLength", data.size()}}});
    return glb_of(json.dump(), std::move(data));
  }

  Json json;

private:
  static constexpr const char* lists[] = {"accessors", "bufferViews", "images",   "materials",
                                          "meshes",    "nodes",       "samplers", "textures"};

  /// Others may name accessors and pictures in ways of their own.
  bool has_known_extensions() const
  {
    const Json names = json.value("extensionsUsed", Json::array());
    return std::all_of(names.begin(), names.end(), [](const Json& name) {
      return name.is_string() && name.get<std::string>().starts_with("KHR_");
    });
  }

  /// All numbers that stand for something of a kind in an item: by key, or all numbers below a key.
  static void collect(const Json& item, const std::set<std::string>& keys,
                      const std::set<std::string>& lists_below, std::set<std::size_t>& numbers,
                      bool takes_all = false)
  {
    if (takes_all && item.is_number_unsigned())
      numbers.insert(item.get<std::size_t>());
    if (!item.is_structured())
      return;
    for (const auto& [key, value] : item.items()) {
      if (value.is_number_unsigned() && keys.contains(key))
        numbers.insert(value.get<std::size_t>());
      if (key != "extras")
        collect(value, keys, lists_below, numbers,
                takes_all || (item.is_object() && lists_below.contains(key)));
    }
  }

  /// Numbers stay, but accessors and pictures that nothing names let go of their bytes.
  void clear_unused_items()
  {
    std::set<std::size_t> accessors, textures, pictures;
    for (const char* key : {"meshes", "animations", "skins"})
      if (json.contains(key))
        collect(json[key], {"indices", "input", "output", "inverseBindMatrices"}, {"attributes", "targets"},
                accessors);
    for (std::size_t i = 0; i < json["accessors"].size(); ++i)
      if (!accessors.contains(i))
        json["accessors"][i] = {{"componentType", 5126}, {"count", 1}, {"type", "SCALAR"}};
    collect(json["materials"], {"index"}, {}, textures);
    for (const std::size_t t : textures)
      if (t < json["textures"].size())
        collect(json["textures"][t], {"source"}, {}, pictures);
    for (std::size_t i = 0; i < json["images"].size() && !pictures.empty(); ++i)
      if (!pictures.contains(i) && json["images"][i].contains("bufferView")) {
        Json& used = json["images"][*pictures.rbegin()];
        if (used.contains("bufferView"))
          json["images"][i] = used;
      }
  }

  /// Pictures in files of their own, or in the text, become views: the result may lie in another folder.
  void embed_pictures(const tinygltf::Model& model)
  {
    for (std::size_t i = 0; i < model.images.size() && json.contains("images"); ++i) {
      const auto& bytes = model.images[i].image;
      Json& image = json["images"][i];
      if (image.contains("bufferView") || bytes.empty())
        continue;
      image.erase("uri");
      image["mimeType"] =
          mime_type(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
      image["bufferView"] = add_view(std::string(bytes.begin(), bytes.end()));
    }
  }

  static const char* mime_type(std::string_view bytes)
  {
    return bytes.starts_with("\x89PNG")                                ? "image/png"
           : bytes.starts_with("RIFF") && bytes.substr(8, 4) == "WEBP" ? "image/webp"
           : bytes.starts_with("\xABKTX 20")                           ? "image/ktx2"
                                                                       : "image/jpeg";
  }

  /// Marks the views that anything names. Where extensions have lists of their own, all numbers there count.
  static void mark_views(const Json& value, std::vector<bool>& is_used, bool is_extension = false)
  {
    const auto mark = [&](const Json& number) {
      if (number.is_number_unsigned() && number.get<std::size_t>() < is_used.size())
        is_used[number.get<std::size_t>()] = true;
    };
    if (is_extension)
      mark(value);
    if (!value.is_structured())
      return;
    for (const auto& [key, item] : value.items()) {
      if (key == "bufferView")
        mark(item);
      mark_views(item, is_used, is_extension || key == "EXT_structural_metadata");
    }
  }

  std::string name_;
  std::vector<std::string> views_;
  std::vector<bool> is_cut_; ///< of the file's views, whether they are longer than their buffers
};

} // namespace Atlas::internal

#endif
