// SPDX-License-Identifier: MIT
// Options of atlas.h, read from JSON.
#ifndef ATLAS_WASM_OPTIONS_H
#define ATLAS_WASM_OPTIONS_H

#include <Atlas/atlas.h>
#include <Atlas/core/errors.h>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace Atlas::wasm {

using Json = nlohmann::json;

/// The place of a word in the list of those that an option knows.
inline int place_of(const std::string& name, const Json& value, const std::vector<std::string>& words)
{
  const auto found =
      value.is_string() ? std::find(words.begin(), words.end(), value.get<std::string>()) : words.end();
  if (found == words.end()) {
    std::string known;
    for (const std::string& word : words)
      known += (known.empty() ? "" : ", ") + word;
    throw Invalid_argument(name, "is " + value.dump() + "; known are " + known);
  }
  return int(found - words.begin());
}

/// A whole number or a truth value for a member of that type.
template <typename Number>
void set_number(const std::string& name, const Json& value, Number& member)
{
  if (!value.is_number() && !value.is_boolean())
    throw Invalid_argument(name, "must be a number, but is " + value.dump());
  const double number = value.is_boolean() ? value.get<bool>() : value.get<double>();
  if (std::is_integral_v<Number> &&
      !(number == double(Number(number)) && number <= double(std::numeric_limits<Number>::max())))
    throw Invalid_argument(name, "must be a whole number, but is " + value.dump());
  member = Number(number);
}

/// Options by the names of atlas.h, and words for its enumerations.
class Option_reader
{
public:
  explicit Option_reader(atlas_options& options) : options_(options) {}

  void read(const std::string& name, const Json& value)
  {
    if (!read_word(name, value) && !read_number(name, value) && !read_direction(name, value) &&
        !read_stage(name, value) && name != "rules")
      throw Invalid_argument(name, "is no option");
    if (name == "rules")
      read_rules(value);
  }

private:
  bool read_word(const std::string& name, const Json& value)
  {
    const std::pair<const char*, std::pair<int*, std::vector<std::string>>> words[] = {
        {"mode", {&options_.mode, {"standard", "few-seams", "conformal", "paper"}}},
        {"measure",
         {&options_.measure,
          {"of-mode", "symmetric-dirichlet", "l2-stretch", "linf-stretch", "area-ratio",
           "area-ratio-quantiles", "quasi-conformal"}}},
        {"rotation", {&options_.rotation, {"aligned", "free", "any", "quarter", "none"}}},
        {"stack", {&options_.stack, {"none", "copies", "mirrored"}}},
        {"effort", {&options_.effort, {"fast", "normal", "best"}}},
        {"symmetry", {&options_.symmetry, {"off", "auto", "x", "y", "z"}}},
        {"hide_seams", {&options_.hide_seams, {"none", "openness", "dome", "view"}}}};
    for (const auto& [known, option] : words)
      if (name == known) {
        *option.first = place_of(name, value, option.second);
        return true;
      }
    return false;
  }

  bool read_number(const std::string& name, const Json& value)
  {
    atlas_options& o = options_;
    return number(name, value, "max_distortion", o.max_distortion) ||
           number(name, value, "max_stretch", o.max_stretch) ||
           number(name, value, "max_stretch_share", o.max_stretch_share) ||
           number(name, value, "max_charts", o.max_charts) ||
           number(name, value, "min_chart_texels", o.min_chart_texels) ||
           number(name, value, "hard_angle", o.hard_angle) ||
           number(name, value, "straighten", o.straighten) ||
           number(name, value, "separate_materials", o.separate_materials) ||
           number(name, value, "keep_uvs", o.keep_uvs) || number(name, value, "orient", o.orient) ||
           number(name, value, "width", o.width) || number(name, value, "height", o.height) ||
           number(name, value, "gutter", o.gutter) || number(name, value, "mip_levels", o.mip_levels) ||
           number(name, value, "block", o.block) || number(name, value, "pages", o.pages) ||
           number(name, value, "density", o.density) || number(name, value, "snap", o.snap) ||
           number(name, value, "free_aspect", o.free_aspect) ||
           number(name, value, "time_limit", o.time_limit) ||
           number(name, value, "min_coverage", o.min_coverage) ||
           number(name, value, "min_texels_per_chart", o.min_texels_per_chart) ||
           number(name, value, "seam_exchange_rate", o.seam_exchange_rate) ||
           number(name, value, "only_given_seams", o.only_given_seams) ||
           number(name, value, "weld", o.weld) || number(name, value, "defragment", o.defragment);
  }

  template <typename Number>
  static bool number(const std::string& name, const Json& value, const char* known, Number& member)
  {
    if (name != known)
      return false;
    set_number(name, value, member);
    return true;
  }

  bool read_stage(const std::string& name, const Json& value)
  {
    for (const auto& [known, member] : {std::pair("segmentation", &atlas_options::segmentation),
                                        {"parameterizer", &atlas_options::parameterizer},
                                        {"solver", &atlas_options::solver},
                                        {"pins", &atlas_options::pins},
                                        {"optimizer", &atlas_options::optimizer},
                                        {"packer", &atlas_options::packer}})
      if (name == known) {
        if (!value.is_string())
          throw Invalid_argument(name, "must be the name of a model, but is " + value.dump());
        texts_.push_back(value.get<std::string>());
        options_.*member = texts_.back().c_str();
        return true;
      }
    return false;
  }

  bool read_direction(const std::string& name, const Json& value)
  {
    if (name != "up" && name != "hide_axis")
      return false;
    if (!value.is_array() || value.size() != 3)
      throw Invalid_argument(name, "must be three numbers");
    for (std::size_t i = 0; i < 3; ++i)
      set_number(name, value[i], name == "up" ? options_.up[i] : options_.hide_axis[i]);
    return true;
  }

  void read_rules(const Json& value)
  {
    for (const Json& rule : value) {
      rules_.emplace_back();
      rules_.back().weight = 1;
      for (const auto& [name, of_rule] : rule.items())
        if (!number(name, of_rule, "material", rules_.back().material) &&
            !number(name, of_rule, "weight", rules_.back().weight) &&
            !number(name, of_rule, "is_grouped", rules_.back().is_grouped) &&
            !number(name, of_rule, "is_locked", rules_.back().is_locked))
          throw Invalid_argument("rules", "know no \"" + name + '"');
    }
    options_.rules = rules_.data();
    options_.number_of_rules = rules_.size();
  }

  atlas_options& options_;
  std::vector<atlas_material_rule> rules_;
  std::deque<std::string> texts_; // which stay where they are
};

} // namespace Atlas::wasm

#endif
