// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_ROW_ENDS_H
#define ATLAS_IO_INTERNAL_ROW_ENDS_H

#include <Atlas/core/errors.h>
#include <Atlas/soup/Polygon_soup.h>

#include <string>
#include <string_view>

namespace Atlas::internal {

/// Where the rows of a text file end.
enum class Row_ends {
  lines,   ///< each has a line, and may have more values than it must
  anywhere ///< line ends are blanks, and there are no other values
};

/// Reads a file in which rows have lines of their own; where that cannot be, line ends are blanks.
/// \tparam Reader  tells by `may_have_free_rows()`, once it has failed, whether that is worth a trial
/// \throw IO_error with the reason against lines, which is the better one
template <typename Reader>
Polygon_soup read_with_any_row_ends(std::string_view bytes, const std::string& file_name)
{
  Reader by_lines(bytes, file_name, Row_ends::lines);
  try {
    return by_lines.read();
  } catch (const IO_error&) {
    if (!by_lines.may_have_free_rows())
      throw;
    try {
      return Reader(bytes, file_name, Row_ends::anywhere).read();
    } catch (const IO_error&) {
      // The first reason is the better one.
    }
    throw;
  }
}

} // namespace Atlas::internal

#endif
