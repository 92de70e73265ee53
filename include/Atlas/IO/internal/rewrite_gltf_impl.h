// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_REWRITE_GLTF_IMPL_H
#define ATLAS_IO_INTERNAL_REWRITE_GLTF_IMPL_H

#include <Atlas/IO/internal/Gltf_document.h>
#include <Atlas/IO/internal/Gltf_numbers.h>
#include <Atlas/IO/internal/read_gltf.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/soup/internal/index_uv.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <tiny_gltf.h>
#include <utility>
#include <vector>

namespace Atlas {

namespace internal {

/// A primitive with new coordinates: its old vertices, and copies of some of them behind.
struct Rewritten_primitive
{
  std::vector<Index> original;        ///< per vertex beyond the old ones: the old one that it copies
  std::vector<Point_2> uv;            ///< per vertex; the origin where no face has it
  std::vector<std::uint32_t> indices; ///< three per triangle
  bool has_new_indices = false;
  bool operator==(const Rewritten_primitive&) const = default;
};

/// \brief Writes new coordinates into a glTF document.
class Gltf_rewriter
{
public:
  using Json = Gltf_document::Json;

  Gltf_rewriter(const std::filesystem::path& path, const Polygon_soup& soup, const Gltf_changes& changes)
      : reader_(path), old_(reader_.read()), soup_(soup), changes_(changes),
        numbers_(reader_.model(), path.string()), document_(path, reader_.model())
  {
    require(soup.first == old_.first && soup.points.size() == old_.points.size() &&
                soup.uv.size() == soup.number_of_corners(),
            "soup", "must be what has been read from the file, with a coordinate per corner");
  }

  std::string bytes()
  {
    rewrite_meshes();
    move_texture_sets();
    if (!changes_.base_color_png.empty())
      replace_base_colors();
    return document_.bytes();
  }

private:
  const tinygltf::Primitive& primitive_of(const Gltf_part& part) const
  {
    return reader_.model().meshes[static_cast<std::size_t>(part.mesh)].primitives[part.primitive];
  }

  /// What the soup says of a primitive, as its node shows it.
  Rewritten_primitive rewritten(const Gltf_part& part) const
  {
    const tinygltf::Primitive& primitive = primitive_of(part);
    const auto position = primitive.attributes.find("POSITION");
    const std::size_t count =
        position == primitive.attributes.end()
            ? 0
            : reader_.model().accessors[static_cast<std::size_t>(position->second)].count;
    Rewritten_primitive result;
    if (part.first_face == part.end_face)
      return result;
    result.uv.assign(count, Point_2(NAN, NAN));
    Row_table<3> copies(count);
    for (std::size_t f = part.first_face; f < part.end_face; ++f) {
      const auto face = soup_.face(f);
      if (std::find(face.begin(), face.end(), no_index) != face.end())
        continue; // it names a vertex that does not exist
      for (const std::size_t k : {0, part.is_mirrored ? 2 : 1, part.is_mirrored ? 1 : 2}) {
        const auto v = static_cast<Index>(face[k] - part.first_vertex);
        result.indices.push_back(vertex_with(v, soup_.uv[soup_.first[f] + k], count, copies, result));
      }
    }
    if (result.indices.empty())
      numbers_.fail("all triangles of a mesh name vertices that do not exist");
    for (Point_2& p : result.uv)
      if (std::isnan(p.x()))
        p = Point_2(0, 0);
    const bool is_list = primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode == -1;
    result.has_new_indices = !is_list || result.indices != old_indices(primitive, count);
    return result;
  }

  /// The vertex of a corner: the old one for the first coordinates that it meets, a copy for all others.
  static std::uint32_t vertex_with(Index v, const Point_2& uv, std::size_t count, Row_table<3>& copies,
                                   Rewritten_primitive& result)
  {
    const Point_2 p = std::isfinite(uv.x()) && std::isfinite(uv.y()) ? uv : Point_2(0, 0);
    if (std::isnan(result.uv[v].x()))
      result.uv[v] = p;
    if (result.uv[v] == p)
      return v;
    const Index copy =
        copies({v, std::bit_cast<std::uint64_t>(p.x() + 0.0), std::bit_cast<std::uint64_t>(p.y() + 0.0)});
    if (copy == result.original.size()) {
      result.original.push_back(v);
      result.uv.push_back(p);
    }
    return static_cast<std::uint32_t>(count) + copy;
  }

  std::vector<std::uint32_t> old_indices(const tinygltf::Primitive& primitive, std::size_t count) const
  {
    std::vector<std::uint32_t> result;
    if (primitive.indices < 0)
      for (std::size_t i = 0; i + 2 < count; i += 3)
        result.insert(result.end(), {std::uint32_t(i), std::uint32_t(i + 1), std::uint32_t(i + 2)});
    else
      for (const double index : numbers_.of(primitive.indices, 1))
        result.push_back(static_cast<std::uint32_t>(index));
    return result;
  }

