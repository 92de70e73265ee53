// SPDX-License-Identifier: MIT
#ifndef ATLAS_VERSION_H
#define ATLAS_VERSION_H

/// \file
/// \brief The version of Atlas, for the preprocessor. The version of the CMake package is read from here.

#define ATLAS_VERSION_MAJOR 0
#define ATLAS_VERSION_MINOR 1
#define ATLAS_VERSION_PATCH 0

/// "major.minor.patch"
#define ATLAS_VERSION "0.1.0"

#endif
