// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_WRITE_GLTF_IMPL_H
#define ATLAS_IO_INTERNAL_WRITE_GLTF_IMPL_H

#include <Atlas/IO/internal/page_material_name.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/internal/bounding_box.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/image/internal/Output_file.h>
#include <Atlas/image/internal/srgb.h>
#include <Atlas/soup/internal/split_vertices.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <sstream>
#include <tiny_gltf.h>
#include <utility>

namespace Atlas {

namespace internal {

/// A name as part of a URI (RFC 3986): all bytes but those that stand for themselves are written as %XX.
inline std::string uri_of_name(const std::string& name)
{
  constexpr const char* digits = "0123456789ABCDEF";
  std::string result;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') ||
                          (byte >= '0' && byte <= '9') || c == '-' || c == '.' || c == '_' || c == '~' ||
                          c == '/';
    if (is_plain)
      result += c;
    else
      result += {'%', digits[byte >> 4], digits[byte & 15]};
  }
  return result;
}

/// \brief Builds a glTF model with one mesh: one primitive per material and page, all of them with the same
/// vertices.
class Gltf_writer
{
public:
  Gltf_writer(const Polygon_soup& soup, const std::vector<std::string>& page_textures, Gltf_textures where)
      : soup_(soup), names_pages_(soup.number_of_pages() > 1), where_(where), split_(split_vertices(soup)),
        surface_(build_surface(soup.points, soup.first, soup.vertices))
  {
    model_.asset.version = "2.0";
    model_.asset.generator = "Atlas";
    model_.buffers.emplace_back();
    fit_into_floats();
    add_attributes();
    for (const std::string& texture : page_textures)
      add_texture(texture);
    add_primitives();
    add_node();
  }

  std::string bytes()
  {
    std::ostringstream stream(std::ios::binary);
    tinygltf::TinyGLTF writer;
    writer.SetImageWriter(nullptr, nullptr); // pictures are encoded already
    if (!writer.WriteGltfSceneToStream(&model_, stream, false, true))
      throw IO_error("cannot encode the model as glTF");
    return std::move(stream).str();
  }

private:
  /// Positions are floats in glTF. Models that are far from the origin, or too large or small for floats, are
  /// moved and scaled, and their node undoes it.
  void fit_into_floats()
  {
    const internal::Bounding_box box = internal::bounding_box(surface_);
    const double half = box.half_side;
    const auto [x, y, z] = box.center;
    if (half > 0 && std::max({std::abs(x), std::abs(y), std::abs(z)}) > 4 * half)
      center_ = box.center;
    if (half > 1e18 || (half > 0 && half < 1e-18))
      scale_ = std::ldexp(1.0, std::ilogb(half));
  }

