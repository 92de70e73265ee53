// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_JOINED_SOUPS_H
#define ATLAS_SOUP_JOINED_SOUPS_H

#include <Atlas/core/Kernel.h>
#include <Atlas/soup/Polygon_soup.h>

#include <cstddef>
#include <string>
#include <vector>

namespace Atlas {

/// \brief Several models as one, and the way back.
///
/// Vertices, faces and corners are counted on from one model to the next, as `join_surfaces()` counts them.
/// Materials of the same name are one. Where only some models have an attribute, the others get its usual
/// value: white, no coordinates, no material.
class Joined_soups
{
public:
  explicit Joined_soups(std::vector<Polygon_soup> soups);

  /// All models as one. It may be changed as long as its lists keep their lengths, but for those of
  /// attributes, which may be filled or emptied, and as long as each vertex stays in its model.
  Polygon_soup& whole() { return whole_; }
  const Polygon_soup& whole() const { return whole_; }

  std::size_t number_of_parts() const { return parts_.size() - 1; }
  std::size_t first_vertex(std::size_t part) const { return parts_[part].vertex; }
  std::size_t first_face(std::size_t part) const { return parts_[part].face; }

  /// One of the models, as it is now.
  Polygon_soup part(std::size_t i) const;

private:
  /// Which attributes there are.
  struct Attributes
  {
    bool colors = false, face_colors = false, uv = false, normals = false, materials = false, groups = false;
  };

  /// Where a model starts in each of the lists.
  struct Part
  {
    std::size_t vertex, corner, face, normal, group;
    Attributes has;
  };

  void start_part(const Attributes& has);
  void append(Polygon_soup&& soup);

  /// Vertices that do not exist in their model must not become vertices of the next: they get numbers beyond
  /// all.
  Index common_vertex(Index v, std::size_t first, std::size_t size) const;
  Index own_vertex(Index v, std::size_t first, std::size_t end) const;

  /// The numbers that the materials of a model have in common.
  std::vector<Index> common_materials(const std::vector<std::string>& names);

  Polygon_soup whole_;
  Attributes has_;
  std::size_t number_of_points_ = 0;
  std::vector<Part> parts_; ///< one more closes
};

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/soup/internal/Joined_soups_impl.h>
#endif

#endif
