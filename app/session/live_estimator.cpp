// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/live_estimator.h"

#include "app/session/scene_summary.h"
#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/core/shear.h"
#include "engine/disparity/block_disparities.h"
#include "engine/disparity/disparity_range.h"
#include "engine/disparity/registry.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace episcope {
namespace {

/// Pixels of which an estimate is made: those that are wanted, and those that a method reads for
/// them. Both are the whole view where the second would be most of it.
struct LivePart {
  PixelRect wanted;
  PixelRect read;  ///< Begins at multiples of `kLargestFactor`.
  friend bool operator==(const LivePart&, const LivePart&) = default;
};

/// How much smaller views are made for the first, coarse map: a network needs ten times the work of
/// other methods for a pixel.
constexpr int kUsualFactor = 4;
constexpr int kLargestFactor = 8;
constexpr int kLeastForNetwork = 48;  // px, of the smaller side

int coarse_factor(const Estimator& estimator, const LightField& lf) {
  const bool is_large = std::min(lf.height(), lf.width()) >= kLargestFactor * kLeastForNetwork;
  return estimator.info.weights.empty() || !is_large ? kUsualFactor : kLargestFactor;
}

// Filters, windows and tensors look no farther, px.
constexpr int kSupport = 16;
// A part that takes more of the view than this is not worth being cut out.
constexpr double kMostOfView = 0.6;

PixelRect whole(const LightField& lf) {
  return {0, 0, lf.height(), lf.width()};
}

double area(const PixelRect& rect) {
  return static_cast<double>(rect.y1 - rect.y0) * (rect.x1 - rect.x0);
}

int steps_to_farthest(int extent, std::optional<int> from) {
  return from ? std::max(*from, extent - 1 - *from) : extent - 1;
}

struct Pasting {
  LivePart part;
  int factor = 1;
  ViewIndex first{};
  GridShape grid{};
  int height = 0;
  int width = 0;
};

// Each value `scale` times as large, `outside` where there is none.
template <class T>
ViewStack<T> pasted(const ViewStack<T>& from, const Pasting& place, T scale, T outside) {
  if (from.empty()) return {};
  ViewStack<T> to(place.grid, place.height, place.width, 1, place.first);
  std::fill_n(to.data(), to.size(), outside);
  const auto& [wanted, read] = place.part;
  for (int i = 0; i < place.grid.count(); ++i) {
    const auto source = from.view(to.view_at(i));
    const auto target = to.view(to.view_at(i));
    for (int y = wanted.y0; y < wanted.y1; ++y) {
      const T* row = source.row(std::min((y - read.y0) / place.factor, source.height - 1));
      for (int x = wanted.x0; x < wanted.x1; ++x) {
        target.at(y, x) = scale * row[std::min((x - read.x0) / place.factor, source.width - 1)];
      }
    }
  }
  return to;
}

// 1 wherever there is a value.
ViewStack<std::uint8_t> all_valid(const ViewStack<float>& values) {
  ViewStack<std::uint8_t> ones(values.grid(), values.height(), values.width(), 1, values.first());
  std::fill_n(ones.data(), ones.size(), std::uint8_t{1});
  return ones;
}

DisparityField pasted(const DisparityField& from, const Pasting& place) {
  if (from.empty()) return {};
  const auto valid = from.valid.empty() ? all_valid(from.disparity) : from.valid.clone();
  DisparityField to;
  to.disparity = pasted(from.disparity, place, static_cast<float>(place.factor), 0.0F);
  to.valid = pasted<std::uint8_t>(valid, place, 1, 0);
  return to;
}

/// The part for `wanted`, seen from `view`, or from all views if there is none: lines of
/// disparities in `range` stay within what is read, and so do the surroundings that filters look
/// at. Of a global method, what lies outside would have had its influence. An empty `wanted` is the
/// whole view.
LivePart live_part(const LightField& lf, const PixelRect& wanted, Interval range,
                   std::optional<ViewIndex> view) {
  const PixelRect all = whole(lf);
  if (wanted.empty()) return {all, all};
  const double reach = std::max(std::abs(range.min), std::abs(range.max));
  const auto margin = [reach](int steps) {
    return static_cast<int>(std::ceil(reach * steps)) + kSupport;
  };
  const int down =
      margin(steps_to_farthest(lf.grid().v, view ? std::optional(view->v) : std::nullopt));
  const int across =
      margin(steps_to_farthest(lf.grid().u, view ? std::optional(view->u) : std::nullopt));
  const PixelRect inside{std::max(wanted.y0, 0), std::max(wanted.x0, 0),
                         std::min(wanted.y1, lf.height()), std::min(wanted.x1, lf.width())};
  const PixelRect read{std::max(inside.y0 - down, 0) / kLargestFactor * kLargestFactor,
                       std::max(inside.x0 - across, 0) / kLargestFactor * kLargestFactor,
                       std::min(inside.y1 + down, lf.height()),
                       std::min(inside.x1 + across, lf.width())};
  if (inside.empty() || area(read) > kMostOfView * area(all)) return {all, all};
  return {inside, read};
}

/// An estimate of `part.read`, made smaller by `factor`, as one of the whole views of
/// `light_field`: of `view` alone, or of all that it has if there is none. Pixels outside
/// `part.wanted` are invalid; a sample of smaller views stands for the block that it is the mean
/// of.
Estimate in_whole_views(const Estimate& estimate, const LivePart& part, int factor,
                        const LightField& lf, std::optional<ViewIndex> view) {
  const ViewStack<float>& from = estimate.field.disparity;
  const Pasting place{
      part,        factor,    view ? *view : from.first(), view ? GridShape{1, 1} : from.grid(),
      lf.height(), lf.width()};
  Estimate whole_views;
  whole_views.set_provenance(estimate.provenance());
  whole_views.range = {factor * estimate.range.min, factor * estimate.range.max};
  whole_views.field = pasted(estimate.field, place);
  whole_views.confidence = pasted(estimate.confidence, place, 1.0F, 0.0F);
  whole_views.layered.foreground = pasted(estimate.layered.foreground, place);
  whole_views.layered.background = pasted(estimate.layered.background, place);
  whole_views.layered.layers =
      pasted<std::uint8_t>(estimate.layered.layers, place, std::uint8_t{1}, std::uint8_t{0});
  whole_views.second = pasted(estimate.second, place);
  return whole_views;
}

}  // namespace

