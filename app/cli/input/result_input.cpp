// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/input/result_input.h"

#include "app/session/run/read_result.h"
#include "app/session/run/result_reading.h"
#include "engine/io/maps/result_file.h"

namespace episcope::cli {

Scene load_input_of(const std::string& result, const std::string& input, const ReadOptions& options,
                    const Progress& progress) {
  return load_input(
      input, options_for_result(result, io::read_reading(result), input, options.options.values()),
      options.needs_truth, progress);
}

void note_other_source(const Estimate& estimate, const LightField& light_field, Job& job) {
  if (!is_of_other_samples(estimate, light_field)) return;
  job.note("the result was estimated from other samples than those of " + light_field.info().name);
}

}  // namespace episcope::cli
