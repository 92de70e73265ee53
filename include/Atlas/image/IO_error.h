// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_IO_ERROR_H
#define ATLAS_IMAGE_IO_ERROR_H

#include <stdexcept>

namespace Atlas {

/// \brief A file could not be read or written. `what()` is one line: the file, the line or byte if there is
/// one, and what is wrong.
struct IO_error : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

} // namespace Atlas

#endif