/// A light field, and its equalized views once a method needs them.
struct LiveViews {
  LightFieldPtr light_field;
  std::shared_ptr<EvenViews> even = std::make_shared<EvenViews>();
};

/// A light field as live estimates read it; what one of them made is kept for the next. For one
/// thread at a time. All functions throw Cancelled.
class LiveSource {
 public:
  explicit LiveSource(LiveViews views) : views_(std::move(views)) {}

  [[nodiscard]] const LightFieldPtr& light_field() const { return views_.light_field; }
  /// The range that a method would search if its parameter were `wanted` (`search_range`).
  [[nodiscard]] Interval range(const IntervalOrAuto& wanted, const Progress& progress);
  /// The pixels `part` of all views; the whole light field is not copied.
  [[nodiscard]] LiveViews full(const PixelRect& part, const Progress& progress);
  /// The same at 1/`factor` of the size: all facts but the range of disparities are those of the
  /// light field. Precondition: `part` begins at multiples of `factor`.
  [[nodiscard]] LiveViews coarse(const PixelRect& part, int factor, const Progress& progress);

 private:
  LiveViews views_;
  std::map<int, LiveViews> smaller_;  // the whole, by factor
  LiveViews part_;                    // the one cut out last,
  PixelRect cut_;                     // which is this
  std::optional<Interval> found_;     // whatever files promise
};

