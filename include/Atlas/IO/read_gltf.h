// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_READ_GLTF_H
#define ATLAS_IO_READ_GLTF_H

#include <Atlas/image/internal/Text_scanner.h>
#include <Atlas/soup/Polygon_soup.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <filesystem>
#include <string>
#include <tiny_gltf.h>
#include <utility>
#include <vector>

namespace Atlas {

namespace internal {

/// A message of tinygltf without line ends.
inline std::string one_line(std::string text)
{
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
    text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// Parses a glTF file, text or binary, with the loader's way to load pictures. \throw IO_error
inline tinygltf::Model load_gltf(const std::filesystem::path& path, tinygltf::TinyGLTF& loader)
{
  const std::string bytes = read_whole_file(path), folder = path.parent_path().string();
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

class Gltf_reader
{
public:
  explicit Gltf_reader(const std::filesystem::path& path) : name_(path.string())
  {
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(&skip_image, nullptr);
    model_ = load_gltf(path, loader);
    for (const std::string& extension : model_.extensionsRequired)
      if (extension != "KHR_mesh_quantization" && extension != "KHR_texture_transform" &&
          extension.rfind("KHR_materials_", 0) != 0)
        fail("needs the extension " + extension + ", which is not supported");
  }

  Polygon_soup read()
  {
    for (const auto& material : model_.materials)
      soup_.material_names.push_back(material.name);
    std::vector<int> roots;
    if (model_.scenes.empty())
      roots = nodes_without_parent();
    else
      roots = item(model_.scenes, std::max(model_.defaultScene, 0), "scene").nodes;
    read_nodes(roots);
    if (soup_.number_of_faces() == 0)
      fail("no face in the file");
    finish();
    return std::move(soup_);
  }

private:
  using Matrix = Eigen::Matrix4d;

  /// Pictures are not needed.
  static bool skip_image(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*,
                         int, void*)
  {
    return true;
  }

  [[noreturn]] void fail(const std::string& message) const { throw IO_error(name_ + ": " + message); }

  template <typename Item>
  const Item& item(const std::vector<Item>& items, int i, const char* what) const
  {
    if (i < 0 || static_cast<std::size_t>(i) >= items.size())
      fail(std::string("refers to ") + what + " " + std::to_string(i) + ", which does not exist");
    return items[static_cast<std::size_t>(i)];
  }

  std::vector<int> nodes_without_parent() const
  {
    std::vector<bool> is_child(model_.nodes.size(), false);
    for (const auto& node : model_.nodes)
      for (const int c : node.children)
        if (c >= 0 && static_cast<std::size_t>(c) < is_child.size())
          is_child[static_cast<std::size_t>(c)] = true;
    std::vector<int> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i)
      if (!is_child[i])
        roots.push_back(static_cast<int>(i));
    return roots;
  }

  static Matrix transformation(const tinygltf::Node& node)
  {
    if (node.matrix.size() == 16)
      return Eigen::Map<const Matrix>(node.matrix.data());
    Eigen::Affine3d t = Eigen::Affine3d::Identity();
    if (node.translation.size() == 3)
      t.translate(Eigen::Map<const Eigen::Vector3d>(node.translation.data()));
    if (node.rotation.size() == 4)
      t.rotate(Eigen::Quaterniond(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]));
    if (node.scale.size() == 3)
      t.scale(Eigen::Map<const Eigen::Vector3d>(node.scale.data()));
    return t.matrix();
  }

  /// Walks the forest in the order of the file; a node that is met twice is an error, so that it ends.
  void read_nodes(const std::vector<int>& roots)
  {
    std::vector<bool> is_seen(model_.nodes.size(), false);
    std::vector<std::pair<int, Matrix>> stack;
    for (auto it = roots.rbegin(); it != roots.rend(); ++it)
      stack.emplace_back(*it, Matrix::Identity());
    while (!stack.empty()) {
      const auto [n, parent] = stack.back();
      stack.pop_back();
      const tinygltf::Node& node = item(model_.nodes, n, "node");
      if (is_seen[static_cast<std::size_t>(n)])
        fail("node " + std::to_string(n) + " has two parents");
      is_seen[static_cast<std::size_t>(n)] = true;
      const Matrix matrix = parent * transformation(node);
      if (node.mesh >= 0)
        read_mesh(item(model_.meshes, node.mesh, "mesh"), node.name, matrix);
      for (auto it = node.children.rbegin(); it != node.children.rend(); ++it)
        stack.emplace_back(*it, matrix);
    }
  }

  void read_mesh(const tinygltf::Mesh& mesh, const std::string& node_name, const Matrix& matrix)
  {
    soup_.group_names.push_back(node_name.empty() ? mesh.name : node_name);
    for (const tinygltf::Primitive& primitive : mesh.primitives)
      if (primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
          primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN || primitive.mode == -1)
        read_primitive(primitive, matrix);
  }

  /// An attribute of the primitive as numbers, `width` a vertex; empty if it has none.
  std::vector<double> attribute(const tinygltf::Primitive& primitive, const char* name,
                                std::size_t width) const
  {
    const auto it = primitive.attributes.find(name);
    return it == primitive.attributes.end() ? std::vector<double>() : numbers(it->second, width);
  }

  /// The coordinates of the base colour, if the material tells and the primitive has them; else the first.
  const char* texcoord_name(const tinygltf::Primitive& primitive) const
  {
    const bool has_material =
        primitive.material >= 0 && static_cast<std::size_t>(primitive.material) < model_.materials.size();
    const bool is_second = has_material && model_.materials[static_cast<std::size_t>(primitive.material)]
                                                   .pbrMetallicRoughness.baseColorTexture.texCoord == 1;
    return is_second && primitive.attributes.count("TEXCOORD_1") ? "TEXCOORD_1" : "TEXCOORD_0";
  }

  void read_primitive(const tinygltf::Primitive& primitive, const Matrix& matrix)
  {
    const auto offset = static_cast<Index>(soup_.points.size());
    const std::vector<double> position = attribute(primitive, "POSITION", 3);
    const std::size_t n = position.size() / 3;
    for (std::size_t i = 0; i < n; ++i) {
      const Eigen::Vector4d p =
          matrix * Eigen::Vector4d(position[3 * i], position[3 * i + 1], position[3 * i + 2], 1);
      soup_.points.emplace_back(p.x(), p.y(), p.z());
    }
    add_colors(primitive, n);
    add_normals(attribute(primitive, "NORMAL", 3), matrix, n);
    const std::vector<double> texture = attribute(primitive, texcoord_name(primitive), 2);
    has_uv_ |= !texture.empty();
    for (std::size_t i = 0; i < n; ++i) // the origin is top left in glTF, bottom left here
      vertex_uv_.push_back(2 * i + 1 < texture.size() ? Point_2(texture[2 * i], 1 - texture[2 * i + 1])
                                                      : Point_2(NAN, NAN));

    std::vector<double> indices;
    if (primitive.indices >= 0)
      indices = numbers(primitive.indices, 1);
    else
      for (std::size_t i = 0; i < n; ++i)
        indices.push_back(static_cast<double>(i));
    add_triangles(indices, primitive.mode, offset, n, matrix.topLeftCorner<3, 3>().determinant() < 0);
    soup_.face_material.resize(soup_.number_of_faces(),
                               primitive.material < 0 ||
                                       static_cast<std::size_t>(primitive.material) >= model_.materials.size()
                                   ? no_index
                                   : static_cast<Index>(primitive.material));
    soup_.face_group.resize(soup_.number_of_faces(), static_cast<Index>(soup_.group_names.size() - 1));
  }

  void add_colors(const tinygltf::Primitive& primitive, std::size_t n)
  {
    const auto it = primitive.attributes.find("COLOR_0");
    const std::size_t before = soup_.points.size() - n;
    if (it == primitive.attributes.end()) {
      if (!soup_.colors.empty())
        soup_.colors.resize(soup_.points.size(), {1, 1, 1, 1});
      return;
    }
    const bool has_alpha = item(model_.accessors, it->second, "accessor").type == TINYGLTF_TYPE_VEC4;
    const std::size_t width = has_alpha ? 4 : 3;
    const std::vector<double> values = numbers(it->second, width);
    soup_.colors.resize(before, {1, 1, 1, 1});
    for (std::size_t i = 0; i < n; ++i) {
      std::array<float, 4> color{1, 1, 1, 1};
      for (std::size_t k = 0; k < width && i * width + k < values.size(); ++k)
        color[k] = static_cast<float>(values[i * width + k]);
      soup_.colors.push_back(color);
    }
  }

  void add_normals(const std::vector<double>& values, const Matrix& matrix, std::size_t n)
  {
    has_normals_ |= !values.empty();
    const Eigen::Matrix3d linear = matrix.topLeftCorner<3, 3>(), cofactors = linear.inverse().transpose();
    for (std::size_t i = 0; i < n; ++i) {
      Eigen::Vector3d v(NAN, NAN, NAN);
      if (3 * i + 2 < values.size())
        v = (cofactors * Eigen::Vector3d(values[3 * i], values[3 * i + 1], values[3 * i + 2])).normalized();
      soup_.normals.emplace_back(v.x(), v.y(), v.z());
    }
  }

  /// Indices of vertices that the primitive does not have become `no_index`.
  void add_triangles(const std::vector<double>& indices, int mode, Index offset, std::size_t vertices,
                     bool is_mirrored)
  {
    const auto vertex = [&](double index) {
      return index >= 0 && index < static_cast<double>(vertices) ? static_cast<Index>(index) + offset
                                                                 : no_index;
    };
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      for (const std::size_t i : {a, is_mirrored ? c : b, is_mirrored ? b : c})
        soup_.vertices.push_back(vertex(indices[i]));
      soup_.close_face();
    };
    const std::size_t n = indices.size();
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
      for (std::size_t i = 0; i + 2 < n; ++i)
        i % 2 ? add(i + 1, i, i + 2) : add(i, i + 1, i + 2);
    else if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
      for (std::size_t i = 1; i + 1 < n; ++i)
        add(0, i, i + 1);
    else
      for (std::size_t i = 0; i + 2 < n; i += 3)
        add(i, i + 1, i + 2);
  }

