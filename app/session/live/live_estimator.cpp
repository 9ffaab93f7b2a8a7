// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/live/live_estimator.h"

#include "app/session/run/failure_text.h"
#include "app/session/run/thread_priority.h"

#include <utility>

namespace episcope {
namespace {

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
    source_ = std::make_shared<LiveSource>(request.light_field);
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
  (map.is_coarse ? coarse_seconds_ : full_seconds_) = map.seconds;
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
