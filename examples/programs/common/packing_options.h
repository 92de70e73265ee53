// SPDX-License-Identifier: MIT
// The options for pages and packing that texture_atlas and repack_atlas share.
#ifndef PACKING_OPTIONS_H
#define PACKING_OPTIONS_H

#include <Atlas/core/Packing.h>
#include <Atlas/packing/Raster_packer.h>

#include "Material_rules.h"
#include <string>

namespace CLI {
class App;
}

/// What the options say.
struct Packing_options
{
  std::string texture_size = std::to_string(Atlas::default_texture_size);
  Atlas::Page_options page; ///< with the texture size as width and height once the options are complete
  std::string up;           ///< an axis of the model; empty: none
  Atlas::Packing_effort effort = Atlas::Packing_effort::fast;
  Material_rules materials;
};

/// Adds the options to those of a program.
void add_packing_options(CLI::App& app, Packing_options& options);

/// Sets what depends on several options, and refuses what cannot be. \throw CLI::ValidationError
void complete(Packing_options& options);

/// Tells on stderr if charts have fewer texels per unit than was asked for, since one is larger than a page.
void tell_lower_density(const char* program, const Packing_options& options, double density);

#endif
