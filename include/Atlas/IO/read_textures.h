// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_READ_TEXTURES_H
#define ATLAS_IO_READ_TEXTURES_H

#include <Atlas/IO/read_gltf.h>
#include <Atlas/image/IO_error.h>
#include <Atlas/image/Source_textures.h>
#include <Atlas/image/internal/Text_scanner.h>
#include <Atlas/image/pages.h>
#include <Atlas/image/read_image.h>
#include <Atlas/soup/Polygon_soup.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <tiny_gltf.h>
#include <utility>
#include <vector>

namespace Atlas {

namespace internal {

/// What an MTL file says of a material.
struct Mtl_material
{
  std::array<double, 3> diffuse{1, 1, 1};
  std::string picture; ///< empty: none
  bool is_clamped = false;
};

/// Reads what MTL files say of colour, material by material.
class Mtl_reader
{
public:
  void read(const std::filesystem::path& path)
  {
    const std::string text = read_whole_file(path);
    check_is_text(text, path.string());
    Text_scanner scanner(text, path.string(), Text_scanner::hash_comments);
    Mtl_material* material = nullptr;
    while (scanner.next_line()) {
      const std::string_view keyword = scanner.token();
      if (keyword == "newmtl")
        material = &materials[std::string(scanner.remainder())];
      else if (keyword == "Kd" && material)
        read_color(scanner, *material);
      else if (keyword == "map_Kd" && material)
        read_picture(scanner, *material);
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

  /// map_Kd [options] file; the name may have blanks.
  static void read_picture(Text_scanner& scanner, Mtl_material& material)
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
        while (is_number(rest.substr(0, rest.find_first_of(" \t"))))
          next();
      else
        for (int n = option == "-mm" ? 2 : 1; n > 0; --n)
          next();
    }
    material.picture = rest;
    std::replace(material.picture.begin(), material.picture.end(), '\\', '/');
  }