Interval LiveSource::range(const IntervalOrAuto& wanted, const Progress& progress) {
  if (range_source(*light_field(), wanted) != RangeSource::Found) {
    return search_range(*light_field(), wanted, progress);
  }
  if (!found_) found_ = search_range(*light_field(), wanted, progress);
  return *found_;
}

LiveViews LiveSource::full(const PixelRect& part, const Progress& progress) {
  if (part == whole(*light_field())) {
    part_ = {};
    return views_;
  }
  if (!part_.light_field || cut_ != part) {
    part_ = {std::make_shared<const LightField>(cropped(*light_field(), part, progress))};
    cut_ = part;
  }
  return part_;
}

LiveViews LiveSource::coarse(const PixelRect& part, int factor, const Progress& progress) {
  LiveViews& smaller = smaller_[factor];
  const LightFieldPtr& small = smaller.light_field;
  if (!small) {
    LightFieldInfo info = light_field()->info();
    info.disparity_range.reset();
    smaller.light_field = std::make_shared<const LightField>(
        smaller_views(*light_field(), factor, progress.part(0, 0.8), ReducedViews::All),
        std::move(info));
  }
  if (part == whole(*light_field())) return smaller;
  const auto ceiled = [factor](int n, int most) {
    return std::min((n + factor - 1) / factor, most);
  };
  const PixelRect inside{part.y0 / factor, part.x0 / factor, ceiled(part.y1, small->height()),
                         ceiled(part.x1, small->width())};
  return {std::make_shared<const LightField>(cropped(*small, inside, progress.part(0.8, 1)))};
}

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
  if (const ParameterValue* given = find_value(values, key)) return *given;
  return find_parameter(estimator, key)->default_value;
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

// The view comes from the parameter, else from the center or from all views.
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
LiveMap map_of(Estimate estimate, const LiveRun& run, const LightField& light_field) {
  for (auto& [key, value] : estimate.parameters) {
    if (key == kRange || key == kView) value = value_of(run.estimator, run.asked, key);
  }
  auto kept = std::make_shared<const Estimate>(std::move(estimate));
  LiveMap map;
  map.estimate = kept;
  map.part = run.part.wanted == whole(light_field) ? PixelRect{} : run.part.wanted;
  return map;
}

// Without the hash of the samples, which nobody asks a live map for.
Estimate run_on(const LiveViews& views, const Estimator& estimator, const EstimateRequest& request,
                const Progress& progress) {
  Estimate estimate =
      estimator.run(*views.light_field, *views.even, request.parameters, request.options, progress);
  progress.check();
  return estimate;
}

std::optional<LiveMap> coarse_map(LiveSource& source, const LiveRun& run, ViewIndex view,
                                  const Progress& progress) {
  const int factor = coarse_factor(run.estimator, *source.light_field());
  const LiveViews small = source.coarse(run.part.read, factor, progress.part(0, 0.3));
  if (std::min(small.light_field->height(), small.light_field->width()) < kLeastCoarse) return {};
  EstimateRequest request = run.request;
  set_value(request.parameters, kRange,
            IntervalOrAuto(Interval{run.range.min / factor, run.range.max / factor}));
  try {
    const Estimate found = run_on(small, run.estimator, request, progress.part(0.3, 1));
    LiveMap map = map_of(
        in_whole_views(found, run.part, factor, *source.light_field(), run.view.value_or(view)),
        run, *source.light_field());
    const Interval range = display_range(found);
    map.display_range = {factor * range.min, factor * range.max};
    map.is_coarse = true;
    return map;
  } catch (const InvalidInput&) {
    return {};  // what is wrong only at this size is right at the full one, which says the rest
  }
}

LiveMap full_map(LiveSource& source, const LiveRun& run, const Progress& progress) {
  const LiveViews views = source.full(run.part.read, progress.part(0, 0.05));
  Estimate found = run_on(views, run.estimator, run.request, progress.part(0.05, 1));
  const Interval range = display_range(found);
  const LightField& whole = *source.light_field();
  const bool is_whole = views.light_field == source.light_field();
  LiveMap map = map_of(is_whole ? std::move(found) : in_whole_views(found, run.part, 1, whole, {}),
                       run, whole);
  map.display_range = range;
  return map;
}

