// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

namespace episcope::python {

/// Adds the class Labeling, and `label`.
void add_labels(pybind11::module_& module);

}  // namespace episcope::python
