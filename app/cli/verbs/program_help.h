// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace episcope::cli {

/// What the program does, in a sentence.
inline constexpr const char* kProgramSummary =
    "Estimates and evaluates disparity in 4D light fields.";
/// What INPUT can be, in lines that end with a new line.
inline constexpr const char* kInputHelp =
    "INPUT is an lf.h5, a scene folder of the 2013 archive, a folder of the 2016 benchmark,\n"
    "a folder of images on a grid, demo, or demo:<scene> for a built-in scene.\n";
/// Command lines that work, one a line.
inline constexpr const char* kProgramExample =
    "  episcope-cli estimate epi_s demo -o demo.h5\n"
    "  episcope-cli evaluate demo.h5 --truth demo\n";

/// What `--help` without a verb prints.
[[nodiscard]] std::string program_help();

}  // namespace episcope::cli
