// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_POLYGON_SOUP_H
#define ATLAS_SOUP_POLYGON_SOUP_H

#include <Atlas/core/Kernel.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace Atlas {

/// \brief What a mesh file says, in the order in which it says it. Nothing is repaired, joined or left out.
///
/// Faces may be anything: indices of vertices that do not exist are kept (an index that cannot be expressed
/// becomes `no_index`); `build_surface()` sorts such faces out. Attributes that the file does not have are
/// empty.
struct Polygon_soup
{
  std::vector<Point_3> points; ///< per vertex: position, unit of the model
  std::vector<std::size_t> first{
      0};                      ///< per face: where its corners start in `vertices`; one more entry closes
  std::vector<Index> vertices; ///< per corner: its vertex

  std::vector<std::array<float, 4>> colors;      ///< per vertex: red, green, blue, alpha in [0, 1], as sRGB
                                                 ///< like pictures; or empty
  std::vector<std::array<float, 4>> face_colors; ///< per face, as `colors`; or empty
  std::vector<Point_2> uv; ///< per corner: existing coordinates, origin bottom left, NaN where none; or empty
  std::vector<Index> face_page;     ///< per face: the page that its coordinates are on; empty: all on page 0
  std::vector<Point_2> old_uv;      ///< per corner: coordinates that `uv` has replaced, as `uv`; or empty
  std::vector<Vector_3> normals;    ///< the normals that `corner_normal` refers to
  std::vector<Index> corner_normal; ///< per corner: its normal or `no_index`; or empty

  std::vector<std::string> material_names;     ///< those that `face_material` refers to
  std::vector<Index> face_material;            ///< per face: its material or `no_index`; or empty
  std::vector<std::string> material_libraries; ///< MTL files that an OBJ file names
  std::vector<std::string> page_textures;      ///< per page: the picture that a PLY file names for it
  std::vector<std::string> group_names;        ///< those that `face_group` refers to
  std::vector<Index> face_group;               ///< per face: its group or object, or `no_index`; or empty

  std::vector<std::string> warnings; ///< what the reader passed over or took otherwise than it is written

  /// How many faces there are.
  std::size_t number_of_faces() const { return first.size() - 1; }
  /// How many corners all faces have together.
  std::size_t number_of_corners() const { return vertices.size(); }
  /// The vertices of a face.
  std::span<const Index> face(std::size_t f) const
  {
    return std::span<const Index>(vertices).subspan(first[f], first[f + 1] - first[f]);
  }
  /// The page of a face.
  Index page(std::size_t f) const { return face_page.empty() ? 0 : face_page[f]; }
  /// One more than the largest page of a face.
  Index number_of_pages() const
  {
    return face_page.empty() ? 1 : *std::max_element(face_page.begin(), face_page.end()) + 1;
  }
  /// Closes the face whose corners have been appended to `vertices`.
  void close_face() { first.push_back(vertices.size()); }
};

} // namespace Atlas

#endif
