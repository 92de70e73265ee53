// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_LIBRARY_H
#define ATLAS_CORE_INTERNAL_LIBRARY_H

/// \file
/// \brief How Atlas is compiled.
///
/// As a rule Atlas is a library: headers declare, and what they declare is compiled once, from the headers
/// named
/// `*_impl.h` in `internal`. With `ATLAS_HEADER_ONLY` defined, as the CMake target `Atlas::Atlas_header_only`
/// does, every header includes its `*_impl.h`, and there is nothing to link.

/// Stands before definitions in `*_impl.h`.
#ifdef ATLAS_HEADER_ONLY
#define ATLAS_INLINE inline
#else
#define ATLAS_INLINE
#endif

#endif
