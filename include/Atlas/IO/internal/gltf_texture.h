// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_GLTF_TEXTURE_H
#define ATLAS_IO_INTERNAL_GLTF_TEXTURE_H

#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/core/errors.h>
#include <Atlas/image/internal/image_of.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <tiny_gltf.h>

namespace Atlas::internal {

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

} // namespace Atlas::internal

#endif
