// SPDX-License-Identifier: MIT
// What the parts of the program share.
#ifndef REPACK_ATLAS_H
#define REPACK_ATLAS_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/soup/Polygon_soup.h>

#include "packing_options.h"
#include <string>

enum Exit_code { VALID = 0, NOT_VALID = 1, COULD_NOT_TELL = 2 };

struct Arguments : Packing_options
{
  std::string file, output, texture;
  bool merges = false;                        ///< whether charts may merge
  bool has_size = false;                      ///< whether the size of the page is given
  double max_distortion = 0, max_stretch = 0; ///< of charts that merge; 0: not given
  unsigned threads = 0;
};

/// Merges the charts of the file within bounds, packs them, and moves its texture along. Writes all files and
/// the line on the result. \throw Atlas::IO_error
Exit_code defragment(const Arguments& arguments, Atlas::Polygon_soup soup, Atlas::Surface& surface,
                     const Atlas::Execution& execution);

#endif
