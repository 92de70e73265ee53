// SPDX-License-Identifier: MIT
// Soups from the text of a file.
#ifndef ATLAS_TEST_SOUPS_H
#define ATLAS_TEST_SOUPS_H

#include <Atlas/IO/read_polygon_soup.h>

#include "temporary_folder.h"
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

namespace Atlas::test {

using Faces = std::vector<std::vector<Index>>;

inline Polygon_soup read_text(const std::string& name, const std::string& text)
{
  const Temporary_folder folder;
  return read_polygon_soup(folder.write(name, text));
}

inline Faces faces_of(const Polygon_soup& soup)
{
  Faces result;
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    result.emplace_back(soup.face(f).begin(), soup.face(f).end());
  return result;
}

/// Appends the bytes of a number.
template <typename Number>
void append(std::string& bytes, Number value, std::endian order = std::endian::little)
{
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (order != std::endian::native)
    std::reverse(raw, raw + sizeof raw);
  bytes.append(raw, sizeof raw);
}

} // namespace Atlas::test

#endif
