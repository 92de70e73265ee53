// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_READ_GLTF_FILE_H
#define ATLAS_IO_INTERNAL_READ_GLTF_FILE_H

#include <Atlas/IO/internal/find_file.h>
#include <Atlas/IO/internal/glb.h>
#include <Atlas/IO/internal/gltf_bounds.h>
#include <Atlas/IO/internal/gltf_codecs.h>
#include <Atlas/core/errors.h>
#include <Atlas/image/internal/Text_scanner.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <tiny_gltf.h>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief Makes of a glTF file whose numbers are compressed a binary one that says the same without.
class Gltf_decompressor
{
public:
  using Json = nlohmann::ordered_json;

  Gltf_decompressor(std::string_view bytes, std::filesystem::path path)
      : bytes_(bytes), path_(std::move(path)), json_(Json::parse(gltf_json(bytes), nullptr, false))
  {}

  /// The file as it is, where nothing has to be decompressed. \throw IO_error
  std::string bytes()
  {
    if (!json_.is_object())
      return std::string(bytes_); // the loader says what is wrong
    try {
      if (!has_compression())
        return std::string(bytes_);
      read_buffers();
      read_views();
      read_meshes();
      for (const char* key : {"extensionsUsed", "extensionsRequired"})
        remove_names(key);
      json_["buffers"] = Json::array({{{"byteLength", data_.size()}}});
    } catch (const Json::exception&) { // of something that has another type than it should
      fail("its compressed numbers are not described as glTF wants it");
    }
    return glb_of(json_.dump(), std::move(data_));
  }

private:
  [[noreturn]] void fail(const std::string& message) const
  {
    throw IO_error(path_.string() + ": " + message);
  }

  bool is_required(const char* name) const
  {
    const Json names = json_.value("extensionsRequired", Json::array());
    return std::find(names.begin(), names.end(), name) != names.end();
  }

  /// Whether numbers are to be decompressed; fails, by name, if what decompresses them is not built in.
  bool has_compression() const
  {
    bool result = false;
    for (const Gltf_codec& codec : gltf_codecs()) {
      if (is_required(codec.extension) && !codec.is_built_in)
        fail(std::string("its numbers are compressed (") + codec.extension +
             "), which is not supported without " + codec.library + "; write it without compression");
      result = result || is_required(codec.extension);
    }
    return result;
  }

  void remove_names(const char* key)
  {
    if (!json_.contains(key))
      return;
    Json kept = Json::array();
    for (const Json& name : json_[key])
      if (std::none_of(gltf_codecs().begin(), gltf_codecs().end(),
                       [&](const Gltf_codec& codec) { return name == codec.extension; }))
        kept.push_back(name);
    if (kept.empty())
      json_.erase(key);
    else
      json_[key] = std::move(kept);
  }

  static void erase_extension(Json& item, const char* name)
  {
    item["extensions"].erase(name);
    if (item["extensions"].empty())
      item.erase("extensions");
  }

  void read_buffers()
  {
    for (const Json& buffer : json_.at("buffers")) {
      std::string& bytes = buffers_.emplace_back();
      const auto uri = buffer.value("uri", std::string());
      if (uri.empty()) {
        if (buffers_.size() == 1) // others have no bytes: they stand for decompressed ones
          bytes = std::string(gltf_data(bytes_));
      } else if (tinygltf::IsDataURI(uri)) {
        std::vector<unsigned char> data;
        std::string type;
        if (!tinygltf::DecodeDataURI(&data, type, uri, 0, false))
          fail("a buffer is not in base 64");
        bytes.assign(data.begin(), data.end());
      } else {
        const std::filesystem::path folder = path_.parent_path();
        bytes = read_whole_file(find_file(folder, uri).value_or(folder / uri));
      }
    }
  }

  /// The bytes that a view, or what compresses it, names.
  std::string_view slice(const Json& view) const
  {
    const auto number = view.at("buffer").get<std::size_t>();
    const auto offset = view.value("byteOffset", std::size_t(0)),
               length = view.at("byteLength").get<std::size_t>();
    if (number >= buffers_.size() || offset > buffers_[number].size() ||
        length > buffers_[number].size() - offset)
      fail("a buffer view is longer than its buffer");
    return std::string_view(buffers_[number]).substr(offset, length);
  }

  /// \return where it starts
  std::size_t append(std::string_view bytes)
  {
    data_.resize((data_.size() + 7) / 8 * 8, '\0');
    const std::size_t offset = data_.size();
    data_ += bytes;
    return offset;
  }

