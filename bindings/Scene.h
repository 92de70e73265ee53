// SPDX-License-Identifier: MIT
// What the interfaces to other languages stand on.
#ifndef ATLAS_BINDINGS_SCENE_H
#define ATLAS_BINDINGS_SCENE_H

#include <Atlas/core/Execution.h>
#include <Atlas/pipeline/Atlas_report.h>
#include <Atlas/report/write_report.h>
#include <Atlas/segmentation/smooth_borders.h>
#include <Atlas/soup/Joined_soups.h>
#include <Atlas/soup/Polygon_soup.h>
#include <Atlas/soup/internal/atlas_of_soup.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace Atlas::bindings {

using Progress = std::function<bool(Stage, double)>;

/// What can be asked for. Materials are numbers of the user, `rules` is left empty.
struct Scene_options : internal::Soup_options
{
  std::map<Index, internal::Material_rule> rules_of_materials;
  bool turns_faces = false; ///< the faces of the scene are turned around first. \see `orient_faces()`
  double time_limit = 0;    ///< seconds; 0: none
  double weld = 0; ///< vertices nearer than this share of their mesh's size are one; 0: only equal ones
  std::optional<Seam_hiding> hiding; ///< who shall not see seams
};

/// A mesh of the scene. Materials are numbers of the user.
struct Scene_mesh
{
  Polygon_soup soup;
  std::vector<std::array<Index, 2>> seams, forbidden_seams; ///< edges, by their two vertices
  std::vector<double>
      visibility;             ///< per vertex, in [0, 1]: how much it is seen, or empty. \see `hide_seams()`
  std::vector<bool> selected; ///< per face: whether it is unwrapped anew; empty: all are
  std::vector<bool> pinned;   ///< per corner: whether it keeps its coordinates; empty: none does
};

/// What became of a mesh.
struct Mesh_result
{
  std::vector<float> corner_uvs; ///< two per corner
  std::vector<Index> vmapping;   ///< per new vertex: the vertex that it was
  std::vector<float> uvs;        ///< two per new vertex
  std::vector<Index> indices;    ///< per corner: its new vertex
  std::vector<Index> triangles;  ///< three new vertices per triangle of the polygons
  std::vector<Index> face_of_triangle;
  std::vector<Index> face_charts; ///< per face; `no_index`: the face was rejected
  std::vector<Index> face_pages;
  std::vector<Index> turned_faces; ///< faces that were turned around, and are so here
};

/// The figures of a scene with coordinates.
struct Scene_summary
{
  Atlas_status status = Atlas_status::no_surface;
  std::size_t charts = 0, pages = 0;
  Index width = 0, height = 0; ///< of a page, texels
  double density = 0;          ///< texels per unit
  double efficiency = 0;       ///< share of the pages that is covered
};

/// \brief Meshes that share one atlas.
class Scene
{
public:
  /// \throws Invalid_argument that names the array that does not fit
  void add(Scene_mesh mesh);

  std::size_t size() const { return meshes_.size(); }
  const Polygon_soup& soup(std::size_t mesh) const { return meshes_[mesh].soup; }

  /// Makes the atlas. There are results unless it was cancelled or nothing could be mapped.
  Atlas_status generate(const Scene_options& options, const Progress& progress = {});

  /// Packs the coordinates that the meshes came with.
  Atlas_status pack(const Scene_options& options, const Progress& progress = {});

  /// Examines the coordinates that the meshes came with; there are no results then, only a report.
  Atlas_status verify(const Scene_options& options, Uv_precision precision);

  /// Of the last call.
  const Scene_summary& summary() const { return summary_; }
  const Json& report() const { return report_; }
  bool is_out_of_time() const { return is_out_of_time_; }

  /// Empty unless the last call made coordinates; else one for each mesh. They outlive the scene.
  const std::shared_ptr<std::vector<Mesh_result>>& results() const { return results_; }

  /// All meshes as one soup with the coordinates of the atlas, those that it came with as `old_uv`.
  Polygon_soup textured() const;

  /// The places of the vertices of `textured()`, as the last call has welded them.
  std::vector<Point_3> welded_points() const;

private:
  /// The meshes as one: the surface, and a soup of which only coordinates, materials and pages are
  /// filled.
  struct Input
  {
    Surface surface;
    Polygon_soup joined; ///< empty for a single mesh, which is its own
    const Polygon_soup* soup = nullptr;
    std::vector<std::size_t> first_triangle{0}; ///< per mesh; one more closes
  };

  void start(const Scene_options& options, Input& input);
  void turn_faces(std::size_t mesh, std::vector<Point_3>& welded_points);
  void join_attributes(Input& input) const;
  void hide_seams_of(Surface& surface, const Scene_options& options) const;
  std::optional<std::vector<bool>> joined(std::vector<bool> Scene_mesh::*list,
                                          std::size_t (Polygon_soup::*count)() const, bool missing) const;
  internal::Soup_options by_our_numbers(const Scene_options& options) const;
  Progress within_time(const Scene_options& options, const Progress& progress);
  void require_uv() const;
  void keep(const Input& input, const std::vector<Point_2>& uv, const std::vector<Index>& face_chart,
            const std::vector<Index>& face_page);

  std::vector<Scene_mesh> meshes_;
  std::vector<std::vector<Index>> turned_faces_; ///< per mesh
  std::map<Index, Index> material_;              ///< the number of the user, and ours, without gaps
  std::shared_ptr<std::vector<Mesh_result>> results_ = std::make_shared<std::vector<Mesh_result>>();
  Scene_summary summary_;
  Json report_;
  double weld_ = 0; ///< of the last call
  bool is_out_of_time_ = false;
};

} // namespace Atlas::bindings

#endif
