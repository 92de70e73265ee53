// SPDX-License-Identifier: MIT
// What the charts of some materials may do, for the programs that have options for it.
#ifndef MATERIAL_PACKER_H
#define MATERIAL_PACKER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Packing.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/concepts.h>
#include <Atlas/image/IO_error.h>
#include <Atlas/measure/area.h>
#include <Atlas/packing/Raster_packer.h>
#include <Atlas/soup/Polygon_soup.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// Wishes as they are on the command line, by names of materials.
struct Material_rules
{
  std::vector<std::string> weights; ///< "NAME=FACTOR"
  std::vector<std::string> grouped, locked;
};

/// "NAME=FACTOR"; names may have an equals sign in them.
inline std::pair<std::string, double> read_weight(const std::string& text)
{
  const std::size_t equals = text.rfind('=');
  double factor = 0;
  if (equals == std::string::npos || !CLI::detail::lexical_cast(text.substr(equals + 1), factor) ||
      !(factor > 0 && std::isfinite(factor)))
    throw CLI::ValidationError("--weight", "'" + text + "' is not MATERIAL=FACTOR with a positive factor");
  return {text.substr(0, equals), factor};
}

/// Refuses what has no meaning for any file.
inline void check(const Material_rules& rules)
{
  for (const std::string& text : rules.weights)
    (void)read_weight(text);
}

/// The rules for one material.
struct Material_rule
{
  double weight = 1;
  bool is_grouped = false, is_locked = false;
};

/// The rules for each material of a model. \throw CLI::ValidationError if one of them is not there
inline std::vector<Material_rule> rules_of(const Material_rules& rules, const Atlas::Polygon_soup& model)
{
  std::vector<Material_rule> result(model.material_names.size());
  const auto rule_of = [&](const std::string& name, const char* option) -> Material_rule& {
    const auto& names = model.material_names;
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end())
      throw CLI::ValidationError(option, "there is no material called '" + name + "' in what was read");
    return result[static_cast<std::size_t>(at - names.begin())];
  };
  for (const std::string& text : rules.weights) {
    const auto [name, factor] = read_weight(text);
    rule_of(name, "--weight").weight = factor;
  }
  for (const std::string& name : rules.grouped)
    rule_of(name, "--group").is_grouped = true;
  for (const std::string& name : rules.locked)
    rule_of(name, "--lock").is_locked = true;
  return result;
}

/// Gives faces the weights of their materials.
inline void set_weights(const Material_rules& rules, const Atlas::Polygon_soup& model,
                        Atlas::Surface& surface)
{
  if (rules.weights.empty())
    return;
  const std::vector<Material_rule> rule = rules_of(rules, model);
  for (const Atlas::Index face : surface.face) {
    const Atlas::Index material = model.face_material.empty() ? Atlas::no_index : model.face_material[face];
    surface.density_weight.push_back(material == Atlas::no_index ? 1 : rule[material].weight);
  }
}

/// \brief The default packer under rules for materials; a chart has the material of its first face.
///
/// Grouped and locked charts have the places of the file's coordinates, whatever has been done to their size
/// and place since. Charts that have another shape than in the file are as free as all others. For
/// weights see `set_weights()`. Models `ChartPacker`.
class Material_packer
{
public:
  /// \param surface, model  what the charts will come from; must outlive this object. The coordinates of the
  /// model are those of the file.
  Material_packer(const Atlas::Surface& surface, const Atlas::Polygon_soup& model,
                  const Material_rules& rules, Atlas::Packing_effort effort)
      : surface_(&surface), model_(&model), rules_(rules_of(rules, model)),
        is_plain_(rules.grouped.empty() && rules.locked.empty()), packer_(effort)
  {}

  Atlas::Packing pack(std::span<const Atlas::Chart> charts, const Atlas::Page_options& options,
                      const Atlas::Execution& execution) const
  {
    if (is_plain_)
      return packer_.pack(charts, options, execution);
    Atlas::Page_options page = options;
    page.groups.assign(charts.size(), Atlas::no_index);
    page.locked.assign(charts.size(), std::nullopt);
    std::vector<Atlas::Chart> moved(charts.begin(), charts.end());
    std::vector<Similarity> in_group(charts.size());
    std::vector<std::pair<double, double>> areas(rules_.size()); // of groups: of the charts, and in the file
    for (std::size_t c = 0; c < charts.size(); ++c) {
      const Atlas::Index material = material_of(charts[c]);
      if (material == Atlas::no_index)
        continue;
      const Material_rule& rule = rules_[material];
      const std::optional<Similarity> in_file =
          rule.is_grouped || rule.is_locked ? place_in_file(charts[c]) : std::nullopt;
      if (in_file && rule.is_locked) {
        page.locked[c] = placement(*in_file, charts[c], page.width);
      } else if (in_file && rule.is_grouped) {
        page.groups[c] = material;
        in_group[c] = *in_file;
        const double area = std::abs(Atlas::area_uv(charts[c]));
        areas[material].first += area;
        areas[material].second += area * std::norm(in_file->factor);
      }
    }
    for (std::size_t c = 0; c < charts.size(); ++c)
      if (const Atlas::Index group = page.groups[c]; group != Atlas::no_index) {
        const auto [area, area_in_file] = areas[group];
        const double scale = area_in_file > 0 ? std::sqrt(area / area_in_file) : 1;
        in_group[c] = {scale * in_group[c].factor, scale * in_group[c].shift};
        for (Atlas::Point_2& p : moved[c].uv)
          p = in_group[c](p);
      }
    Atlas::Packing packing = packer_.pack(moved, page, execution);
    if (packing.number_of_pages == 0 && !charts.empty() && !execution.is_cancelled())
      throw Atlas::IO_error("the page has no room for the charts, those that are locked included");
    for (std::size_t c = 0; c < packing.placements.size(); ++c)
      if (page.groups[c] != Atlas::no_index)
        packing.placements[c] = composed(packing.placements[c], in_group[c]);
    return packing;
  }

private:
  /// z -> factor z + shift in the complex plane.
  struct Similarity
  {
    std::complex<double> factor = 1, shift = 0;

