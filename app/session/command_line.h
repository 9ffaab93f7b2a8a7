// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/disparity/estimator.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace episcope {

/// The `episcope-cli estimate` line that repeats an estimate of the light field that `input` opens
/// with these reading options.
/// Parameters at their defaults are left out; of a method this build does not know, all are named.
[[nodiscard]] std::string command_line_for(const Estimate& estimate, const std::string& input,
                                           const ParameterSet& reading = {});

/// The line for a run that was not started yet.
[[nodiscard]] std::string command_line_for(const std::string& method, const ParameterSet& values,
                                           ViewSelection views, const std::string& input,
                                           const ParameterSet& reading = {});

/// A method with its parameters and what its weights are, if it has any: one of "methods" of
/// `episcope-cli methods --json`.
[[nodiscard]] nlohmann::ordered_json method_json(const Estimator& method);
/// Version, date and hash of installed weights, or the "problem" with them.
[[nodiscard]] nlohmann::ordered_json weights_json(const std::string& name);

/// Values that are not the defaults of the method; of a method this build does not know, all.
[[nodiscard]] ParameterSet changed_parameters(const std::string& method,
                                              const ParameterSet& values);

/// "inner-scale": what the option of a parameter is called; "inner_scale" is read as well.
[[nodiscard]] std::string option_name(std::string key);

/// Options of `episcope-cli`, each led by a space: " --range=-1,2". Toggles among `descriptions`
/// stand by themselves.
[[nodiscard]] std::string options_text(const ParameterSet& options,
                                       const std::vector<ParameterDescription>& descriptions);
/// Reading options (io::open_schema) as on the command line: " --flip=u --snake".
[[nodiscard]] std::string reading_options_text(const ParameterSet& options);

/// A word as a POSIX shell reads it back: quoted where it must be.
[[nodiscard]] std::string shell_quoted(const std::string& word);

}  // namespace episcope
