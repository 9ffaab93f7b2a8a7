// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/input/result_input.h"

#include "app/session/run/command_line.h"
#include "app/session/run/read_result.h"
#include "app/session/run/result_reading.h"
#include "engine/io/maps/result_file.h"

#include <algorithm>

namespace episcope::cli {
namespace {

/// Options of `reading`, the focus plane left aside, that `other` was not read with, as on the
/// command line: " --flip=u".
std::string options_missing_in(const Reading& other, const Reading& reading) {
  ParameterSet options = reading.options;
  std::erase_if(options, [&other](const auto& option) {
    return option.first == Reading::kFocus || std::ranges::count(other.options, option) > 0;
  });
  return reading_options_text(options);
}

}  // namespace

NamedReading reading_of(const std::string& result) {
  return {result, io::read_reading(result)};
}

Scene load_input_of(const NamedReading& result, const std::string& input,
                    const ReadOptions& options, const Progress& progress) {
  return load_input(
      input, options_for_result(result.file, result.reading, input, options.options.values()),
      options.needs_truth, progress);
}

void note_other_source(const Estimate& estimate, const LightField& light_field, Job& job) {
  if (!is_of_other_samples(estimate, light_field)) return;
  const Reading& own = estimate.reading;
  const Reading& other = light_field.info().reading;
  std::string how;
  if (const std::string more = options_missing_in(other, own); !more.empty()) {
    how = "; its own were read with" + more;
  } else if (const std::string less = options_missing_in(own, other); !less.empty()) {
    how = "; its own were read without" + less;
  }
  job.note("the result was estimated from other samples than those of " + light_field.info().name +
           how);
}

void note_other_options(const NamedReading& first, const NamedReading& second, Job& job) {
  const auto tell = [&job](const NamedReading& one, const NamedReading& other) {
    const std::string options = options_missing_in(other.reading, one.reading);
    if (options.empty()) return;
    job.note("the light field of " + one.file + " was read with" + options + ", that of " +
             other.file + " was not");
  };
  if (first.reading.reader.empty() || second.reading.reader.empty()) return;
  tell(first, second);
  tell(second, first);
}

}  // namespace episcope::cli
