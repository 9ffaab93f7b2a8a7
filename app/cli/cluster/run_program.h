// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace episcope::cli {

/// What a program that has ended left.
struct ProgramAnswer {
  int exit_code = 0;  ///< 128 and the signal if it was killed by one.
  std::string out;
  std::string err;
};

/// Runs a program, found as the shell finds it, with these words, and waits for its end. Throws
/// Unavailable if it cannot be started.
[[nodiscard]] ProgramAnswer run_program(const std::string& program,
                                        const std::vector<std::string>& words);

}  // namespace episcope::cli
