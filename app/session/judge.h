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

/// The view in which a result is judged if nobody asks for another: the centre, or the first that
/// the truth covers where that is not the centre. The centre if there is no truth.
[[nodiscard]] ViewIndex judged_view(const Scene& scene);

/// Whether scene and result have what `judge` compares in this view.
[[nodiscard]] bool can_judge(const Estimate& estimate, const Scene& scene, ViewIndex view);

/// The error of a result in one view, `judged_view` if none is given. Of a result in two layers
/// against a truth in two layers, keys are those of `layered_metrics`, and the maps are those of
/// the foreground. Pixels that the light field does not show (LightField::valid), or that maps
/// of other programs do not cover (Provenance::border_px), are not judged; nor what is 0 in
/// `options.shown`, unless that is empty. Region masks and the high resolution count in the centre
/// view only; camera and truth are those of the scene, whatever `options` say. Protocol
/// benchmark2016 gains runtime_log, log10 of the seconds, where they are known. Throws InvalidInput
/// if scene or result lacks what is compared; Cancelled.
[[nodiscard]] Evaluation judge(const Estimate& estimate, const Scene& scene,
                               EvaluationOptions options, std::optional<ViewIndex> view = {});

/// Which evaluation: of what estimate, seen from where, judged how.
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

  /// The evaluation if it is there; else null, and it is begun unless it is under way, failed
  /// before, or cannot be judged (`can_judge`). Only the pixels of `part` are judged; empty = all.
  [[nodiscard]] EvaluationPtr find_or_begin(const EvaluationKey& key, const EstimatePtr& estimate,
                                            const std::shared_ptr<const Scene>& scene,
                                            const PixelRect& part = {});

  /// Forgets all evaluations of an estimate; cancels those that are under way.
  void forget(int estimate);
  /// Evaluations begun whose end was not told yet: the computation may be over.
  [[nodiscard]] int pending() const { return pending_; }

 private:
  struct Entry {
    EvaluationKey key;
    EvaluationPtr evaluation{};  ///< Null: under way or failed.
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

/// Which pixels of the judged view metrics are of.
enum class JudgedPixels : std::uint8_t {
  Whole,
  Rectangle,
  Label,   ///< The current one.
  Common,  ///< Where all results have values.
  Mask     ///< Of a file.
};

/// The same with what it takes to find them.
struct JudgedPart {
  JudgedPixels pixels = JudgedPixels::Whole;
  PixelRect rectangle{};  ///< Stays while others are chosen; empty = none was drawn.
  std::string mask{};     ///< Path of an image; stays as well; empty = none was chosen.
  friend bool operator==(const JudgedPart&, const JudgedPart&) = default;
};

/// What of a rectangle lies in an image of this size; may be empty.
[[nodiscard]] inline PixelRect clipped(const PixelRect& rectangle, int height, int width) {
  return {std::max(rectangle.y0, 0), std::max(rectangle.x0, 0), std::min(rectangle.y1, height),
          std::min(rectangle.x1, width)};
}

/// Object of metrics by key, in their order; NaN becomes null when it is written.
[[nodiscard]] nlohmann::ordered_json metrics_json(const Metrics& metrics);
/// Reads what `metrics_json` made; what is no number is left out.
[[nodiscard]] Metrics metrics_from(const nlohmann::ordered_json& object);

/// The numbers of a result; what there is not to judge, or to judge against, is said, not thrown.
struct Verdict {
  EvaluationPtr evaluation;  ///< By vmv2013; null if there is none.
  Metrics vmv2013;           ///< Empty without an evaluation.
  Metrics benchmark2016;     ///< Likewise; also of views smaller than two borders of 15 px.
  std::vector<std::string> notes;
  std::string problem;  ///< Why there is no evaluation, a sentence; empty = there is one.
};

/// Judges by vmv2013 alone. Throws Cancelled.
[[nodiscard]] Verdict judge_by_errors(const Estimate& estimate, const Scene& scene,
                                      const Progress& progress);
/// Judges by both protocols. Throws Cancelled.
[[nodiscard]] Verdict judge_by_both(const Estimate& estimate, const Scene& scene,
                                    const Progress& progress);

}  // namespace episcope
