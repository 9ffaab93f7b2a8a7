// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/estimate/method_range.h"

#include "app/session/session.h"
#include "engine/disparity/disparity_range.h"
#include "widgets/controls/parameter_form.h"
#include "widgets/panels/method_panel.h"

#include <algorithm>

namespace episcope {
namespace {

// Whether a range that is left open in these parameters is found from the images.
bool finds_range(const LightField& light_field, const ParameterSet& parameters) {
  const ParameterValue* value = find_value(parameters, "range");
  const auto* wanted = value ? std::get_if<IntervalOrAuto>(value) : nullptr;
  return wanted && range_source(light_field, *wanted) == RangeSource::Found;
}

}  // namespace

MethodRange::MethodRange(const Workbench& bench, MethodPanel& panel)
    : QObject(&bench.owner), bench_(bench), panel_(panel), job_(this) {
  bench_.session.on_changed([this](Parts parts) {
    if (!parts.has_any(Part::Scene | Part::Estimates | Part::FoundRange)) return;
    showHints();
    search();
  });
  connect(&panel_, &MethodPanel::requestChanged, this, &MethodRange::search);
  showHints();
}

void MethodRange::showHints() {
  RangeHints hints;
  if (const LightFieldPtr light_field = bench_.session.light_field()) {
    hints.is_open = true;
    hints.promised = light_field->info().disparity_range;
    const Interval found = bench_.session.found_range();
    if (found.length() > 0) hints.found = found;
  }
  panel_.form()->setRangeHints(hints);
}

// A run that has found it made it known (search_range), so that the search costs nothing then.
bool MethodRange::isWanted() const {
  const LightField& light_field = *bench_.session.light_field();
  if (light_field.grid().count() < 2) return false;
  if (bench_.session.known_range().length() == 0) return true;
  if (finds_range(light_field, panel_.request().values)) return true;
  return std::ranges::any_of(bench_.session.estimates(), [&](const EstimateEntry& each) {
    return each.estimate && each.foreign_file.empty() &&
           finds_range(light_field, each.estimate->parameters);
  });
}

void MethodRange::search() {
  const LightFieldPtr light_field = bench_.session.light_field();
  const std::uint64_t scene = bench_.session.generation();
  if (!light_field) return job_.drop();
  if (searched_ == scene || bench_.session.found_range().length() > 0 || !isWanted()) return;
  searched_ = scene;
  job_.start<Interval>(
      [light_field](const Progress& progress) {
        return search_range(*light_field, IntervalOrAuto::found(), progress);
      },
      [this, scene](Interval found) { bench_.session.set_found_range(scene, found); });
}

}  // namespace episcope

#include "moc_method_range.cpp"
