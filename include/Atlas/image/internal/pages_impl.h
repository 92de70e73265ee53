// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_INTERNAL_PAGES_IMPL_H
#define ATLAS_IMAGE_INTERNAL_PAGES_IMPL_H

#include <Atlas/core/errors.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/image/pages.h>

#include <cmath>

namespace Atlas {

ATLAS_INLINE std::vector<Point_2> udim_uv(const Polygon_soup& soup)
{
  std::vector<Point_2> result = soup.uv;
  if (result.empty() || soup.face_page.empty())
    return result;
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    for (std::size_t c = soup.first[f]; c < soup.first[f + 1]; ++c)
      result[c] = Point_2(result[c].x() + soup.face_page[f] % 10, result[c].y() + soup.face_page[f] / 10);
  return result;
}

ATLAS_INLINE Index separate_udim(Polygon_soup& soup)
{
  constexpr double most_rows = 1000;
  soup.face_page.assign(soup.number_of_faces(), 0);
  for (std::size_t f = 0; f < soup.number_of_faces() && !soup.uv.empty(); ++f) {
    const std::size_t n = soup.face(f).size();
    double u = 0, v = 0;
    for (std::size_t c = soup.first[f]; c < soup.first[f + 1]; ++c) {
      u += soup.uv[c].x() / static_cast<double>(n);
      v += soup.uv[c].y() / static_cast<double>(n);
    }
    if (!(u >= 0 && u < 10 && v >= 0 && v < most_rows))
      continue;
    const double column = std::floor(u), row = std::floor(v);
    soup.face_page[f] = static_cast<Index>(column + 10 * row);
    for (std::size_t c = soup.first[f]; c < soup.first[f + 1]; ++c)
      soup.uv[c] = Point_2(soup.uv[c].x() - column, soup.uv[c].y() - row);
  }
  return soup.number_of_pages();
}

ATLAS_INLINE std::string page_file_name(const std::string& name, Index page, Index number_of_pages)
{
  if (number_of_pages <= 1 || name.empty())
    return name;
  const std::size_t dot = name.find_last_of('.');
  const std::size_t at = dot == std::string::npos || dot == 0 ? name.size() : dot;
  return name.substr(0, at) + '.' + std::to_string(udim_tile(page)) + name.substr(at);
}

ATLAS_INLINE std::size_t sheet_columns(std::size_t number_of_pages)
{
  std::size_t columns = 1;
  while (columns * columns < number_of_pages)
    ++columns;
  return columns;
}

ATLAS_INLINE Polygon_soup sheet_of_pages(const Polygon_soup& soup)
{
  Polygon_soup sheet = soup;
  const std::size_t columns = sheet_columns(soup.number_of_pages());
  sheet.face_page.clear();
  if (columns == 1 || soup.uv.empty())
    return sheet;
  const auto side = static_cast<double>(columns);
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    const std::size_t page = soup.page(f);
    const auto left = static_cast<double>(page % columns);
    const auto bottom = static_cast<double>(columns - 1 - page / columns);
    for (std::size_t c = soup.first[f]; c < soup.first[f + 1]; ++c)
      sheet.uv[c] = Point_2((soup.uv[c].x() + left) / side, (soup.uv[c].y() + bottom) / side);
  }
  return sheet;
}

ATLAS_INLINE Image sheet_of_images(const std::vector<Image>& pages)
{
  if (pages.empty())
    return Image();
  const std::size_t columns = sheet_columns(pages.size());
  const std::size_t width = pages.front().width, height = pages.front().height;
  Image sheet(columns * width, columns * height);
  for (std::size_t p = 0; p < pages.size(); ++p) {
    internal::require(pages[p].width == width && pages[p].height == height, "pages", "must have one size");
    paste(pages[p], sheet, p % columns * width, p / columns * height);
  }
  return sheet;
}

} // namespace Atlas

#endif
