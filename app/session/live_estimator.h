// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/run_estimator.h"
#include "engine/core/estimate.h"
#include "engine/core/indices.h"
#include "engine/core/jobs.h"
#include "engine/core/light_field.h"
#include "engine/core/parameter.h"
#include "engine/core/progress.h"
#include "engine/core/view_gain.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace episcope {

class LiveSource;

/// What is looked at while parameters are tried: an immutable snapshot.
struct LiveRequest {
  LightFieldPtr light_field;
  std::string method;
  ParameterSet parameters;
  ViewIndex view;
  PixelRect in_sight{};                       ///< Of the view; empty = all of it.
  std::shared_ptr<EvenViews> even = nullptr;  ///< Of the scene; null: a new one.
  friend bool operator==(const LiveRequest&, const LiveRequest&) = default;
};

/// Answer to a LiveRequest.
struct LiveMap {
  EstimatePtr estimate;      ///< Of the view of the request, or of all; parameters as asked for.
  Interval display_range{};  ///< Disparities that most pixels lie in.
  PixelRect part{};          ///< The pixels estimated; empty = all.
  bool is_coarse = false;    ///< Made from views of a quarter of the size, an eighth for a network.
  double seconds = 0;        ///< Wall-clock time since the request was taken up.
};

/// State of a live estimate.
enum class LiveStage : std::uint8_t {
  Idle,    ///< What was asked for is there, or nothing was.
  Coarse,  ///< The map of smaller views is on its way,
  Full,    ///< and the one in full.
  Failed   ///< `sentence` says why.
};

/// Estimates in the background what is looked at. Only the newest request matters: it cancels the
/// one before within 200 ms, and the last map stays until a newer one is there. Works on a thread
/// of its own, of lower priority than the owner's. All members are for the owner's thread.
class LiveEstimator {
 public:
  /// `post` brings closures to the owner's thread; `on_changed` is called there after each change
  /// of stage, progress or map that no call of the owner made.
  LiveEstimator(JobRunner::Post post, std::function<void()> on_changed);
  ~LiveEstimator();
  LiveEstimator(const LiveEstimator&) = delete;
  LiveEstimator& operator=(const LiveEstimator&) = delete;

  /// Starts an estimate and cancels the running one. Ignored if the last request was equal and did
  /// not fail, or if the present map answers it: same parameters, view and pixels in sight covered.
  void request(const LiveRequest& request);
  /// Cancels the running estimate and forgets everything.
  void clear();

  [[nodiscard]] LiveStage stage() const { return stage_; }
  [[nodiscard]] bool is_running() const {
    return stage_ == LiveStage::Coarse || stage_ == LiveStage::Full;
  }
  /// Progress of the running estimate, in [0, 1].
  [[nodiscard]] double fraction() const { return fraction_; }
  /// Why it failed, in state Failed.
  [[nodiscard]] const std::string& sentence() const { return sentence_; }
  /// The newest map of this light field, maybe of a former request; none if there is none yet.
  [[nodiscard]] const std::optional<LiveMap>& map() const { return map_; }
  /// How long the method took for the coarse map of the newest request, and for the full one; none
  /// = it is not there.
  [[nodiscard]] std::optional<double> coarse_seconds() const { return coarse_seconds_; }
  [[nodiscard]] std::optional<double> full_seconds() const { return full_seconds_; }

 private:
  [[nodiscard]] bool is_answered(const LiveRequest& request) const;
  void start(const LiveRequest& request);
  void drop();
  void take(LiveMap map);
  void finish(Outcome<LiveMap> outcome);

  JobRunner::Post post_;
  std::function<void()> on_changed_;
  std::shared_ptr<LiveSource> source_;  // used by one job at a time
  std::optional<LiveRequest> asked_;
  std::optional<LiveMap> map_;
  LiveStage stage_ = LiveStage::Idle;
  double fraction_ = 0;
  std::string sentence_;
  std::optional<double> coarse_seconds_;
  std::optional<double> full_seconds_;
  std::uint64_t number_ = 0;
  std::shared_ptr<LiveEstimator*> alive_;  // posted closures outlive this harmlessly
  JobRunner runner_;
};

}  // namespace episcope
