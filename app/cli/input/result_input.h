// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/input/input.h"
#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/light_field.h"

#include <string>

namespace episcope::cli {

/// How the light field of a result or of labels was read.
struct NamedReading {
  std::string file;
  Reading reading;
};

/// What a result file says of its own. Throws IoError if it is an HDF5 file and damaged.
[[nodiscard]] NamedReading reading_of(const std::string& result);

/// Opens the light field that a result or labels are compared with, so that both are of the same
/// views: as the file says that its own was read (focus plane, order of views, …), where `options`
/// say nothing. Throws as `load_input`, and IoError, naming what to change, if `options` contradict
/// the file.
[[nodiscard]] Scene load_input_of(const NamedReading& result, const std::string& input,
                                  const ReadOptions& options, const Progress& progress);

/// Notes that the estimate was made from other samples than those of the light field, if so, and
/// which reading options may explain it.
void note_other_source(const Estimate& estimate, const LightField& light_field, Job& job);

/// Notes reading options, the focus plane left aside, that one of two results has and the other has
/// not, if both say how their light field was read.
void note_other_options(const NamedReading& first, const NamedReading& second, Job& job);

}  // namespace episcope::cli
