// SPDX-License-Identifier: MIT
// What the parts of the program share.
#ifndef TEXTURE_ATLAS_H
#define TEXTURE_ATLAS_H

#include <Atlas/Atlas_report.h>
#include <Atlas/Execution.h>
#include <Atlas/IO/Polygon_soup.h>
#include <Atlas/IO/Source_textures.h>
#include <Atlas/Packing.h>
#include <Atlas/Surface.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

/// What the texture of the model shows, or a further picture beside it.
enum class Bake { colors, texture, normals, occlusion };

struct Options
{
  std::string mesh, output, report, picture;
  std::string mode = "standard", measure, effort = "fast", rotation = "any";
  double max_distortion = 0, hard_angle = 0, min_chart_texels = 0; ///< 0: not given
  std::size_t max_charts = 0;
  std::string texture_size = std::to_string(Atlas::default_texture_size);
  Atlas::Page_options page; ///< with the texture size as width and height once the options are complete
  unsigned threads = 0;
  std::vector<Bake> bakes;
  bool keeps_uv = false, separates_materials = false, is_quiet = false, shows_progress = false;

  bool has(Bake bake) const;
};

/// Makes the atlas. `uv` gets the coordinates per corner of the model.
Atlas::Atlas_report make_atlas(const Options& options, const Atlas::Polygon_soup& model,
                               Atlas::Surface& surface, std::vector<Atlas::Point_2>& uv,
                               const std::function<bool(Atlas::Stage, double)>& progress);

/// Writes everything or nothing; nothing once cancelled. `source` are the textures that the model had.
/// Returns the names of what has been written.
std::vector<std::string> write_outputs(const Options& options, Atlas::Polygon_soup& model,
                                       const Atlas::Atlas_report& report,
                                       const Atlas::Source_textures& source,
                                       const Atlas::Execution& execution);

#endif
