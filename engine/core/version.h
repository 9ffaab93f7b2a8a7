// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// "0.1.0": the version that the top CMakeLists.txt gives the project.
extern const char* const kVersion;

}  // namespace episcope
