// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_PAGES_H
#define ATLAS_IMAGE_PAGES_H

#include <Atlas/core/Packing.h>
#include <Atlas/image/Image.h>
#include <Atlas/soup/Polygon_soup.h>

#include <cstddef>
#include <string>
#include <vector>

namespace Atlas {

/// How a format that has no pages tells them apart.
enum class Page_style {
  udim,     ///< by shifted coordinates: page p is the tile `udim_tile(p)`, one material shows all of them
  materials ///< by materials: coordinates stay in the unit square, every page has materials of its own
};

/// \brief The coordinates of all corners with their pages as UDIM tiles: u + p mod 10, v + p / 10.
///
/// Exact in double precision for coordinates that are floats of at least 2^-48. Rounded to floats they lose
/// as many bits as the number of the tile takes.
std::vector<Point_2> udim_uv(const Polygon_soup& soup);

/// \brief Takes coordinates as those of UDIM tiles: every face gets its page, and coordinates in the unit
/// square of it.
///
/// The middle of a face tells its tile. Faces outside of the ten columns of tiles, or without coordinates,
/// stay as they are, on page 0. \return the number of pages
Index separate_udim(Polygon_soup& soup);

/// \brief The name of a page's file: of several pages, the number of its UDIM tile stands before the
/// extension, "wood.png" becomes "wood.1002.png".
std::string page_file_name(const std::string& name, Index page, Index number_of_pages);

/// Pages lie in rows of so many on a sheet, which has the shape of a page.
std::size_t sheet_columns(std::size_t number_of_pages);

/// \brief The soup with all of its pages side by side on one, the first at the top left, for pictures that
/// show one page only.
Polygon_soup sheet_of_pages(const Polygon_soup& soup);

/// \brief The pictures of all pages as one, in the places that `sheet_of_pages()` gives them.
/// \throw Invalid_argument they differ in size
Image sheet_of_images(const std::vector<Image>& pages);

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
#include <Atlas/image/internal/pages_impl.h>
#endif

#endif
