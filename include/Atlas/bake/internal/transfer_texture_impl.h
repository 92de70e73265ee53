// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_TRANSFER_TEXTURE_IMPL_H
#define ATLAS_BAKE_INTERNAL_TRANSFER_TEXTURE_IMPL_H

#include <Atlas/bake/bake_texture.h>
#include <Atlas/bake/internal/bake_texels.h>
#include <Atlas/bake/internal/texel_shader.h>
#include <Atlas/core/internal/library.h>

namespace Atlas {

ATLAS_INLINE Bake_shader texture_shader(const Polygon_soup& soup, Image_size size,
                                        const Source_textures& source, const Color& missing)
{
  return [shader = internal::texel_shader(soup, size, source, missing)](const Bake_sample& sample) {
    return shader(sample).color;
  };
}

ATLAS_INLINE Image transfer_texture(const Polygon_soup& soup, Image_size size, const Source_textures& source,
                                    Index page, const Execution& execution, const Color& missing)
{
  return internal::bake_texels(soup, size, internal::texel_shader(soup, size, source, missing), page,
                               execution);
}

} // namespace Atlas

#endif
