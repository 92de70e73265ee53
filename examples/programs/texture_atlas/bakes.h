// SPDX-License-Identifier: MIT
// Pictures of what is baked.
#ifndef BAKES_H
#define BAKES_H

#include <Atlas/bake/bake_ambient_occlusion.h>
#include <Atlas/bake/bake_texture.h>
#include <Atlas/core/Execution.h>
#include <Atlas/image/Image.h>

#include "texture_atlas.h"
#include <optional>
#include <string>
#include <vector>

/// How much the two sides of seams differed, and how much they still do.
struct Seams_closed
{
  Atlas::Seam_difference before, after;
};

/// Pictures of all pages, and what their files are called.
struct Textures
{
  std::vector<Atlas::Image> pages;
  std::string suffix;
  std::optional<Seams_closed> seams;  ///< if they were to be closed
  std::optional<double> displacement; ///< what white stands for, outwards, and black, inwards
};

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

  Textures operator()(Bake what, const Atlas::Execution& execution) const;

  /// What a texel shows of that, without alpha.
  Atlas::Bake_shader shader(Bake what) const;

private:
  Atlas::Image image(Bake what, Atlas::Index page, const Atlas::Execution& execution) const;
  void bake_displacement(Textures& result, const Atlas::Execution& execution) const;

  const Input& input_;
  Atlas::Image_size size_;
  bool is_seamless_;
  Atlas::Bake_place place_; ///< on the other mesh; empty: there is none
};

#endif
