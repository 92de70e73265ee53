// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_DRAW_ATLAS_H
#define ATLAS_IMAGE_DRAW_ATLAS_H

#include <Atlas/image/Image.h>
#include <Atlas/soup/Polygon_soup.h>

#include <cstddef>
#include <vector>

namespace Atlas {

/// Meshes with more faces are drawn without the edges inside charts: nothing else would be seen.
inline constexpr std::size_t most_faces_with_edges = 20000;

/// \brief A picture of the page: charts in colours, their borders dark, flagged faces red.
/// \param soup       its `uv` are drawn, [0,1]^2 fills the picture
/// \param face_chart per face the number of its chart; faces without coordinates are not drawn
/// \param size       in pixels, of the shape of the page
/// \param flagged    faces to show in red
/// \param page       which one to draw
/// \throw Invalid_argument a list has not an entry per face, or a flagged face does not exist
Image draw_atlas(const Polygon_soup& soup, const std::vector<Index>& face_chart, Image_size size = 1024,
                 const std::vector<Index>& flagged = {}, Index page = 0);

/// The stretch at which the scale of heat ends.
inline constexpr double hottest_stretch = 2;

/// The colour of a stretch as `face_stretch()` gives it: 1 is cool, `hottest_stretch` and more is hot, grey
/// unknown.
Color color_of_stretch(double stretch);

/// \brief A picture of the page with faces coloured by their stretch.
/// \param stretch per face, as `face_stretch()` gives it
/// \param size    in pixels, of the shape of the page
/// \param page    which one to draw
/// \throw Invalid_argument `stretch` has not an entry per face
Image draw_stretch(const Polygon_soup& soup, const std::vector<double>& stretch, Image_size size = 1024,
                   Index page = 0);

/// The picture with the scale of `color_of_stretch()` below it.
Image with_stretch_scale(const Image& picture);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/image/internal/draw_atlas_impl.h>
#endif

#endif
