// SPDX-License-Identifier: MIT
// Pictures of what is baked.
#ifndef BAKES_H
#define BAKES_H

#include <Atlas/bake/bake_ambient_occlusion.h>
#include <Atlas/bake/bake_texture.h>
#include <Atlas/bake/internal/heights.h>
#include <Atlas/bake/internal/texel_shader.h>
#include <Atlas/core/Execution.h>
#include <Atlas/image/Image.h>

#include "texture_atlas.h"
#include <optional>
#include <string>
#include <vector>

/// Pictures of all pages, and what their files are called.
struct Textures
{
  std::vector<Atlas::Image> pages;
  std::string suffix;
  std::optional<Atlas::internal::Seams_closed> seams; ///< if they were to be closed
};

/// What files of that end in.
const char* suffix_of(Bake what);

namespace CLI {
class App;
}

/// Declares the options for pictures and bakes.
void add_picture_options(CLI::App& app, Options& options);

/// Bakes the pages of the model, from itself or from the mesh that has been given for it.
class Baker
{
public:
  /// \param size  of the pages. The input must outlive the baker
  Baker(const Options& options, const Input& input, Atlas::Image_size size);

  Atlas::Image_size size() const { return size_; }

  /// Of all but the displacement.
  Textures operator()(Bake what, const Atlas::Execution& execution) const;

  /// The heights of the mesh that has been given.
  /// \param seams  output: set if they were to be closed
  Atlas::internal::Height_maps heights(std::optional<Atlas::internal::Seams_closed>& seams,
                                       const Atlas::Execution& execution) const;

  /// What a texel shows of that, without alpha.
  Atlas::Bake_shader shader(Bake what) const;

  /// How much a texel of the texture hides, as a grey.
  Atlas::Bake_shader opacity() const;

private:
  /// What is baked: the model, or the mesh that has been given for it.
  const Atlas::Polygon_soup& shown() const;
  /// What a shader shows at the place that is baked.
  template <typename Shader>
  Shader at_place(Shader shader) const;
  /// What a texel shows of the old textures, with alpha.
  Atlas::internal::Texel_shader texels() const;
  Atlas::Image image(Bake what, Atlas::Index page, const Atlas::Execution& execution) const;
  Atlas::Polygon_soup welded_model() const;

  const Input& input_;
  Atlas::Image_size size_;
  bool is_seamless_;
  Atlas::Bake_place place_; ///< on the other mesh; empty: there is none
};

#endif
