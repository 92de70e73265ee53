// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_MTL_READER_H
#define ATLAS_IO_INTERNAL_MTL_READER_H

#include <Atlas/IO/internal/extension.h>
#include <Atlas/IO/internal/find_file.h>
#include <Atlas/image/internal/Text_scanner.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// What an MTL file says of a material.
struct Mtl_material
{
  std::array<double, 3> diffuse{1, 1, 1};
  double opacity = 1;
  bool has_opacity = false;           ///< as `d`, before which `Tr` gives way: programs do not agree on it
  std::string picture, alpha_picture; ///< empty: none
  bool is_clamped = false;
  std::array<double, 2> scale{1, 1}, offset{0, 0}; ///< of the picture's coordinates
};

/// A name as MTL and OBJ files give it: without quotes, and without a comment behind it.
inline std::string plain_material_name(std::string_view name)
{
  if (const std::size_t comment = std::min(name.find(" #"), name.find("\t#"));
      comment != std::string_view::npos)
    name = name.substr(0, comment);
  while (!name.empty() && (name.back() == ' ' || name.back() == '\t'))
    name.remove_suffix(1);
  if (name.size() >= 2 && name.front() == '"' && name.back() == '"')
    name = name.substr(1, name.size() - 2);
  return std::string(name);
}

/// \brief Reads what MTL files say of colour, material by material.
///
/// Keywords are known in any case. A statement that cannot be understood is passed over, and told of.
class Mtl_reader
{
public:
  /// \throw IO_error the file cannot be read, or is no text
  void read(const std::filesystem::path& path)
  {
    const std::string text = read_text_file(path);
    Text_scanner scanner(text, path.filename().string(), Text_scanner::hash_comments);
    Mtl_material* material = nullptr;
    while (scanner.next_line()) {
      const std::string keyword = lower_case(scanner.token());
      if (keyword == "newmtl")
        material = &materials[std::string(scanner.remainder())];
      else if (material)
        try {
          read_statement(keyword, scanner, *material);
        } catch (const IO_error& error) {
          warnings.push_back(std::string(error.what()) + ", which is passed over");
        }
    }
  }

  /// The material of a name; of one that is not there, the one that differs in case, quotes or comment only.
  const Mtl_material* find(const std::string& name) const
  {
    if (const auto exact = materials.find(name); exact != materials.end())
      return &exact->second;
    for (const auto& [other, material] : materials)
      if (is_same_name_in_any_case(plain_material_name(other), plain_material_name(name)))
        return &material;
    return nullptr;
  }

  std::map<std::string, Mtl_material> materials;
  std::vector<std::string> warnings;

private:
  static void read_statement(const std::string& keyword, Text_scanner& scanner, Mtl_material& material)
  {
    if (keyword == "kd")
      read_color(scanner, material);
    else if (keyword == "d")
      read_opacity(scanner, material);
    else if (keyword == "tr" && !material.has_opacity)
      material.opacity = 1 - std::clamp(scanner.number("a transparency"), 0.0, 1.0);
    else if (keyword == "map_kd")
      material.picture = read_picture(scanner, material);
    else if (keyword == "map_d") {
      Mtl_material other; // its options are not those of the colours
      material.alpha_picture = read_picture(scanner, other);
    }
  }

  /// Kd r [g b]; spectra and the colour space of the CIE are not told apart from what cannot be understood.
  static void read_color(Text_scanner& scanner, Mtl_material& material)
  {
    const auto component = [](double x) { return std::isfinite(x) ? std::clamp(x, 0.0, 1.0) : 1; };
    std::array<double, 3> color{};
    color[0] = component(scanner.number("a colour"));
    for (std::size_t k = 1; k < 3; ++k)
      color[k] = scanner.at_end() ? color[0] : component(scanner.number("a colour"));
    material.diffuse = color;
  }

  /// d [-halo] factor
  static void read_opacity(Text_scanner& scanner, Mtl_material& material)
  {
    if (scanner.peek() == "-halo")
      scanner.token();
    material.opacity = std::clamp(scanner.number("an opacity"), 0.0, 1.0);
    material.has_opacity = true;
  }

  /// map_Kd [options] file; the name may have blanks.
  static std::string read_picture(Text_scanner& scanner, Mtl_material& material)
  {
    std::string_view rest = scanner.remainder();
    const auto next = [&] {
      const std::string_view word = rest.substr(0, rest.find_first_of(" \t"));
      rest.remove_prefix(std::min(rest.size(), rest.find_first_not_of(" \t", word.size())));
      return word;
    };
    while (!rest.empty() && rest.front() == '-') {
      const std::string_view option = next();
      if (option == "-clamp")
        material.is_clamped = next() == "on";
      else if (option == "-o" || option == "-s" || option == "-t")
        for (std::size_t k = 0; k < 3 && is_number(rest.substr(0, rest.find_first_of(" \t"))); ++k) {
          const double value = std::strtod(std::string(next()).c_str(), nullptr);
          if (k < 2 && option != "-t" && std::isfinite(value)) // turbulence is noise
            (option == "-s" ? material.scale : material.offset)[k] = value;
        }
      else
        for (int n = option == "-mm" ? 2 : 1; n > 0; --n)
          next();
    }
    return std::string(rest);
  }

  static bool is_number(std::string_view word)
  {
    return !word.empty() && word.find_first_not_of("+-.0123456789eE") == std::string_view::npos;
  }
};

} // namespace Atlas::internal

#endif
