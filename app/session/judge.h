// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/indices.h"
#include "engine/core/jobs.h"
#include "engine/core/scene.h"
#include "engine/evaluation/metrics.h"

#include <nlohmann/json_fwd.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

using EvaluationPtr = std::shared_ptr<const Evaluation>;

/// "the result has 1×1 views from view 4,4 on, but view 0,0 was asked for": why a view cannot be
/// shown, as a sentence without its full stop; `what` names what there is none of if nothing is
/// covered. Empty if it is covered.
[[nodiscard]] std::string reason_against_view(const ViewRectangle& covered, ViewIndex view,
                                              const std::string& who, const std::string& what);
/// Which views a stack has.
template <class T>
[[nodiscard]] ViewRectangle coverage_of(const ViewStack<T>& stack) {
  return {stack.first(), stack.grid()};
}

/// The view in which a result is judged if nobody asks for another: the center, or the first that
/// the truth covers where that is not the center. The center if there is no truth.
[[nodiscard]] ViewIndex judged_view(const Scene& scene);

/// The view in which a result is judged: the one that is wanted, else the only one of a result of
/// ours, else `judged_view`.
[[nodiscard]] ViewIndex view_to_judge(const Estimate& estimate, const Scene& scene,
                                      std::optional<ViewIndex> wanted);

/// Moves a single map of another program, which tells no view, to the view that is judged.
void place_foreign_map(ViewIndex view, Estimate& estimate);

/// Whether scene and result have what `judge` compares in this view.
[[nodiscard]] bool can_judge(const Estimate& estimate, const Scene& scene, ViewIndex view);

/// A sentence for truth that was estimated; else empty.
[[nodiscard]] std::string estimated_truth_note(const Scene& scene);

/// The error of a result in one view, `judged_view` if none is given. If result and truth have two
/// layers, keys are as in `layered_metrics` and maps show the foreground. Leaves out pixels that
/// the light field does not show (LightField::valid), the border that maps of other programs lack
/// (Provenance::border_px), and zeros of `options.shown`, unless it is empty. Region masks and the
/// high resolution count in the center view only; camera and truth come from the scene, not from
/// `options`. Protocol benchmark2016 gains runtime_log, log10 of the seconds, where they are known.
/// Throws InvalidInput if scene or result lacks what is compared; Cancelled.
[[nodiscard]] Evaluation judge(const Estimate& estimate, const Scene& scene,
                               EvaluationOptions options, std::optional<ViewIndex> view = {});

/// Names an evaluation: estimate, view and protocol.
struct EvaluationKey {
  int estimate = 0;
  ViewIndex view;
  Protocol protocol = Protocol::Vmv2013;
  friend bool operator==(const EvaluationKey&, const EvaluationKey&) = default;
};

/// Judges estimates in the background and keeps the newest evaluations, a few of each estimate in
/// any case. For the owner's thread only.
class EvaluationCache {
 public:
  /// `on_evaluated` is called on the owner's thread when an evaluation that was begun is there
  /// or failed.
  EvaluationCache(const JobRunner::Post& post, std::function<void()> on_evaluated);

  /// The evaluation if it is there; else null, and a job is begun unless one runs or failed before,
  /// or the estimate cannot be judged (`can_judge`). Judges the pixels of `part`; empty = all.
  [[nodiscard]] EvaluationPtr find_or_begin(const EvaluationKey& key, const EstimatePtr& estimate,
                                            const std::shared_ptr<const Scene>& scene,
                                            const PixelRect& part = {});

  /// Forgets all evaluations of an estimate and cancels their jobs.
  void forget(int estimate);
  /// Number of jobs whose end was not reported yet; the computation itself may be over.
  [[nodiscard]] int pending() const { return pending_; }

 private:
  struct Entry {
    EvaluationKey key;
    EvaluationPtr evaluation{};  ///< Null while its job runs, and if it failed.
    bool is_under_way = true;
    JobId job = 0;
  };
  [[nodiscard]] std::list<Entry>::iterator find(const EvaluationKey& key);
  void finish(const EvaluationKey& key, Outcome<EvaluationPtr> outcome);
  void trim();

  std::function<void()> on_evaluated_;
  std::list<Entry> entries_;  // the newest used comes first
  int pending_ = 0;
  JobRunner runner_;
};

/// Which pixels of the judged view metrics cover.
enum class JudgedPixels : std::uint8_t {
  Whole,
  Rectangle,
  Label,   ///< The current one.
  Common,  ///< Where all results have values.
  Mask,    ///< Of a file.
  Region   ///< A region mask of the ground truth.
};

/// Which pixels are judged, and what it takes to find them.
struct JudgedPart {
  JudgedPixels pixels = JudgedPixels::Whole;
  PixelRect rectangle{};  ///< Stays while others are chosen; empty = none was drawn.
  std::string mask{};     ///< Path of an image; stays as well; empty = none was chosen.
  std::string region{};   ///< Name of a region mask; stays as well; empty = none was chosen.
  friend bool operator==(const JudgedPart&, const JudgedPart&) = default;
};

/// The part of a rectangle inside an image of this size; may be empty.
[[nodiscard]] inline PixelRect clipped(const PixelRect& rectangle, int height, int width) {
  return {std::max(rectangle.y0, 0), std::max(rectangle.x0, 0), std::min(rectangle.y1, height),
          std::min(rectangle.x1, width)};
}

/// Object of metrics by key, in their order; NaN becomes null when it is written.
[[nodiscard]] nlohmann::ordered_json metrics_json(const Metrics& metrics);
/// Reads what `metrics_json` made; what is no number is left out.
[[nodiscard]] Metrics metrics_from(const nlohmann::ordered_json& object);

/// Scores of a result. If result or truth lack what is compared, `problem` says so: nothing is
/// thrown.
struct ResultScores {
  EvaluationPtr evaluation;  ///< By vmv2013; null if there is none.
  Metrics vmv2013;           ///< Empty without an evaluation.
  Metrics benchmark2016;     ///< Empty also for views smaller than two borders of 15 px.
  std::vector<std::string> notes;
  std::string problem;  ///< Why there is no evaluation, a sentence; empty = there is one.
};

/// Judges by vmv2013 alone. Throws Cancelled.
[[nodiscard]] ResultScores judge_by_errors(const Estimate& estimate, const Scene& scene,
                                           const Progress& progress);
/// Judges by both protocols. Throws Cancelled.
[[nodiscard]] ResultScores judge_by_both(const Estimate& estimate, const Scene& scene,
                                         const Progress& progress);

}  // namespace episcope
