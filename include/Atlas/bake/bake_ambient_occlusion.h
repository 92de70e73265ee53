// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_BAKE_AMBIENT_OCCLUSION_H
#define ATLAS_BAKE_BAKE_AMBIENT_OCCLUSION_H

#include <Atlas/bake/bake_texture.h>
#include <Atlas/core/Execution.h>
#include <Atlas/image/Image.h>
#include <Atlas/soup/Polygon_soup.h>

#include <cstddef>
#include <functional>
#include <limits>

namespace Atlas {

/// What ambient occlusion is asked for.
struct Ambient_occlusion_options
{
  std::size_t samples = 64; ///< directions per texel, at least 1
  double distance =
      std::numeric_limits<double>::infinity(); ///< what is farther away hides nothing; unit of the model
};

/// \brief How much of the sky every place of the surface sees, as a grey texture: white is open, black is
/// shut in.
///
/// The sky is the half-space in front of the face, every direction weighted with its cosine; faces hide it
/// from both of their sides. Directions are the same in every run, and turned from texel to texel.
/// O(texels x samples x log triangles) expected.
///
/// Part of `Atlas::Occlusion`, which is compiled with CGAL's AABB tree and therefore under the GPL.
/// \param page which one
Image bake_ambient_occlusion(const Polygon_soup& soup, Image_size size,
                             const Ambient_occlusion_options& options = {}, Index page = 0,
                             const Execution& execution = Execution());

/// What `bake_ambient_occlusion()` shows. The soup must outlive it.
Bake_shader occlusion_shader(const Polygon_soup& soup, const Ambient_occlusion_options& options = {});

/// The place on another surface for a place on this one.
using Bake_place = std::function<Bake_sample(const Bake_sample&)>;

/// \brief Where the places of a mesh are on another one of the same shape, such as the scan that it has been
/// simplified from: the nearest hit along the normal, outwards or inwards, of a face of the other mesh that
/// looks the same way; where there is none within the cage, its nearest point.
///
/// A shader of the other mesh after it is what a bake of one mesh from another shows:
/// `[&](const Bake_sample& s) { return shader_of_detail(place(s)); }`.
///
/// \param cage  how far hits may be away, as a share of the diagonal of the other mesh's bounding box, at
/// least 0; 0 takes nearest points alone
/// \throw Invalid_argument the other mesh has no triangle with an area, or `cage` is negative or no number
///
/// Normals are those of `shading_normal()`. O(log triangles) expected for a place. Part of
/// `Atlas::Occlusion`. Both soups may go before it.
Bake_place place_on(const Polygon_soup& soup, const Polygon_soup& detail, double cage = 0.02);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/bake/internal/occlusion/bake_ambient_occlusion_impl.h>
#include <Atlas/bake/internal/occlusion/place_on_impl.h>
#endif

#endif