  static bool is_number(std::string_view word)
  {
    return !word.empty() && word.find_first_not_of("+-.0123456789eE") == std::string_view::npos;
  }
};

/// The tile of UDIM that the middle of a face is in; 0 outside of the tiles.
inline Index tile_of(const Polygon_soup& soup, const std::vector<Point_2>& uv, std::size_t f)
{
  Polygon_soup face;
  for (std::size_t c = soup.first[f]; c < soup.first[f + 1]; ++c) {
    face.vertices.push_back(soup.vertices[c]);
    face.uv.push_back(uv[c]);
  }
  face.close_face();
  separate_udim(face);
  return face.face_page[0];
}

inline Source_textures read_mtl_textures(const std::filesystem::path& mesh, const Polygon_soup& soup,
                                         const std::vector<Point_2>& uv)
{
  Mtl_reader reader;
  for (const std::string& library : soup.material_libraries)
    reader.read(mesh.parent_path() / library);
  Source_textures result;
  result.face_texture.assign(soup.number_of_faces(), no_index);
  std::map<std::pair<Index, Index>, Index> number; // of a material and tile
  for (std::size_t f = 0; f < soup.number_of_faces() && !soup.face_material.empty(); ++f) {
    if (soup.face_material[f] == no_index)
      continue;
    const auto found = reader.materials.find(soup.material_names[soup.face_material[f]]);
    if (found == reader.materials.end())
      continue;
    const Mtl_material& material = found->second;
    const std::size_t place = material.picture.find("<UDIM>");
    const Index tile = place == std::string::npos || uv.empty() ? 0 : tile_of(soup, uv, f);
    const auto [it, is_new] =
        number.try_emplace({soup.face_material[f], tile}, static_cast<Index>(result.textures.size()));
    result.face_texture[f] = it->second;
    if (!is_new)
      continue;
    Source_texture texture;
    texture.factor = material.picture.empty() ? material.diffuse : texture.factor;
    if (material.is_clamped)
      texture.wrap_u = texture.wrap_v = Texture_wrap::clamp;
    std::string picture = material.picture;
    if (place != std::string::npos)
      picture.replace(place, 6, std::to_string(udim_tile(tile)));
    if (!picture.empty())
      texture.image = read_image(mesh.parent_path() / picture);
    result.textures.push_back(std::move(texture));
  }
  return result;
}

inline Source_textures read_ply_textures(const std::filesystem::path& mesh, const Polygon_soup& soup)
{
  Source_textures result;
  for (const std::string& name : soup.page_textures) {
    result.textures.emplace_back();
    result.textures.back().image = read_image(mesh.parent_path() / name);
  }
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    result.face_texture.push_back(soup.page(f) < result.textures.size() ? soup.page(f) : no_index);
  return result;
}

inline Texture_wrap wrap_of(int gltf_wrap)
{
  return gltf_wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? Texture_wrap::clamp
         : gltf_wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Texture_wrap::mirror
                                                              : Texture_wrap::repeat;
}

/// A linear component as it is stored in pictures (sRGB, IEC 61966-2-1).
inline double encoded_srgb(double x)
{
  x = std::clamp(x, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

/// The extension KHR_texture_transform, from the coordinates of glTF, whose v points down, to ours.
inline std::array<double, 6> texture_transform(const tinygltf::Value& extension)
{
  double offset[2] = {0, 0}, scale[2] = {1, 1}, angle = 0;
  const auto read = [&](const char* name, double(&to)[2]) {
    if (extension.Has(name) && extension.Get(name).IsArray() && extension.Get(name).ArrayLen() == 2)
      for (int k = 0; k < 2; ++k)
        to[k] = extension.Get(name).Get(k).GetNumberAsDouble();
  };
  read("offset", offset);
  read("scale", scale);
  if (extension.Has("rotation"))
    angle = extension.Get("rotation").GetNumberAsDouble();
  const double c = std::cos(angle), s = std::sin(angle);
  // (u, w) -> (c su u + s sw w + ou, -s su u + c sw w + ow) with w = 1 - v.
  return {c * scale[0], -s * scale[1], s * scale[1] + offset[0],
          s * scale[0], c * scale[1],  1 - c * scale[1] - offset[1]};
}

inline Source_texture texture_of(const tinygltf::Model& model, const tinygltf::Material& material,
                                 const std::string& file)
{
  Source_texture result;
  const auto& surface = material.pbrMetallicRoughness;
  for (std::size_t k = 0; k < 3 && k < surface.baseColorFactor.size(); ++k)
    result.factor[k] = encoded_srgb(surface.baseColorFactor[k]);
  const int t = surface.baseColorTexture.index;
  if (t < 0 || static_cast<std::size_t>(t) >= model.textures.size())
    return result;
  const tinygltf::Texture& texture = model.textures[t];
  if (texture.source >= 0 && static_cast<std::size_t>(texture.source) < model.images.size())
    result.image = image_of(model.images[texture.source]);
  if (result.image.pixels.empty())
    throw IO_error(file + ": the picture of material '" + material.name + "' cannot be read");
  if (texture.sampler >= 0 && static_cast<std::size_t>(texture.sampler) < model.samplers.size()) {
    result.wrap_u = wrap_of(model.samplers[texture.sampler].wrapS);
    result.wrap_v = wrap_of(model.samplers[texture.sampler].wrapT);
  }
  const auto& extensions = surface.baseColorTexture.extensions;
  if (const auto it = extensions.find("KHR_texture_transform"); it != extensions.end())
    result.transform = texture_transform(it->second);
  return result;
}

inline Source_textures read_gltf_textures(const std::filesystem::path& mesh, const Polygon_soup& soup)
{
  tinygltf::TinyGLTF loader;
  const tinygltf::Model model = load_gltf(mesh, loader);
  Source_textures result;
  for (const tinygltf::Material& material : model.materials)
    result.textures.push_back(texture_of(model, material, mesh.string()));
  result.face_texture = soup.face_material;
  result.face_texture.resize(soup.number_of_faces(), no_index);
  for (Index& t : result.face_texture)
    t = t < result.textures.size() ? t : no_index;
  return result;
}

} // namespace internal

/// \brief Reads the textures that a mesh file names: `map_Kd` and `Kd` of the MTL files beside an OBJ file
/// (with `<UDIM>` in the name, and `-clamp`), `TextureFile` of a PLY file, the base colours of glTF.
///
/// \param mesh  the file
/// \param soup  what has been read from it; its `old_uv`, or `uv` if there are none, tell the tiles of UDIM
///
/// Faces whose material is not described get `no_index`; other formats have no textures at all. Needs the
/// library tinygltf. \throw IO_error if a file that is named cannot be read
inline Source_textures read_textures(const std::filesystem::path& mesh, const Polygon_soup& soup)
{
  std::string extension = mesh.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".obj")
    return internal::read_mtl_textures(mesh, soup, soup.old_uv.empty() ? soup.uv : soup.old_uv);
  if (extension == ".ply")
    return internal::read_ply_textures(mesh, soup);
  if (extension == ".gltf" || extension == ".glb")
    return internal::read_gltf_textures(mesh, soup);
  return {{}, std::vector<Index>(soup.number_of_faces(), no_index)};
}

} // namespace Atlas

#endif
