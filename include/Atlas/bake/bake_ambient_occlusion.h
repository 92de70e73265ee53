// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_BAKE_AMBIENT_OCCLUSION_H
#define ATLAS_BAKE_BAKE_AMBIENT_OCCLUSION_H

#include <Atlas/core/Execution.h>
#include <Atlas/image/Image.h>
#include <Atlas/soup/Polygon_soup.h>

#include <cstddef>
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

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/bake/internal/occlusion/bake_ambient_occlusion_impl.h>
#endif

#endif
