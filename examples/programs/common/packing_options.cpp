// SPDX-License-Identifier: MIT
#include "packing_options.h"

#include "read_page_size.h"
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>

namespace {

/// An option whose words stand for values; the words are listed in the help.
template <typename Value>
CLI::Option* add_choice(CLI::App& app, const std::string& name, Value& value, const std::string& description,
                        const std::map<std::string, Value>& words)
{
  std::string list, chosen;
  for (const auto& [word, meaning] : words) {
    list += (list.empty() ? "" : "|") + word;
    if (meaning == value)
      chosen = word;
  }
  return app.add_option(name, value, description)
      ->transform(CLI::CheckedTransformer(words).description(list))
      ->default_str(chosen);
}

void add_page_options(CLI::App& app, Packing_options& options)
{
  using enum Atlas::Chart_rotation;
  Atlas::Page_options& page = options.page;
  app.add_option("--texture-size", options.texture_size,
                 "Size of the page in texels: one number for a square, or WIDTHxHEIGHT")
      ->capture_default_str();
  app.add_option("--gutter", page.gutter,
                 "Least distance between two charts in texels; half of it to the border of the page")
      ->check(CLI::Range(0.0, 16384.0))
      ->capture_default_str();
  app.add_option(
         "--pages", page.pages,
         "Number of pages that may be filled. Of several each has its textures; coordinates are UDIM tiles "
         "(.obj) or materials (.glb)")
      ->check(CLI::Range(1, 8999))
      ->capture_default_str();
  app.add_option("--density", page.density,
                 "Texels per unit, on as many pages as that takes. Default: the largest that fits the pages")
      ->check(CLI::PositiveNumber);
  add_choice(app, "--rotation", page.rotation,
             "How charts may turn on the page. `aligned`: those with a dominant direction lie parallel to an "
             "axis, all others as they like; `any`: as they like too, if that makes the page 2 % fuller",
             {{"aligned", aligned}, {"any", any}, {"quarter", quarter_turns}, {"none", none}});
  app.add_option(
         "--up", options.up,
         "Axis of the model that is up: charts are turned so that it is up on the page too, where they "
         "have such a direction")
      ->check(CLI::IsMember({"x", "y", "z", "-x", "-y", "-z"}));
  app.add_flag("--snap", page.snaps,
               "Put straight borders that are parallel to an axis of the page onto borders of texels");
  app.add_option("--mip-levels", page.mip_levels,
                 "Keep charts apart down to this level of a mip-map: by 2^n texels")
      ->check(CLI::Range(0, 14))
      ->capture_default_str();
  app.add_option("--block", page.block,
                 "No two charts share a block of so many texels squared: 4 for most texture compression")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
}

} // namespace

void add_packing_options(CLI::App& app, Packing_options& options)
{
  using enum Atlas::Packing_effort;
  using enum Atlas::Chart_stacking;
  add_page_options(app, options);
  add_choice(app, "--effort", options.effort, "How long to look for a tighter packing",
             {{"fast", fast}, {"normal", normal}, {"best", best}});
  add_choice(app, "--stack", options.page.stacking,
             "Put charts that are copies of one another on top of each other; `mirrored`: mirror images too",
             {{"none", Atlas::Chart_stacking::none}, {"copies", copies}, {"mirrored", copies_and_mirrored}});
  app.add_option("--weight", options.materials.weights,
                 "MATERIAL=FACTOR: the charts of a material get so many times the density of the others. May "
                 "be given several times, as the options below")
      ->allow_extra_args(false);
  app.add_option(
         "--group", options.materials.grouped,
         "MATERIAL: its charts keep the places beside each other that they have in the file, and move "
         "as one")
      ->allow_extra_args(false);
  app.add_option("--lock", options.materials.locked,
                 "MATERIAL: its charts stay where they are in the file, and the others are packed around "
                 "them")
      ->allow_extra_args(false);
}

void complete(Packing_options& options)
{
  Atlas::Page_options& page = options.page;
  read_page_size(options.texture_size, page.width, page.height);
  if (!options.up.empty())
    page.up[static_cast<std::size_t>(options.up.back() - 'x')] = options.up.size() > 1 ? -1 : 1;
  if (!(page.effective_gutter() * 2 < std::min(page.width, page.height))) // not a number fails too
    throw CLI::ValidationError("--gutter", "no room for charts between gutters of " +
                                               CLI::detail::to_string(page.effective_gutter()) + " texels");
  if (!options.materials.locked.empty() && page.width != page.height)
    throw CLI::ValidationError("--lock", "charts stay where they are on square pages only");
  check(options.materials);
}

void tell_lower_density(const char* program, const Packing_options& options, double density)
{
  constexpr double tolerance = 1e-6;
  if (density < options.page.density * (1 - tolerance))
    std::fprintf(stderr,
                 "%s: a chart at %g texels per unit is larger than a page; all charts have %g instead\n",
                 program, options.page.density, density);
}
