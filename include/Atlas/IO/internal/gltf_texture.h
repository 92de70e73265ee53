// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_GLTF_TEXTURE_H
#define ATLAS_IO_INTERNAL_GLTF_TEXTURE_H

#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/image/internal/image_of.h>
#include <Atlas/image/internal/srgb.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <tiny_gltf.h>
#include <vector>

namespace Atlas::internal {

inline Texture_wrap wrap_of(int gltf_wrap)
{
  return gltf_wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? Texture_wrap::clamp
         : gltf_wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Texture_wrap::mirror
                                                              : Texture_wrap::repeat;
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

/// The attribute with the coordinates of a texture; KHR_texture_transform may name another one.
inline std::string texcoord_of(const tinygltf::TextureInfo& texture)
{
  int set = texture.texCoord;
  if (const auto it = texture.extensions.find("KHR_texture_transform"); it != texture.extensions.end())
    if (it->second.Has("texCoord") && it->second.Get("texCoord").IsNumber())
      set = it->second.Get("texCoord").GetNumberAsInt();
  return "TEXCOORD_" + std::to_string(set);
}

/// The base colour of a material: a picture, and what it is multiplied with.
struct Gltf_base_color
{
  tinygltf::TextureInfo texture;
  std::vector<double> factor;
};

/// A member of an extension that refers to a texture.
inline tinygltf::TextureInfo texture_info(const tinygltf::Value& value)
{
  tinygltf::TextureInfo result;
  if (value.Has("index") && value.Get("index").IsNumber())
    result.index = value.Get("index").GetNumberAsInt();
  if (value.Has("texCoord") && value.Get("texCoord").IsNumber())
    result.texCoord = value.Get("texCoord").GetNumberAsInt();
  if (value.Has("extensions") && value.Get("extensions").IsObject())
    result.extensions = value.Get("extensions").Get<tinygltf::Value::Object>();
  return result;
}

/// Where a material tells of none, that of KHR_materials_pbrSpecularGlossiness, which older programs write
/// instead.
inline Gltf_base_color base_color_of(const tinygltf::Material& material)
{
  const auto& surface = material.pbrMetallicRoughness;
  Gltf_base_color result{surface.baseColorTexture, surface.baseColorFactor};
  const auto& factor = surface.baseColorFactor;
  const bool is_told = surface.baseColorTexture.index >= 0 ||
                       std::any_of(factor.begin(), factor.end(), [](double x) { return x != 1; });
  const auto old = material.extensions.find("KHR_materials_pbrSpecularGlossiness");
  if (is_told || old == material.extensions.end())
    return result;
  if (old->second.Has("diffuseTexture"))
    result.texture = texture_info(old->second.Get("diffuseTexture"));
  if (old->second.Has("diffuseFactor") && old->second.Get("diffuseFactor").IsArray()) {
    result.factor.clear();
    for (int k = 0; k < static_cast<int>(old->second.Get("diffuseFactor").ArrayLen()); ++k)
      result.factor.push_back(old->second.Get("diffuseFactor").Get(k).GetNumberAsDouble());
  }
  return result;
}

/// How a material colours: its base colour. A picture that cannot be read is told of, and left out.
inline Source_texture texture_of(const tinygltf::Model& model, const tinygltf::Material& material,
                                 std::vector<std::string>& warnings)
{
  Source_texture result;
  result.multiplies_colors = true;
  const Gltf_base_color color = base_color_of(material);
  for (std::size_t k = 0; k < 3 && k < color.factor.size(); ++k)
    result.factor[k] = encoded_srgb(color.factor[k]);
  const bool is_opaque = material.alphaMode != "MASK" && material.alphaMode != "BLEND";
  if (!is_opaque && color.factor.size() == 4)
    result.opacity = color.factor[3];
  const int t = color.texture.index;
  if (t < 0 || static_cast<std::size_t>(t) >= model.textures.size())
    return result;
  const tinygltf::Texture& texture = model.textures[static_cast<std::size_t>(t)];
  if (texture.source >= 0 && static_cast<std::size_t>(texture.source) < model.images.size())
    result.image = image_of(model.images[static_cast<std::size_t>(texture.source)]);
  if (result.image.pixels.empty())
    warnings.push_back("the picture of material '" + material.name +
                       "' cannot be read; its plain colour counts");
  if (is_opaque)
    result.image.alpha.clear();
  if (texture.sampler >= 0 && static_cast<std::size_t>(texture.sampler) < model.samplers.size()) {
    const tinygltf::Sampler& sampler = model.samplers[static_cast<std::size_t>(texture.sampler)];
    result.wrap_u = wrap_of(sampler.wrapS);
    result.wrap_v = wrap_of(sampler.wrapT);
  }
  const auto& extensions = color.texture.extensions;
  if (const auto it = extensions.find("KHR_texture_transform"); it != extensions.end())
    result.transform = texture_transform(it->second);
  return result;
}

} // namespace Atlas::internal

#endif