  /// The numbers of an accessor, normalised if it says so, sparse substitutions included.
  std::vector<double> numbers(int accessor_index, std::size_t width) const
  {
    const tinygltf::Accessor& accessor = item(model_.accessors, accessor_index, "accessor");
    if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) !=
        static_cast<int>(width))
      fail("accessor " + std::to_string(accessor_index) + " has the wrong type");
    std::vector<double> result;
    if (accessor.bufferView >= 0)
      result = view_numbers(accessor.bufferView, accessor.byteOffset, accessor.count, width,
                            accessor.componentType, accessor.normalized, true);
    else if (accessor.count <= total_bytes())
      result.assign(accessor.count * width, 0);
    else
      fail("accessor " + std::to_string(accessor_index) + " is longer than the file");
    if (accessor.sparse.isSparse)
      substitute(accessor, width, result);
    return result;
  }

  void substitute(const tinygltf::Accessor& accessor, std::size_t width, std::vector<double>& result) const
  {
    const auto& sparse = accessor.sparse;
    const auto n = static_cast<std::size_t>(std::max(sparse.count, 0));
    const auto where =
        view_numbers(sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), n, 1,
                     sparse.indices.componentType, false, false);
    const auto what =
        view_numbers(sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), n, width,
                     accessor.componentType, accessor.normalized, false);
    for (std::size_t i = 0; i < n; ++i) {
      if (!(where[i] >= 0 && where[i] < static_cast<double>(result.size() / width)))
        fail("a sparse accessor replaces what does not exist");
      const auto at = static_cast<std::size_t>(where[i]) * width;
      std::copy_n(what.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                  result.begin() + static_cast<std::ptrdiff_t>(at));
    }
  }

  std::size_t total_bytes() const
  {
    std::size_t sum = 0;
    for (const auto& buffer : model_.buffers)
      sum += buffer.data.size();
    return sum;
  }

  std::vector<double> view_numbers(int view_index, std::size_t offset, std::size_t count, std::size_t width,
                                   int type, bool is_normalized, bool may_have_stride) const
  {
    const tinygltf::BufferView& view = item(model_.bufferViews, view_index, "buffer view");
    const tinygltf::Buffer& buffer = item(model_.buffers, view.buffer, "buffer");
    const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type));
    if (size <= 0)
      fail("unknown component type " + std::to_string(type));
    const std::size_t tight = width * static_cast<std::size_t>(size);
    const std::size_t stride = may_have_stride && view.byteStride > 0 ? view.byteStride : tight;
    const std::size_t bytes = buffer.data.size();
    if (view.byteOffset > bytes || view.byteLength > bytes - view.byteOffset || count > bytes ||
        offset > view.byteLength || (count > 0 && (count - 1) * stride + tight > view.byteLength - offset))
      fail("buffer view " + std::to_string(view_index) + " is too short for what is to be read from it");
    std::vector<double> result;
    result.reserve(count * width);
    const unsigned char* const begin = buffer.data.data() + view.byteOffset + offset;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < width; ++k)
        result.push_back(
            component(begin + i * stride + k * static_cast<std::size_t>(size), type, is_normalized));
    return result;
  }

  template <typename Number>
  static Number load(const unsigned char* p)
  {
    Number value;
    std::memcpy(&value, p, sizeof value);
    return value;
  }

  double component(const unsigned char* p, int type, bool is_normalized) const
  {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return is_normalized ? std::max(load<std::int8_t>(p) / 127.0, -1.0) : load<std::int8_t>(p);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return is_normalized ? load<std::uint8_t>(p) / 255.0 : load<std::uint8_t>(p);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return is_normalized ? std::max(load<std::int16_t>(p) / 32767.0, -1.0) : load<std::int16_t>(p);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return is_normalized ? load<std::uint16_t>(p) / 65535.0 : load<std::uint16_t>(p);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load<std::uint32_t>(p);
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return static_cast<double>(load<float>(p));
    case TINYGLTF_COMPONENT_TYPE_DOUBLE:
      return load<double>(p);
    }
    fail("unknown component type " + std::to_string(type));
  }

  void finish()
  {
    const auto exists = [&](Index v) { return v < soup_.points.size(); };
    if (has_uv_)
      for (const Index v : soup_.vertices)
        soup_.uv.push_back(exists(v) ? vertex_uv_[v] : Point_2(NAN, NAN));
    if (has_normals_)
      for (const Index v : soup_.vertices)
        soup_.corner_normal.push_back(exists(v) && std::isfinite(soup_.normals[v].x()) ? v : no_index);
    else
      soup_.normals.clear();
    if (soup_.material_names.empty())
      soup_.face_material.clear();
  }

  std::string name_;
  tinygltf::Model model_;
  Polygon_soup soup_;
  std::vector<Point_2> vertex_uv_;
  bool has_uv_ = false, has_normals_ = false;
};

} // namespace internal

/// \brief Reads glTF 2.0, text or binary: all triangles of the default scene, transformed by their nodes.
/// Needs the library tinygltf. \throw IO_error for broken files and for compressed ones
inline Polygon_soup read_gltf(const std::filesystem::path& path)
{
  return internal::Gltf_reader(path).read();
}

} // namespace Atlas

#endif