  /// Each mesh is rewritten once for all nodes that show it with the same coordinates.
  void rewrite_meshes()
  {
    using Variant = std::pair<Json::size_type, std::vector<Rewritten_primitive>>;
    std::map<int, std::vector<Variant>> variants; // of a mesh of the file
    const auto& parts = reader_.parts();
    Json& meshes = document_.json["meshes"];
    const Json old_meshes = meshes;
    for (std::size_t i = 0, end = 0; i < parts.size(); i = end) {
      std::vector<Rewritten_primitive> primitives;
      for (; end < parts.size() && parts[end].node == parts[i].node; ++end)
        primitives.push_back(rewritten(parts[end]));
      auto& known = variants[parts[i].mesh];
      auto same =
          std::find_if(known.begin(), known.end(), [&](const Variant& v) { return v.second == primitives; });
      if (same == known.end()) {
        const auto mesh = static_cast<std::size_t>(parts[i].mesh);
        if (!known.empty())
          meshes.push_back(old_meshes[mesh]);
        known.emplace_back(known.empty() ? mesh : meshes.size() - 1, std::move(primitives));
        same = known.end() - 1;
        for (std::size_t k = i; k < end; ++k)
          if (parts[k].first_face < parts[k].end_face)
            write_primitive(same->second[k - i], meshes[same->first]["primitives"][parts[k].primitive]);
      }
      document_.json["nodes"][static_cast<std::size_t>(parts[i].node)]["mesh"] = same->first;
    }
  }

  void write_primitive(const Rewritten_primitive& primitive, Json& json)
  {
    if (primitive.has_new_indices) {
      json["indices"] = add_indices(primitive.indices);
      json.erase("mode");
    }
    if (!json.contains("material") && !changes_.base_color_png.empty())
      json["material"] = material_of_none();
    collect_materials(json);
    if (!primitive.original.empty()) {
      for (Json& accessor : json["attributes"])
        accessor = extended(accessor.get<int>(), primitive.original);
      if (json.contains("targets"))
        for (Json& target : json["targets"])
          for (Json& accessor : target)
            accessor = extended(accessor.get<int>(), primitive.original);
    }
    if (json.contains("targets"))
      for (Json& target : json["targets"])
        move_sets(target);
    Json& attributes = json["attributes"];
    if (!changes_.base_color_png.empty())
      for (int n = 0; attributes.contains("COLOR_" + std::to_string(n)); ++n)
        attributes.erase("COLOR_" + std::to_string(n));
    move_sets(attributes);
    const std::size_t coordinates = add_coordinates(primitive.uv);
    for (int n = 0; n <= changes_.uv_set; ++n) // numbers must not have gaps
      if (const std::string name = "TEXCOORD_" + std::to_string(n);
          n == changes_.uv_set || !attributes.contains(name))
        attributes[name] = coordinates;
    order_sets(attributes);
  }

  /// Puts the sets of coordinates in the order of their numbers: there are readers that refuse another one.
  static void order_sets(Json& attributes)
  {
    for (int n = 0; attributes.contains("TEXCOORD_" + std::to_string(n)); ++n) {
      const std::string name = "TEXCOORD_" + std::to_string(n);
      const Json accessor = attributes[name];
      attributes.erase(name);
      attributes[name] = accessor;
    }
  }

  /// Sets of coordinates from the new one on move up by one.
  void move_sets(Json& attributes) const
  {
    const auto name = [](int n) { return "TEXCOORD_" + std::to_string(n); };
    int end = changes_.uv_set;
    while (attributes.contains(name(end)))
      ++end;
    for (int n = end; n > changes_.uv_set; --n)
      attributes[name(n)] = Json(attributes[name(n - 1)]);
    if (end > changes_.uv_set)
      attributes.erase(name(changes_.uv_set));
  }

  std::size_t add_accessor(Json accessor, std::string bytes, int target)
  {
    accessor["bufferView"] = document_.add_view(std::move(bytes), target);
    document_.json["accessors"].push_back(std::move(accessor));
    return document_.json["accessors"].size() - 1;
  }