/// Estimates what is in sight in one view: a method with a parameter `view` that is auto is run for
/// it, one that estimates all views at once for all of them unless the view is the center; others
/// give the view that they are of. `on_coarse` gets a map of smaller views first, where
/// that leaves enough pixels and the method accepts it. On a GPU all pixels are estimated at once.
/// `source` is that of the request's light field. Throws what the method throws, Unavailable for an
/// unknown one.
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

bool holds(const PixelRect& outer, const PixelRect& inner) {
  if (outer.empty()) return true;
  return !inner.empty() && inner.y0 >= outer.y0 && inner.x0 >= outer.x0 && inner.y1 <= outer.y1 &&
         inner.x1 <= outer.x1;
}

}  // namespace
LiveEstimator::LiveEstimator(JobRunner::Post post, std::function<void()> on_changed)
    : post_(std::move(post)),
      on_changed_(std::move(on_changed)),
      alive_(std::make_shared<LiveEstimator*>(this)),
      runner_(post_) {}

LiveEstimator::~LiveEstimator() {
  *alive_ = nullptr;
}

bool LiveEstimator::is_answered(const LiveRequest& request) const {
  if (!asked_ || stage_ == LiveStage::Failed) return false;
  if (*asked_ == request) return true;
  return map_ && !map_->is_coarse && stage_ == LiveStage::Idle &&
         asked_->light_field == request.light_field && asked_->method == request.method &&
         asked_->parameters == request.parameters && holds(map_->part, request.in_sight) &&
         map_->estimate->contains(request.view);
}

void LiveEstimator::request(const LiveRequest& request) {
  if (is_answered(request)) return;
  drop();
  if (!asked_ || asked_->light_field != request.light_field) {
    LiveViews views{request.light_field};
    if (request.even) views.even = request.even;
    source_ = std::make_shared<LiveSource>(std::move(views));
    map_.reset();
  }
  asked_ = request;
  start(request);
}

void LiveEstimator::drop() {
  ++number_;
  runner_.cancel_all();
  stage_ = LiveStage::Idle;
  fraction_ = 0;
  sentence_.clear();
  coarse_seconds_.reset();
  full_seconds_.reset();
}

void LiveEstimator::clear() {
  drop();
  asked_.reset();
  map_.reset();
  source_.reset();
}

void LiveEstimator::start(const LiveRequest& request) {
  stage_ = LiveStage::Coarse;
  const auto is_current = [alive = alive_, number = number_] {
    return *alive && (*alive)->number_ == number;
  };
  const auto on_coarse = [this, is_current](LiveMap map) {
    post_([this, is_current, map = std::move(map)] {
      if (is_current()) take(map);
    });
  };
  runner_.start<LiveMap>(
      [source = source_, request, on_coarse](const Progress& progress) {
        lower_thread_priority();
        return estimate_live(*source, request, on_coarse, progress);
      },
      [this, is_current](Outcome<LiveMap> outcome) {
        if (is_current()) finish(std::move(outcome));
      },
      [this, is_current](const ProgressState& progress) {
        if (!is_current()) return;
        fraction_ = progress.fraction;
        on_changed_();
      });
}

void LiveEstimator::take(LiveMap map) {
  (map.is_coarse ? coarse_seconds_ : full_seconds_) = map.estimate->seconds;
  stage_ = map.is_coarse ? LiveStage::Full : LiveStage::Idle;
  map_ = std::move(map);
  on_changed_();
}

void LiveEstimator::finish(Outcome<LiveMap> outcome) {
  if (outcome.value) return take(std::move(*outcome.value));
  if (!outcome.failure) return;
  stage_ = LiveStage::Failed;
  sentence_ = failure_text(outcome.failure);
  map_.reset();
  on_changed_();
}

}  // namespace episcope
