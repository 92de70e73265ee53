// SPDX-License-Identifier: MIT
#ifndef ATLAS_PYTHON_BAKE_H
#define ATLAS_PYTHON_BAKE_H

#include <pybind11/pybind11.h>

namespace Atlas::python {

/// Adds what fills the texels of a page to the module.
void define_baking(pybind11::module_& m);

} // namespace Atlas::python

#endif