  std::size_t add_indices(const std::vector<std::uint32_t>& indices)
  {
    std::string bytes(indices.size() * sizeof(std::uint32_t), '\0');
    std::memcpy(bytes.data(), indices.data(), bytes.size());
    return add_accessor({{"componentType", TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT},
                         {"count", indices.size()},
                         {"type", "SCALAR"}},
                        std::move(bytes), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  }

  std::size_t add_coordinates(const std::vector<Point_2>& uv)
  {
    std::vector<float> values;
    for (const Point_2& p : uv) { // the origin is top left in glTF
      values.push_back(static_cast<float>(p.x()));
      values.push_back(static_cast<float>(1 - p.y()));
    }
    std::string bytes(values.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return add_accessor(
        {{"componentType", TINYGLTF_COMPONENT_TYPE_FLOAT}, {"count", uv.size()}, {"type", "VEC2"}},
        std::move(bytes), TINYGLTF_TARGET_ARRAY_BUFFER);
  }

  /// An accessor with copies of some of its rows behind it. Rows start at multiples of four bytes.
  std::size_t extended(int index, const std::vector<Index>& original)
  {
    const std::string rows = numbers_.rows(index);
    const std::size_t count = numbers_.item(reader_.model().accessors, index, "accessor").count;
    if (count == 0)
      numbers_.fail("accessor " + std::to_string(index) + " is empty");
    const std::size_t width = rows.size() / count, stride = (width + 3) / 4 * 4;
    std::string bytes;
    const auto append = [&](std::size_t row) {
      bytes.append(rows, row * width, width);
      bytes.resize(bytes.size() + stride - width, '\0');
    };
    for (std::size_t row = 0; row < count; ++row)
      append(row);
    for (const Index row : original)
      append(std::min<std::size_t>(row, count - 1));
    Json accessor = document_.json["accessors"][static_cast<std::size_t>(index)];
    for (const char* key : {"byteOffset", "sparse"})
      accessor.erase(key);
    accessor["count"] = count + original.size();
    const std::size_t result =
        add_accessor(std::move(accessor), std::move(bytes), TINYGLTF_TARGET_ARRAY_BUFFER);
    if (stride != width)
      document_.json["bufferViews"].back()["byteStride"] = stride;
    return result;
  }

  /// The material of primitives that have none, which is glTF's default.
  std::size_t material_of_none()
  {
    if (material_of_none_ == no_index) {
      document_.json["materials"].push_back({{"name", default_material_name}});
      material_of_none_ = static_cast<Index>(document_.json["materials"].size() - 1);
    }
    return material_of_none_;
  }

  /// All materials that an item names, variants included.
  void collect_materials(const Json& item)
  {
    if (!item.is_structured())
      return;
    for (const auto& [key, value] : item.items())
      if (key == "material" && value.is_number_unsigned())
        materials_.insert(value.get<std::size_t>());
      else
        collect_materials(value);
  }

  /// Textures go on to show the set of coordinates that they did.
  void move_texture_sets()
  {
    for (const std::size_t m : materials_)
      if (m < document_.json["materials"].size())
        move_texture_sets(document_.json["materials"][m]);
  }

  void move_texture_sets(Json& item) const
  {
    if (!item.is_structured())
      return;
    const auto move = [&](Json& holder) {
      if (const int set = holder.value("texCoord", 0); set >= changes_.uv_set)
        holder["texCoord"] = set + 1;
    };
    for (auto& [key, value] : item.items())
      if (key != "extras")
        move_texture_sets(value);
    if (!item.is_object() || !item.contains("index"))
      return;
    move(item);
    if (item.contains("extensions") && item["extensions"].contains("KHR_texture_transform"))
      if (Json& transform = item["extensions"]["KHR_texture_transform"]; transform.contains("texCoord"))
        move(transform);
  }

  void replace_base_colors()
  {
    Json& json = document_.json;
    json["samplers"].push_back({{"magFilter", TINYGLTF_TEXTURE_FILTER_LINEAR},
                                {"minFilter", TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR},
                                {"wrapS", TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE},
                                {"wrapT", TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE}});
    json["textures"].push_back({{"sampler", json["samplers"].size() - 1},
                                {"source", document_.add_picture(changes_.base_color_png)}});
    for (const std::size_t m : materials_) {
      if (m >= json["materials"].size())
        continue;
      Json& surface = json["materials"][m]["pbrMetallicRoughness"];
      surface["baseColorTexture"] = {{"index", json["textures"].size() - 1}};
      if (changes_.uv_set != 0)
        surface["baseColorTexture"]["texCoord"] = changes_.uv_set;
      if (changes_.has_base_factors)
        surface.erase("baseColorFactor");
      replace_diffuse_color(json["materials"][m], surface["baseColorTexture"]);
    }
  }

  /// Of programs that know KHR_materials_pbrSpecularGlossiness and prefer it.
  void replace_diffuse_color(Json& material, const Json& texture) const
  {
    const char* const name = "KHR_materials_pbrSpecularGlossiness";
    if (!material.contains("extensions") || !material["extensions"].contains(name))
      return;
    Json& surface = material["extensions"][name];
    surface["diffuseTexture"] = texture;
    if (changes_.has_base_factors)
      surface.erase("diffuseFactor");
  }

  Gltf_reader reader_;
  Polygon_soup old_;
  const Polygon_soup& soup_;
  const Gltf_changes& changes_;
  Gltf_numbers numbers_;
  Gltf_document document_;
  std::set<std::size_t> materials_; ///< of what has been rewritten
  Index material_of_none_ = no_index;
};

} // namespace internal

ATLAS_INLINE std::string glb_bytes(const std::filesystem::path& original, const Polygon_soup& soup,
                                   const Gltf_changes& changes)
{
  return internal::Gltf_rewriter(original, soup, changes).bytes();
}

} // namespace Atlas

#endif
