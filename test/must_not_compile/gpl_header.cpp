// SPDX-License-Identifier: MIT
// Must not compile with -DCGAL_LICENSE_ERROR: every header of CGAL's GPL packages includes such a line.
#include <CGAL/license/Surface_mesh_parameterization.h>
