// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_MTL_READER_H
#define ATLAS_IO_INTERNAL_MTL_READER_H

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

namespace Atlas::internal {

/// What an MTL file says of a material.
struct Mtl_material
{
  std::array<double, 3> diffuse{1, 1, 1};
  double opacity = 1;
  std::string picture, alpha_picture; ///< empty: none
  bool is_clamped = false;
  std::array<double, 2> scale{1, 1}, offset{0, 0}; ///< of the picture's coordinates
};

/// Reads what MTL files say of colour, material by material.
class Mtl_reader
{
public:
  void read(const std::filesystem::path& path)
  {
    const std::string text = read_text_file(path);
    Text_scanner scanner(text, path.string(), Text_scanner::hash_comments);
    Mtl_material* material = nullptr;
    while (scanner.next_line()) {
      const std::string_view keyword = scanner.token();
      if (keyword == "newmtl")
        material = &materials[std::string(scanner.remainder())];
      else if (keyword == "Kd" && material)
        read_color(scanner, *material);
      else if (keyword == "d" && material)
        read_opacity(scanner, *material);
      else if (keyword == "Tr" && material)
        material->opacity = 1 - std::clamp(scanner.number("a transparency"), 0.0, 1.0);
      else if (keyword == "map_Kd" && material)
        material->picture = read_picture(scanner, *material);
      else if (keyword == "map_d" && material) {
        Mtl_material other; // its options are not those of the colours
        material->alpha_picture = read_picture(scanner, other);
      }
    }
  }

  std::map<std::string, Mtl_material> materials;

private:
  static void read_color(Text_scanner& scanner, Mtl_material& material)
  {
    const auto component = [](double x) { return std::isfinite(x) ? std::clamp(x, 0.0, 1.0) : 1; };
    for (double& x : material.diffuse)
      x = scanner.at_end() ? material.diffuse[0] : component(scanner.number("a colour"));
  }

  /// d [-halo] factor
  static void read_opacity(Text_scanner& scanner, Mtl_material& material)
  {
    if (scanner.peek() == "-halo")
      scanner.token();
    material.opacity = std::clamp(scanner.number("an opacity"), 0.0, 1.0);
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