  int add_view(const void* data, std::size_t size, int target)
  {
    auto& buffer = model_.buffers[0].data;
    buffer.resize((buffer.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = buffer.size();
    view.byteLength = size;
    view.target = target;
    const auto* const begin = static_cast<const unsigned char*>(data);
    buffer.insert(buffer.end(), begin, begin + size);
    model_.bufferViews.push_back(view);
    return static_cast<int>(model_.bufferViews.size()) - 1;
  }

  template <typename Number>
  int add_accessor(const std::vector<Number>& values, std::size_t count, int type, int component, int target)
  {
    tinygltf::Accessor accessor;
    accessor.bufferView = add_view(values.data(), sizeof(Number) * values.size(), target);
    accessor.componentType = component;
    accessor.count = count;
    accessor.type = type;
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  int add_floats(const std::vector<float>& values, int type)
  {
    return add_accessor(values, split_.number_of_vertices(), type, TINYGLTF_COMPONENT_TYPE_FLOAT,
                        TINYGLTF_TARGET_ARRAY_BUFFER);
  }

  void add_attributes()
  {
    std::vector<float> positions, uv, normals, colors;
    const auto or_zero = [](double x) { return std::isfinite(x) ? static_cast<float>(x) : 0.f; };
    for (const Index v : split_.original)
      for (int k = 0; k < 3; ++k)
        positions.push_back(or_zero((soup_.points[v][k] - center_[k]) / scale_));
    attributes_["POSITION"] = add_floats(positions, TINYGLTF_TYPE_VEC3);
    add_bounds(positions);
    for (const Point_2& p : split_.uv) { // the origin is top left in glTF
      uv.push_back(or_zero(p.x()));
      uv.push_back(or_zero(1 - p.y()));
    }
    if (!uv.empty())
      attributes_["TEXCOORD_0"] = add_floats(uv, TINYGLTF_TYPE_VEC2);
    for (const Index n : split_.normal) {
      const Vector_3 v = n == no_index ? Vector_3(0, 0, 1) : soup_.normals[n];
      const double length = std::sqrt(v.squared_length());
      for (int k = 0; k < 3; ++k)
        normals.push_back(length > 0 && std::isfinite(length) ? static_cast<float>(v[k] / length) : k == 2);
    }
    if (!normals.empty())
      attributes_["NORMAL"] = add_floats(normals, TINYGLTF_TYPE_VEC3);
    if (!soup_.colors.empty()) {
      for (const Index v : split_.original)
        for (std::size_t k = 0; k < 4; ++k) // glTF has light, and alpha as it is
          colors.push_back(k == 3
                               ? soup_.colors[v][k]
                               : static_cast<float>(decoded_srgb(static_cast<double>(soup_.colors[v][k]))));
      attributes_["COLOR_0"] = add_floats(colors, TINYGLTF_TYPE_VEC4);
    }
  }

  /// The bounds of the positions, which glTF asks for.
  void add_bounds(const std::vector<float>& positions)
  {
    tinygltf::Accessor& accessor = model_.accessors.back();
    accessor.minValues.assign(3, INFINITY);
    accessor.maxValues.assign(3, -INFINITY);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      accessor.minValues[i % 3] = std::min(accessor.minValues[i % 3], static_cast<double>(positions[i]));
      accessor.maxValues[i % 3] = std::max(accessor.maxValues[i % 3], static_cast<double>(positions[i]));
    }
  }

  /// The texture of the next page: its bytes, or the name of its file.
  void add_texture(const std::string& content)
  {
    texture_of_page_.push_back(-1);
    if (content.empty())
      return;
    if (model_.samplers.empty())
      add_sampler();
    has_alpha_ = has_alpha_ || is_png_with_alpha(content);
    tinygltf::Image image;
    if (where_ == Gltf_textures::files) {
      image.uri = uri_of_name(content);
    } else {
      image.mimeType = "image/png";
      image.bufferView = add_view(content.data(), content.size(), 0);
    }
    model_.images.push_back(image);
    tinygltf::Texture texture;
    texture.source = static_cast<int>(model_.images.size()) - 1;
    texture.sampler = 0;
    texture_of_page_.back() = static_cast<int>(model_.textures.size());
    model_.textures.push_back(texture);
  }

  /// Whether the bytes are a PNG file of colours with alpha, by its header.
  static bool is_png_with_alpha(const std::string& bytes)
  {
    return bytes.size() > 25 && bytes.compare(1, 3, "PNG") == 0 && bytes[25] == 6;
  }

  void add_sampler()
  {
    tinygltf::Sampler sampler;
    sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
    sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
    sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    model_.samplers.push_back(sampler);
  }

  /// One texture alone is that of all pages.
  int texture_of(Index page) const
  {
    if (texture_of_page_.size() == 1)
      return texture_of_page_[0];
    return page < texture_of_page_.size() ? texture_of_page_[page] : -1;
  }

  int add_material(Index number, Index page)
  {
    tinygltf::Material material;
    material.name = page_material_name(soup_, number, page, names_pages_);
    material.doubleSided = true; // meshes of any orientation are to be seen
    if (has_alpha_)
      material.alphaMode = "BLEND";
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.baseColorTexture.index = texture_of(page);
    model_.materials.push_back(material);
    return static_cast<int>(model_.materials.size()) - 1;
  }

  /// The triangles of each material and page, in the order in which faces name them first.
  void add_primitives()
  {
    using Material = std::pair<Index, Index>; // and page
    std::vector<std::vector<std::uint32_t>> lists;
    std::vector<Material> materials;
    std::map<Material, std::size_t> number;
    for (std::size_t t = 0; t < surface_.number_of_triangles(); ++t) {
      const Index f = surface_.face[t];
      const Material material{soup_.face_material.empty() ? no_index : soup_.face_material[f], soup_.page(f)};
      const auto [it, is_new] = number.try_emplace(material, lists.size());
      if (is_new) {
        lists.emplace_back();
        materials.push_back(material);
      }
      for (std::size_t i = 0; i < 3; ++i)
        lists[it->second].push_back(split_.corner[surface_.corner[3 * t + i]]);
    }
    tinygltf::Mesh mesh;
    for (std::size_t i = 0; i < lists.size(); ++i) {
      tinygltf::Primitive primitive;
      primitive.mode = TINYGLTF_MODE_TRIANGLES;
      primitive.attributes = attributes_;
      primitive.indices =
          add_accessor(lists[i], lists[i].size(), TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                       TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
      primitive.material = add_material(materials[i].first, materials[i].second);
      mesh.primitives.push_back(primitive);
    }
    model_.meshes.push_back(mesh);
  }

  void add_node()
  {
    tinygltf::Node node;
    node.mesh = 0;
    if (center_ != std::array<double, 3>{})
      node.translation.assign(center_.begin(), center_.end());
    if (scale_ != 1)
      node.scale.assign(3, scale_);
    model_.nodes.push_back(node);
    tinygltf::Scene scene;
    scene.nodes.push_back(0);
    model_.scenes.push_back(scene);
    model_.defaultScene = 0;
  }

  const Polygon_soup& soup_;
  bool names_pages_;
  Gltf_textures where_;
  Split_vertices split_;
  Surface surface_;
  tinygltf::Model model_;
  std::map<std::string, int> attributes_;
  std::vector<int> texture_of_page_; ///< -1: none
  std::array<double, 3> center_{};
  double scale_ = 1;
  bool has_alpha_ = false;
};

} // namespace internal

ATLAS_INLINE std::string glb_bytes(const Polygon_soup& soup, const std::vector<std::string>& page_textures,
                                   Gltf_textures where)
{
  return internal::Gltf_writer(soup, page_textures, where).bytes();
}

ATLAS_INLINE std::string glb_bytes(const Polygon_soup& soup, const std::string& texture_png)
{
  return glb_bytes(soup, std::vector<std::string>{texture_png});
}

ATLAS_INLINE void write_glb(const std::filesystem::path& path, const Polygon_soup& soup,
                            const std::string& texture_png)
{
  internal::write_whole_file(path, glb_bytes(soup, texture_png));
}

ATLAS_INLINE void write_glb(const std::filesystem::path& path, const Polygon_soup& soup,
                            const std::vector<std::string>& page_pngs)
{
  internal::write_whole_file(path, glb_bytes(soup, page_pngs));
}

} // namespace Atlas

#endif
