// SPDX-License-Identifier: MIT
#ifndef ATLAS_VERSION_H
#define ATLAS_VERSION_H

/// \file
/// \brief The version of Atlas, for the preprocessor. The version of the CMake package is read from here.

/// Rises when programs have to be changed much.
#define ATLAS_VERSION_MAJOR 0
/// Rises when there is something new; below 1.0 programs may have to be changed too.
#define ATLAS_VERSION_MINOR 2
/// Rises when faults have been mended.
#define ATLAS_VERSION_PATCH 0

/// "major.minor.patch"
#define ATLAS_VERSION "0.2.0"

#endif
