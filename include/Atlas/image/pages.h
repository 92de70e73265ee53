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

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/image/internal/pages_impl.h>
#endif

#endif
