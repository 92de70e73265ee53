// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_READ_GLTF_H
#define ATLAS_IO_INTERNAL_READ_GLTF_H

#include <Atlas/IO/internal/Gltf_numbers.h>
#include <Atlas/IO/internal/gltf_texture.h>
#include <Atlas/IO/internal/load_gltf.h>
#include <Atlas/image/internal/srgb.h>
#include <Atlas/soup/Polygon_soup.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <tiny_gltf.h>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Where in the soup the triangles of a primitive are, as a node shows it.
struct Gltf_part
{
  int node, mesh;
  std::size_t primitive; ///< of the mesh
  std::size_t first_face, end_face;
  Index first_vertex;
  bool is_mirrored; ///< by the node: triangles in the soup run the other way around
};

/// Does not decode a picture: its bytes stay as they are.
inline bool keep_picture_bytes(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                               const unsigned char* bytes, int size, void*)
{
  image->image.assign(bytes, bytes + size);
  image->as_is = true;
  return true;
}

class Gltf_reader
{
public:
  explicit Gltf_reader(const std::filesystem::path& path) : numbers_(model_, path.string())
  {
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(&keep_picture_bytes, nullptr);
    model_ = load_gltf(path, loader);
    for (const std::string& extension : model_.extensionsRequired)
      if (extension != "KHR_mesh_quantization" && extension != "KHR_texture_transform" &&
          extension.rfind("KHR_materials_", 0) != 0)
        soup_.warnings.push_back("the file requires " + extension + ", which is passed over");
  }

  Polygon_soup read()
  {
    for (const auto& material : model_.materials)
      soup_.material_names.push_back(material.name);
    std::vector<int> roots;
    if (model_.scenes.empty())
      roots = nodes_without_parent();
    else
      roots = numbers_.item(model_.scenes, std::max(model_.defaultScene, 0), "scene").nodes;
    read_nodes(roots);
    if (soup_.number_of_faces() == 0)
      numbers_.fail("no face in the file");
    finish();
    return std::move(soup_);
  }

  const tinygltf::Model& model() const { return model_; }
  /// Once it has been read.
  const std::vector<Gltf_part>& parts() const { return parts_; }

private:
  using Matrix = Eigen::Matrix4d;

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
      const tinygltf::Node& node = numbers_.item(model_.nodes, n, "node");
      if (is_seen[static_cast<std::size_t>(n)])
        numbers_.fail("node " + std::to_string(n) + " has two parents");
      is_seen[static_cast<std::size_t>(n)] = true;
      const Matrix matrix = parent * transformation(node);
      if (node.mesh >= 0)
        read_mesh(n, numbers_.item(model_.meshes, node.mesh, "mesh"), matrix);
      for (auto it = node.children.rbegin(); it != node.children.rend(); ++it)
        stack.emplace_back(*it, matrix);
    }
  }

  void read_mesh(int n, const tinygltf::Mesh& mesh, const Matrix& matrix)
  {
    const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(n)];
    soup_.group_names.push_back(node.name.empty() ? mesh.name : node.name);
    const bool is_mirrored = matrix.topLeftCorner<3, 3>().determinant() < 0;
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
      const tinygltf::Primitive& primitive = mesh.primitives[i];
      parts_.push_back({n, node.mesh, i, soup_.number_of_faces(), 0, static_cast<Index>(soup_.points.size()),
                        is_mirrored});
      if (primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
          primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN || primitive.mode == -1)
        read_primitive(primitive, matrix);
      parts_.back().end_face = soup_.number_of_faces();
    }
  }

  /// An attribute of the primitive as numbers, `width` a vertex; empty if it has none.
  std::vector<double> attribute(const tinygltf::Primitive& primitive, const std::string& name,
                                std::size_t width) const
  {
    const auto it = primitive.attributes.find(name);
    return it == primitive.attributes.end() ? std::vector<double>() : numbers_.of(it->second, width);
  }

  /// The coordinates of the base colour, if the material tells and the primitive has them; else the first.
  std::string texcoord_name(const tinygltf::Primitive& primitive) const
  {
    const auto material = static_cast<std::size_t>(primitive.material);
    const bool has_material = primitive.material >= 0 && material < model_.materials.size();
    const std::string name =
        has_material ? texcoord_of(base_color_of(model_.materials[material]).texture) : "TEXCOORD_0";
    return primitive.attributes.count(name) ? name : "TEXCOORD_0";
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
      indices = numbers_.of(primitive.indices, 1);
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
    const bool has_alpha = numbers_.item(model_.accessors, it->second, "accessor").type == TINYGLTF_TYPE_VEC4;
    const std::size_t width = has_alpha ? 4 : 3;
    const std::vector<double> values = numbers_.of(it->second, width);
    soup_.colors.resize(before, {1, 1, 1, 1});
    for (std::size_t i = 0; i < n; ++i) {
      std::array<float, 4> color{1, 1, 1, 1};
      for (std::size_t k = 0; k < width && i * width + k < values.size(); ++k)
        color[k] = static_cast<float>(k < 3 ? encoded_srgb(values[i * width + k]) : values[i * width + k]);
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

  tinygltf::Model model_;
  Gltf_numbers numbers_;
  Polygon_soup soup_;
  std::vector<Gltf_part> parts_;
  std::vector<Point_2> vertex_uv_;
  bool has_uv_ = false, has_normals_ = false;
};

/// Reads glTF 2.0, text or binary: all triangles of the default scene, transformed by their nodes.
/// \throw IO_error for broken files and for compressed ones
inline Polygon_soup read_gltf(const std::filesystem::path& path)
{
  return Gltf_reader(path).read();
}

} // namespace Atlas::internal

#endif