    Atlas::Point_2 operator()(const Atlas::Point_2& p) const
    {
      const std::complex<double> q = factor * std::complex<double>(p.x(), p.y()) + shift;
      return Atlas::Point_2(q.real(), q.imag());
    }
  };

  Atlas::Index material_of(const Atlas::Chart& chart) const
  {
    return model_->face_material.empty() || chart.source.empty()
               ? Atlas::no_index
               : model_->face_material[surface_->face[chart.source.front()]];
  }

  /// Calls `body(p, q)` for each corner of a chart: its point, and that of the file.
  template <typename Body>
  void for_corners(const Atlas::Chart& chart, Body body) const
  {
    for (std::size_t t = 0; t < chart.triangles.size(); ++t)
      for (Atlas::Index i = 0; i < 3; ++i) {
        const Atlas::Point_2& p = chart.uv[chart.triangles[t][i]];
        const Atlas::Point_2& q = model_->uv[surface_->corner[3 * chart.source[t] + i]];
        body(std::complex(p.x(), p.y()), std::complex(q.x(), q.y()));
      }
  }

  /// The similarity that takes a chart to its coordinates in the file, if there is one: least squares, then
  /// all points have to agree.
  std::optional<Similarity> place_in_file(const Atlas::Chart& chart) const
  {
    constexpr double tolerance = 1e-6;
    if (model_->uv.empty() || chart.triangles.empty())
      return std::nullopt;
    const auto n = static_cast<double>(3 * chart.triangles.size());
    std::complex<double> mean_p = 0, mean_q = 0, product = 0;
    for_corners(chart, [&](auto p, auto q) { mean_p += p / n, mean_q += q / n; });
    double square = 0;
    for_corners(chart, [&](auto p, auto q) {
      product += std::conj(p - mean_p) * (q - mean_q);
      square += std::norm(p - mean_p);
    });
    if (!(square > 0) || !std::isfinite(std::abs(product)) || product == 0.0)
      return std::nullopt;
    const std::complex<double> factor = product / square;
    double farthest = 0, error = 0;
    for_corners(chart, [&](auto p, auto q) {
      farthest = std::max(farthest, std::abs(q - mean_q));
      error = std::max(error, std::abs(factor * (p - mean_p) - (q - mean_q)));
    });
    if (!(error <= tolerance * farthest))
      return std::nullopt;
    return Similarity{factor, mean_q - factor * mean_p};
  }

  /// Where the file has a chart, as a placement: in the tile that the middle of its box is in.
  static Atlas::Placement placement(const Similarity& in_file, const Atlas::Chart& chart, double side)
  {
    CGAL::Bbox_2 box;
    for (const Atlas::Point_2& p : chart.uv)
      box += in_file(p).bbox();
    const double u = std::floor((box.xmin() + box.xmax()) / 2), v = std::floor((box.ymin() + box.ymax()) / 2);
    if (!(u >= 0 && u < 10 && v >= 0 && v < 900))
      throw Atlas::IO_error("a locked chart lies outside of the tiles 1001 to 9999: u = " +
                            std::to_string(u) + ", v = " + std::to_string(v));
    const std::complex<double> factor = side * in_file.factor,
                               shift = side * (in_file.shift - std::complex(u, v));
    return {factor.real(), factor.imag(), shift.real(), shift.imag(), static_cast<Atlas::Index>(u + 10 * v)};
  }

  static Atlas::Placement composed(const Atlas::Placement& placement, const Similarity& first)
  {
    const std::complex<double> factor = std::complex(placement.a, placement.b) * first.factor;
    const Atlas::Point_2 shift = placement(Atlas::Point_2(first.shift.real(), first.shift.imag()));
    return {factor.real(), factor.imag(), shift.x(), shift.y(), placement.page};
  }

  const Atlas::Surface* surface_;
  const Atlas::Polygon_soup* model_;
  std::vector<Material_rule> rules_;
  bool is_plain_;
  Atlas::Raster_packer packer_;
};

#endif
