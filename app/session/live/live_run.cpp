// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/live/live_run.h"

#include "app/session/live/live_part.h"
#include "app/session/scene/scene_range.h"
#include "engine/core/error.h"
#include "engine/core/parallel/stopwatch.h"
#include "engine/disparity/registry.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace episcope {
namespace {

constexpr const char* kRange = "range";  // in the schema of every method
constexpr const char* kView = "view";    // of those that are of one view, whichever
constexpr int kLeastCoarse = 24;         // px, of the smaller side

const ParameterDescription* find_parameter(const Estimator& estimator, const std::string& key) {
  const auto found = std::ranges::find(estimator.parameters, key, &ParameterDescription::key);
  return found == estimator.parameters.end() ? nullptr : &*found;
}

ParameterValue value_of(const Estimator& estimator, const ParameterSet& values,
                        const std::string& key) {
  const auto found = std::ranges::find(values, key, &ParameterSet::value_type::first);
  if (found != values.end()) return found->second;
  return find_parameter(estimator, key)->default_value;
}

void set_value(ParameterSet& values, const std::string& key, ParameterValue value) {
  const auto found = std::ranges::find(values, key, &ParameterSet::value_type::first);
  if (found != values.end()) {
    found->second = std::move(value);
  } else {
    values.emplace_back(key, std::move(value));
  }
}

/// A run that was made definite: for which view, in which range, of which pixels.
struct LiveRun {
  Estimator estimator;
  ParameterSet asked;
  EstimateRequest request;
  Interval range;
  std::optional<ViewIndex> view;  ///< That the estimate is of; none = all views.
  LivePart part;
  bool is_at_once = false;  ///< The full map is there as soon as a coarse one would be.
};

// The view comes from the parameter, else from the centre or from all views.
void choose_view(const LiveRequest& request, LiveRun& run) {
  const ViewIndex center = request.light_field->center();
  run.request.options.views = ViewSelection::Center;
  if (find_parameter(run.estimator, kView)) {
    const auto chosen = std::get<ViewOrAuto>(value_of(run.estimator, run.asked, kView));
    run.view = chosen.value_or(request.view);
    set_value(run.request.parameters, kView, ViewOrAuto(run.view));
  } else if (run.estimator.info.all_views && request.view != center) {
    run.request.options.views = ViewSelection::All;
  } else {
    run.view = center;
  }
}

LiveRun definite_run(LiveSource& source, const LiveRequest& request, const Progress& progress) {
  LiveRun run{find_estimator(request.method), request.parameters, {}, {}, {}, {}, false};
  run.request = {request.method, request.parameters, {}};
  run.range = source.range(
      std::get<IntervalOrAuto>(value_of(run.estimator, request.parameters, kRange)), progress);
  set_value(run.request.parameters, kRange, IntervalOrAuto(run.range));
  choose_view(request, run);
  const bool on_device = chosen_device(Device::Auto, run.estimator.info) == Device::Cuda;
  // A device has the whole light field already, and is done as soon as the CPU with a part of it.
  run.is_at_once = on_device;
  run.part = live_part(*request.light_field, on_device ? PixelRect{} : request.in_sight, run.range,
                       run.view);
  return run;
}

// The parameters stay those that were asked for: they repeat the run elsewhere.
LiveMap map_of(Estimate estimate, const LiveRun& run, const LightField& whole) {
  for (auto& [key, value] : estimate.parameters) {
    if (key == kRange || key == kView) value = value_of(run.estimator, run.asked, key);
  }
  auto kept = std::make_shared<const Estimate>(std::move(estimate));
  const PixelRect all{0, 0, whole.height(), whole.width()};
  LiveMap map;
  map.estimate = kept;
  map.part = run.part.wanted == all ? PixelRect{} : run.part.wanted;
  return map;
}

// Without the hash of the samples, which nobody asks a live map for.
Estimate run_on(const LightField& light_field, const Estimator& estimator,
                const EstimateRequest& request, const Progress& progress) {
  Estimate estimate = estimator.run(light_field, request.parameters, request.options, progress);
  progress.check();
  return estimate;
}

std::optional<LiveMap> coarse_map(LiveSource& source, const LiveRun& run, ViewIndex view,
                                  const Progress& progress) {
  const LightFieldPtr small = source.coarse(run.part.read, progress.part(0, 0.3));
  if (std::min(small->height(), small->width()) < kLeastCoarse) return {};
  EstimateRequest request = run.request;
  set_value(request.parameters, kRange,
            IntervalOrAuto(Interval{run.range.min / kLiveFactor, run.range.max / kLiveFactor}));
  try {
    const Estimate found = run_on(*small, run.estimator, request, progress.part(0.3, 1));
    LiveMap map = map_of(in_whole_views(found, run.part, kLiveFactor, *source.light_field(),
                                        run.view.value_or(view)),
                         run, *source.light_field());
    const Interval range = display_range(found);
    map.display_range = {kLiveFactor * range.min, kLiveFactor * range.max};
    map.is_coarse = true;
    return map;
  } catch (const InvalidInput&) {
    return {};  // what is wrong only at this size is right at the full one, which says the rest
  }
}

LiveMap full_map(LiveSource& source, const LiveRun& run, const Progress& progress) {
  const LightFieldPtr light_field = source.full(run.part.read, progress.part(0, 0.05));
  Estimate found = run_on(*light_field, run.estimator, run.request, progress.part(0.05, 1));
  const Interval range = display_range(found);
  const LightField& whole = *source.light_field();
  const bool is_whole = light_field == source.light_field();
  LiveMap map = map_of(is_whole ? std::move(found) : in_whole_views(found, run.part, 1, whole, {}),
                       run, whole);
  map.display_range = range;
  return map;
}

}  // namespace

LiveMap estimate_live(LiveSource& source, const LiveRequest& request,
                      const std::function<void(LiveMap)>& on_coarse, const Progress& progress) {
  const Stopwatch watch;
  const LiveRun run = definite_run(source, request, progress.part(0, 0.05));
  if (!run.is_at_once) {
    if (auto coarse = coarse_map(source, run, request.view, progress.part(0.05, 0.15))) {
      coarse->seconds = watch.seconds();
      on_coarse(std::move(*coarse));
    }
  }
  LiveMap map = full_map(source, run, progress.part(0.15, 1));
  map.seconds = watch.seconds();
  return map;
}

}  // namespace episcope
