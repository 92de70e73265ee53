// SPDX-License-Identifier: MIT
#ifndef ATLAS_PYTHON_OPTIONS_H
#define ATLAS_PYTHON_OPTIONS_H

#include "../../bindings/Scene.h"
#include <pybind11/pybind11.h>

namespace Atlas::python {

/// Options from keywords. \throws pybind11::type_error for names that do not exist and values of a wrong
/// type, Invalid_argument for values that cannot be
bindings::Scene_options scene_options(const pybind11::dict& keywords);

} // namespace Atlas::python

#endif
