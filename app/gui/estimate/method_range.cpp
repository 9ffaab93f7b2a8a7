// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/features.h"

#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/session.h"
#include "engine/disparity/disparity_range.h"
#include "widgets/controls/parameter_form.h"
#include "widgets/panels/method_panel.h"

#include <QObject>

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

/// Tells the form of the methods which disparity range the files promise and which one is found
/// from the images. The range is searched in the background where nothing else tells it, once a run
/// has searched it, or once the form asks to find it; the focus plane uses it as well.
class MethodRange : public QObject {
  Q_OBJECT

 public:
  MethodRange(const Workbench& bench, MethodPanel& panel)
      : QObject(&bench.owner), bench_(bench), panel_(panel), job_(this) {
    bench_.session.on_changed([this](Parts parts) {
      if (!parts.has_any(Part::Scene | Part::Estimates | Part::FoundRange)) return;
      showHints();
      search();
    });
    connect(&panel_, &MethodPanel::requestChanged, this, &MethodRange::search);
    showHints();
  }

 private:
  void showHints() {
    RangeHints hints;
    if (const LightFieldPtr light_field = bench_.session.light_field()) {
      hints.is_open = true;
      hints.promised = light_field->info().disparity_range;
      const Interval found = bench_.session.found_range();
      if (found.length() > 0) hints.found = found;
    }
    panel_.form()->setRangeHints(hints);
  }

  /// Searches the range if it is worth it now and not known yet.
  void search() {
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

  // A run that has found it made it known (search_range), so that the search costs nothing then.
  [[nodiscard]] bool isWanted() const {
    const LightField& light_field = *bench_.session.light_field();
    if (light_field.grid().count() < 2) return false;
    if (bench_.session.known_range().length() == 0) return true;
    if (finds_range(light_field, panel_.request().values)) return true;
    return std::ranges::any_of(bench_.session.estimates(), [&](const EstimateEntry& each) {
      return each.estimate && each.foreign_file.empty() &&
             finds_range(light_field, each.estimate->parameters);
    });
  }

  Workbench bench_;
  MethodPanel& panel_;
  LatestJob job_;
  std::uint64_t searched_ = 0;  // the scene that the job is or was of
};

void add_method_range(const Workbench& bench, MethodPanel& panel) {
  new MethodRange(bench, panel);
}

}  // namespace episcope

#include "method_range.moc"
