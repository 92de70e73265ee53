// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_GLTF_TEXTURE_H
#define ATLAS_IO_INTERNAL_GLTF_TEXTURE_H

#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/image/internal/image_of.h>
#include <Atlas/image/internal/srgb.h>

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
    if (it->second.Has("texCoord") && it->second.Get("texCoord").IsInt())
      set = it->second.Get("texCoord").GetNumberAsInt();
  return "TEXCOORD_" + std::to_string(set);
}

/// How a material colours: its base colour. A picture that cannot be read is told of, and left out.
inline Source_texture texture_of(const tinygltf::Model& model, const tinygltf::Material& material,
                                 std::vector<std::string>& warnings)
{
  Source_texture result;
  result.multiplies_colors = true;
  const auto& surface = material.pbrMetallicRoughness;
  for (std::size_t k = 0; k < 3 && k < surface.baseColorFactor.size(); ++k)
    result.factor[k] = encoded_srgb(surface.baseColorFactor[k]);
  const bool is_opaque = material.alphaMode != "MASK" && material.alphaMode != "BLEND";
  if (!is_opaque && surface.baseColorFactor.size() == 4)
    result.opacity = surface.baseColorFactor[3];
  const int t = surface.baseColorTexture.index;
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
  const auto& extensions = surface.baseColorTexture.extensions;
  if (const auto it = extensions.find("KHR_texture_transform"); it != extensions.end())
    result.transform = texture_transform(it->second);
  return result;
}

} // namespace Atlas::internal

#endif
