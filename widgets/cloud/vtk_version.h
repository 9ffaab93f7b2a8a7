// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace episcope {

/// Of the VTK that is loaded: "9.1.0".
[[nodiscard]] std::string vtk_version();

}  // namespace episcope
