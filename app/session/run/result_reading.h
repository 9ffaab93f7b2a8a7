// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/open/open_options.h"

#include <string>

namespace episcope {

/// How to read `input`, so that it has the views that a result or labels were made from: what
/// `given` says and, where that is silent, what their file says of its own light field. The focus
/// plane holds for every form, the other options for the form that they were given for. `result`
/// names the file in sentences. Throws IoError, saying what to change, if `given` contradicts the
/// result; InvalidInput for a bad option.
[[nodiscard]] io::OpenOptions options_for_result(const std::string& result,
                                                 const Reading& of_result, const std::string& input,
                                                 const ParameterSet& given);

/// Brings a result to the focus plane of the light field, if its file says that it was estimated at
/// another. Throws Cancelled.
void bring_to_focus(Estimate& estimate, const LightField& light_field, const Progress& progress);

/// Options by which the light field of a result was read otherwise than this one, as on the command
/// line ("--flip=u"), the focus plane left aside; empty if there are none, or that is not known.
[[nodiscard]] std::string differing_options(const Estimate& estimate,
                                            const LightField& light_field);

}  // namespace episcope
