// SPDX-License-Identifier: MIT
#include "options.h"

#include <Atlas/core/errors.h>
#include <Atlas/soup/internal/viewers_of.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <initializer_list>
#include <limits>
#include <map>
#include <pybind11/stl.h>
#include <string>
#include <utility>

namespace Atlas::python {

namespace py = pybind11;

namespace {

using bindings::Scene_options;

/// A value of the right type, or an error that names the option.
template <typename Value>
Value value_of(const char* name, const py::handle& value, const char* kind)
{
  try {
    return py::cast<Value>(value);
  } catch (const py::cast_error&) {
    throw py::type_error(std::string(name) + " must be " + kind + ", not " +
                         std::string(py::str(py::repr(value))));
  }
}

/// A number that counts something. Whole floats, such as numpy makes, are none.
template <typename Integer>
Integer count_of(const char* name, const py::handle& value)
{
  const py::object index = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!index) {
    PyErr_Clear();
    throw py::type_error(std::string(name) + " must be an integer, not " +
                         std::string(py::str(py::repr(value))));
  }
  int overflow = 0;
  const long long number = PyLong_AsLongLongAndOverflow(index.ptr(), &overflow);
  if (overflow != 0 || number < 0 ||
      static_cast<unsigned long long>(number) > std::numeric_limits<Integer>::max())
    throw Invalid_argument(name, "must be in 0 to " + std::to_string(std::numeric_limits<Integer>::max()) +
                                     ", but is " + std::string(py::str(index)));
  return static_cast<Integer>(number);
}

template <typename Value>
Value choice_of(const char* name, const py::handle& value,
                std::initializer_list<std::pair<const char*, Value>> choices)
{
  const auto word = value_of<std::string>(name, value, "a word");
  std::string list;
  for (const auto& [known, meaning] : choices) {
    if (word == known || (word.find('_') != std::string::npos && [&, text = word]() mutable {
          for (char& c : text)
            c = c == '_' ? '-' : c;
          return text == known;
        }()))
      return meaning;
    list += (list.empty() ? "'" : ", '") + std::string(known) + '\'';
  }
  throw Invalid_argument(name, "must be one of " + list + ", but is '" + word + '\'');
}

Atlas_mode mode_of(const char* name, const py::handle& value)
{
  using enum Atlas_mode;
  return choice_of<Atlas_mode>(
      name, value,
      {{"standard", standard}, {"few-seams", few_seams}, {"conformal", conformal}, {"paper", paper}});
}

Distortion_measure measure_of(const char* name, const py::handle& value)
{
  using enum Distortion_measure;
  return choice_of<Distortion_measure>(name, value,
                                       {{"symmetric-dirichlet", symmetric_dirichlet},
                                        {"l2-stretch", l2_stretch},
                                        {"linf-stretch", linf_stretch},
                                        {"area-ratio", area_ratio},
                                        {"area-ratio-quantiles", area_ratio_quantiles},
                                        {"quasi-conformal", quasi_conformal}});
}

/// One number for a square, or width and height.
void set_size(const char* name, const py::handle& value, Page_options& page)
{
  if (!py::isinstance<py::tuple>(value) && !py::isinstance<py::list>(value)) {
    page.width = page.height = count_of<Index>(name, value);
    return;
  }
  const auto sides = py::reinterpret_borrow<py::sequence>(value);
  if (sides.size() != 2)
    throw py::type_error(std::string(name) + " must be a number of texels, or width and height");
  page.width = count_of<Index>(name, sides[0]);
  page.height = count_of<Index>(name, sides[1]);
}

/// An axis of the model by its name, or a direction.
void set_up(const char* name, const py::handle& value, Page_options& page)
{
  if (py::isinstance<py::str>(value)) {
    const auto axis =
        choice_of<int>(name, value, {{"x", 1}, {"y", 2}, {"z", 3}, {"-x", -1}, {"-y", -2}, {"-z", -3}});
    page.up[static_cast<std::size_t>(std::abs(axis) - 1)] = axis > 0 ? 1 : -1;
    return;
  }
  page.up = value_of<std::array<double, 3>>(name, value, "'x', 'y', 'z', '-x', '-y', '-z', or three numbers");
}

/// Materials with weights, as a dictionary.
void set_weights(const char* name, const py::handle& value, Scene_options& options)
{
  if (!py::isinstance<py::dict>(value))
    throw py::type_error(std::string(name) + " must be a dictionary of materials and factors");
  for (const auto& [material, weight] : py::reinterpret_borrow<py::dict>(value))
    options.rules_of_materials[count_of<Index>(name, material)].weight =
        value_of<double>(name, weight, "a dictionary of materials and factors");
}

void set_flags(const char* name, const py::handle& value, Scene_options& options,
               bool internal::Material_rule::*flag)
{
  if (!py::isinstance<py::iterable>(value))
    throw py::type_error(std::string(name) + " must be a list of materials");
  for (const py::handle material : py::reinterpret_borrow<py::iterable>(value))
    options.rules_of_materials[count_of<Index>(name, material)].*flag = true;
}

using Setter = std::function<void(Scene_options&, const char*, const py::handle&)>;

Setter number(double Scene_options::*member)
{
  return [member](Scene_options& o, const char* name, const py::handle& v) {
    o.*member = value_of<double>(name, v, "a number");
  };
}

Setter flag(bool Scene_options::*member)
{
  return [member](Scene_options& o, const char* name, const py::handle& v) {
    o.*member = value_of<bool>(name, v, "True or False");
  };
}

Setter page_number(double Page_options::*member)
{
  return [member](Scene_options& o, const char* name, const py::handle& v) {
    o.page.*member = value_of<double>(name, v, "a number");
  };
}

Setter page_count(Index Page_options::*member)
{
  return [member](Scene_options& o, const char* name, const py::handle& v) {
    o.page.*member = count_of<Index>(name, v);
  };
}

Setter page_flag(bool Page_options::*member)
{
  return [member](Scene_options& o, const char* name, const py::handle& v) {
    o.page.*member = value_of<bool>(name, v, "True or False");
  };
}

void add_page_options(std::map<std::string, Setter>& all)
{
  all["texture_size"] = [](Scene_options& o, const char* name, const py::handle& v) {
    set_size(name, v, o.page);
  };
  all["gutter"] = page_number(&Page_options::gutter);
  all["density"] = page_number(&Page_options::density);
  all["pages"] = page_count(&Page_options::pages);
  all["mip_levels"] = page_count(&Page_options::mip_levels);
  all["block"] = page_count(&Page_options::block);
  all["rotation"] = [](Scene_options& o, const char* name, const py::handle& v) {
    using enum Chart_rotation;
    o.page.rotation = choice_of<Chart_rotation>(
        name, v,
        {{"aligned", aligned}, {"free", free}, {"any", any}, {"quarter", quarter_turns}, {"none", none}});
  };
  all["up"] = [](Scene_options& o, const char* name, const py::handle& v) { set_up(name, v, o.page); };
  all["snap"] = page_flag(&Page_options::snaps);
  all["free_aspect"] = page_flag(&Page_options::has_free_aspect);
  all["stack"] = [](Scene_options& o, const char* name, const py::handle& v) {
    using enum Chart_stacking;
    o.page.stacking = choice_of<Chart_stacking>(
        name, v, {{"none", none}, {"copies", copies}, {"mirrored", copies_and_mirrored}});
  };
  all["effort"] = [](Scene_options& o, const char* name, const py::handle& v) {
    using enum Packing_effort;
    o.effort = choice_of<Packing_effort>(name, v, {{"fast", fast}, {"normal", normal}, {"best", best}});
  };
  all["weight"] = [](Scene_options& o, const char* name, const py::handle& v) { set_weights(name, v, o); };
  all["group"] = [](Scene_options& o, const char* name, const py::handle& v) {
    set_flags(name, v, o, &internal::Material_rule::is_grouped);
  };
  all["lock"] = [](Scene_options& o, const char* name, const py::handle& v) {
    set_flags(name, v, o, &internal::Material_rule::is_locked);
  };
}

/// What can be asked for, by name.
const std::map<std::string, Setter>& setters()
{
  static const std::map<std::string, Setter> result = [] {
    std::map<std::string, Setter> all;
    add_page_options(all);
    all["mode"] = [](Scene_options& o, const char* name, const py::handle& v) { o.mode = mode_of(name, v); };
    all["measure"] = [](Scene_options& o, const char* name, const py::handle& v) {
      o.measure = measure_of(name, v);
    };
    all["max_distortion"] = number(&Scene_options::max_distortion);
    all["max_stretch"] = number(&Scene_options::max_stretch);
    all["max_stretch_share"] = number(&Scene_options::max_stretch_share);
    all["straighten"] = flag(&Scene_options::is_straightened);
    all["min_chart_texels"] = number(&Scene_options::min_chart_texels);
    all["min_coverage"] = number(&Scene_options::min_coverage);
    all["min_texels_per_chart"] = number(&Scene_options::min_texels_per_chart);
    all["seam_exchange_rate"] = [](Scene_options& o, const char* name, const py::handle& v) {
      o.seam_exchange_rate = value_of<double>(name, v, "a number");
    };
    all["symmetry"] = [](Scene_options& o, const char* name, const py::handle& v) {
      using enum Symmetry;
      o.symmetry =
          choice_of<Symmetry>(name, v, {{"off", off}, {"auto", automatic}, {"x", x}, {"y", y}, {"z", z}});
    };
    all["hard_angle"] = number(&Scene_options::hard_angle);
    for (const auto& [stage, member] : {std::pair("segmentation", &internal::Stage_names::segmentation),
                                        {"parameterizer", &internal::Stage_names::parameterizer},
                                        {"solver", &internal::Stage_names::solver},
                                        {"pins", &internal::Stage_names::pins},
                                        {"optimizer", &internal::Stage_names::optimizer},
                                        {"packer", &internal::Stage_names::packer}})
      all[stage] = [member = member](Scene_options& o, const char* name, const py::handle& v) {
        o.stages.*member = value_of<std::string>(name, v, "the name of a model");
      };
    all["hide_seams"] = [](Scene_options& o, const char* name, const py::handle& v) {
      o.hiding = internal::viewers_of(value_of<std::string>(name, v, "a word"));
      internal::require(o.hiding.has_value(), name,
                        "must be 'openness', 'view:AXIS' or 'dome:AXIS' with an axis such as -y or 0,1,1");
    };
    all["weld"] = number(&Scene_options::weld);
    all["time_limit"] = number(&Scene_options::time_limit);
    all["separate_materials"] = flag(&Scene_options::separates_materials);
    all["only_given_seams"] = flag(&Scene_options::has_only_given_seams);
    all["keep_uv"] = flag(&Scene_options::keeps_uv);
    all["defragment"] = flag(&Scene_options::merges_uv);
    all["orient"] = flag(&Scene_options::turns_faces);
    all["max_charts"] = [](Scene_options& o, const char* name, const py::handle& v) {
      o.max_charts = count_of<Index>(name, v);
    };
    all["threads"] = [](Scene_options& o, const char* name, const py::handle& v) {
      o.threads = count_of<unsigned>(name, v);
    };
    return all;
  }();
  return result;
}

} // namespace

Scene_options scene_options(const py::dict& keywords)
{
  Scene_options options;
  for (const auto& [key, value] : keywords) {
    const auto name = py::cast<std::string>(key);
    const auto at = setters().find(name);
    if (at == setters().end()) {
      std::string all;
      for (const auto& [known, setter] : setters())
        all += (all.empty() ? "" : ", ") + known;
      throw py::type_error("there is no option '" + name + "'; there are " + all);
    }
    if (!value.is_none()) // None stands for the default
      at->second(options, name.c_str(), value);
  }
  return options;
}

} // namespace Atlas::python
