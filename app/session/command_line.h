// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"
#include "engine/disparity/common/estimator.h"
#include "engine/io/open/open.h"

#include <string>

namespace episcope {

/// The `episcope-cli estimate` line that repeats an estimate of the light field that `input` opens.
/// Parameters at their defaults are left out; of a method this build does not know, all are named.
[[nodiscard]] std::string command_line_for(const Estimate& estimate, const std::string& input,
                                           const io::OpenOptions& conventions = {});

/// The same for a run that was not started yet.
[[nodiscard]] std::string command_line_for(const std::string& method, const ParameterSet& values,
                                           ViewSelection views, const std::string& input,
                                           const io::OpenOptions& conventions = {});

/// Values that are not the defaults of the method; of a method this build does not know, all.
[[nodiscard]] ParameterSet changed_parameters(const std::string& method,
                                              const ParameterSet& values);

/// Options that make `episcope-cli` read a light field as the user chose, each led by a space.
[[nodiscard]] std::string reading_options(const io::OpenOptions& conventions);

/// A word as a POSIX shell reads it back: quoted where it must be.
[[nodiscard]] std::string shell_quoted(const std::string& word);

}  // namespace episcope
