// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/run/result_reading.h"

#include "app/session/run/command_line.h"
#include "app/session/scene/load_scene.h"
#include "engine/core/error.h"
#include "engine/core/light_field/shear.h"

#include <algorithm>

namespace episcope {
namespace {

using Option = ParameterSet::value_type;

const Option* find(const ParameterSet& options, const std::string& key) {
  const auto found = std::ranges::find(options, key, &Option::first);
  return found == options.end() ? nullptr : &*found;
}

IoError contradiction(const std::string& result, const Option& given, const Option* stored) {
  const std::string was =
      stored ? "with" + reading_options_text({*stored}) : "without --" + given.first;
  return {result, "was made " + was + ", but" + reading_options_text({given}) +
                      " was asked for; leave --" + given.first +
                      " out, or name the file of another run"};
}

ParameterSet without_focus(ParameterSet options) {
  std::erase_if(options, [](const Option& option) { return option.first == Reading::kFocus; });
  return options;
}

}  // namespace

io::OpenOptions options_for_result(const std::string& result, const Reading& of_result,
                                   const std::string& input, const ParameterSet& given) {
  const Schema<io::OpenOptions> schema = io::open_schema();
  const io::OpenOptions asked = schema.parse(given);
  if (of_result.reader.empty()) return asked;
  const Option* focus = find(given, Reading::kFocus);
  if (focus && asked.focus_px != of_result.focus_px()) {
    throw contradiction(result, *focus, find(of_result.options, Reading::kFocus));
  }
  ParameterSet options = given;
  const bool is_same_form = reader_of(input, asked) == of_result.reader;
  for (const Option& stored : of_result.options) {
    if (!is_same_form && stored.first != Reading::kFocus) continue;
    const Option* known = find(given, stored.first);
    if (!known) options.push_back(stored);
    if (known && !(known->second == stored.second)) throw contradiction(result, *known, &stored);
  }
  return schema.parse(options);
}

void bring_to_focus(Estimate& estimate, const LightField& light_field, const Progress& progress) {
  if (estimate.reading.reader.empty()) return;
  const double moved_px = light_field.info().reading.focus_px() - estimate.reading.focus_px();
  if (moved_px == 0) return;
  // It comes from the same samples if its light field would, at that plane, be this one.
  const std::uint64_t hash = estimate.source_hash == 0 ? 0 : light_field.sample_hash();
  estimate = sheared(estimate, {light_field.center(), hash}, moved_px, progress);
}

std::string differing_options(const Estimate& estimate, const LightField& light_field) {
  const Reading& own = estimate.reading;
  const Reading& other = light_field.info().reading;
  if (own.reader != other.reader || own.reader.empty()) return {};
  if (without_focus(own.options) == without_focus(other.options)) return {};
  const std::string text = reading_options_text(without_focus(own.options));
  return text.empty() ? "no options" : text;
}

}  // namespace episcope