  /// What a view compresses, or stands for if that is not required.
  void read_views()
  {
    for (Json& view : json_.at("bufferViews")) {
      std::optional<std::string> decoded;
      for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
        if (view.contains("extensions") && view["extensions"].contains(name)) {
          if (is_required(name))
            decoded = decoded_view(view["extensions"][name], name);
          erase_extension(view, name);
        }
      views_.push_back(decoded ? std::move(*decoded) : std::string(slice(view)));
      view["buffer"] = 0;
      view["byteOffset"] = append(views_.back());
      view["byteLength"] = views_.back().size();
    }
  }

  std::string decoded_view(const Json& compressed, const std::string& name) const
  {
    auto rows = decode_meshopt(slice(compressed), {compressed.at("count").get<std::size_t>(),
                                                   compressed.at("byteStride").get<std::size_t>(),
                                                   compressed.at("mode").get<std::string>(),
                                                   compressed.value("filter", std::string("NONE"))});
    if (!rows)
      fail("its numbers are compressed (" + name + ") in a way that cannot be read");
    return std::move(*rows);
  }

  void read_meshes()
  {
    const char* const name = "KHR_draco_mesh_compression";
    if (!json_.contains("meshes"))
      return;
    for (Json& mesh : json_["meshes"])
      for (Json& primitive : mesh.at("primitives"))
        if (primitive.contains("extensions") && primitive["extensions"].contains(name)) {
          if (is_required(name))
            read_draco(primitive, Json(primitive["extensions"][name]));
          erase_extension(primitive, name);
        }
  }

  std::size_t add_view(std::string_view bytes)
  {
    json_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", append(bytes)}, {"byteLength", bytes.size()}});
    return json_["bufferViews"].size() - 1;
  }

  void read_draco(Json& primitive, const Json& compressed)
  {
    std::vector<Draco_attribute> wanted;
    std::vector<std::size_t> accessors;
    for (const auto& [name, id] : compressed.at("attributes").items()) {
      accessors.push_back(primitive.at("attributes").at(name).get<std::size_t>());
      const Json& accessor = json_.at("accessors").at(accessors.back());
      wanted.push_back({id.get<unsigned>(), accessor.at("componentType").get<int>(),
                        width_of(accessor.at("type").get<std::string>())});
    }
    const auto view = compressed.at("bufferView").get<std::size_t>();
    const auto mesh = view < views_.size() ? decode_draco(views_[view], wanted) : std::nullopt;
    if (!mesh)
      fail("its numbers are compressed (KHR_draco_mesh_compression) in a way that cannot be read");
    for (std::size_t i = 0; i < wanted.size(); ++i)
      fill(json_["accessors"][accessors[i]], mesh->attributes[i], mesh->points, wanted[i].width);
    const Json indices = {{"bufferView", add_view(mesh->indices)},
                          {"componentType", TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT},
                          {"count", mesh->indices.size() / 4},
                          {"type", "SCALAR"}};
    json_["accessors"].push_back(indices);
    primitive["indices"] = json_["accessors"].size() - 1;
    primitive.erase("mode"); // strips are triangles now
  }

  static std::size_t width_of(const std::string& type)
  {
    return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : 4;
  }

  /// Gives an accessor its rows; in memory they start at multiples of four bytes.
  void fill(Json& accessor, const std::string& rows, std::size_t count, std::size_t components)
  {
    renew_bounds(accessor, rows, components);
    const std::size_t width = count == 0 ? 0 : rows.size() / count, stride = (width + 3) / 4 * 4;
    std::string padded;
    for (std::size_t i = 0; i < count; ++i) {
      padded.append(rows, i * width, width);
      padded.resize((i + 1) * stride, '\0');
    }
    accessor.erase("byteOffset");
    accessor["bufferView"] = add_view(padded);
    accessor["count"] = count;
    if (stride != width)
      json_["bufferViews"].back()["byteStride"] = stride;
  }

  std::string_view bytes_;
  std::filesystem::path path_;
  Json json_;
  std::vector<std::string> buffers_, views_;
  std::string data_;
};

/// The bytes of a glTF file, text or binary, of which nothing is compressed. \throw IO_error
inline std::string read_gltf_file(const std::filesystem::path& path)
{
  std::string bytes = read_whole_file(path);
  if (!is_glb(bytes))
    bytes = utf8_of_any(std::move(bytes));
  else if (const std::size_t told = glb_size(bytes); told > bytes.size())
    throw IO_error(path.string() + ": the file ends after " + std::to_string(bytes.size()) + " of its " +
                   std::to_string(told) + " bytes");
  if (gltf_json(bytes).find("_compression\"") == std::string_view::npos)
    return bytes;
  return Gltf_decompressor(bytes, path).bytes();
}

} // namespace Atlas::internal

#endif
