// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace episcope {

/// "0.1.0": the version that the top CMakeLists.txt gives the project.
extern const char* const kVersion;

/// The commit that a program was built from, for what it writes; empty until the program states it,
/// which it does before it starts threads. The engine does not know it, lest every commit change
/// every program that links the engine.
[[nodiscard]] const std::string& built_commit();
void state_built_commit(const std::string& commit);

}  // namespace episcope
