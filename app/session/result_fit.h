// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/judge.h"
#include "engine/core/estimate.h"
#include "engine/core/light_field.h"
#include "engine/core/scene.h"
#include "engine/io/models/better_reading.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// Throws InvalidInput, naming `file`, if the maps of a result have not the size of the views, or
/// are of several but not of all of them.
void check_fits(const Estimate& estimate, const LightField& light_field, const std::string& file);
/// The same of labels.
void check_fits(const ViewStack<std::int32_t>& labels, const LightField& light_field,
                const std::string& file);

/// "the map has 5×5 views, but cotton has 9×9": why two maps cannot be compared, as a sentence that
/// begins with `who` and has no full stop; empty if both have one size and grid, or one of
/// them a single view. An empty one fits all.
[[nodiscard]] std::string reason_against_fit(const std::string& who, const MapGeometry& maps,
                                             const std::string& other_name,
                                             const MapGeometry& other);

/// Views of a light field as maps would cover them.
[[nodiscard]] inline MapGeometry geometry_of(const LightField& light_field) {
  return {light_field.grid(), {}, light_field.height(), light_field.width()};
}

/// Whether a result says that it was estimated from samples of another light field. Reads all
/// samples.
[[nodiscard]] bool is_of_other_samples(const Estimate& estimate, const LightField& light_field);

/// Options by which the light field of a result was read otherwise than this one, as on the command
/// line ("--flip=u"), the focus plane left aside; empty if there are none, or that is not known.
[[nodiscard]] std::string differing_options(const Estimate& estimate,
                                            const LightField& light_field);

/// Options of `reading`, the focus plane left aside, that `other` was not read with, as on the
/// command line: " --flip=u".
[[nodiscard]] std::string options_missing_in(const Reading& other, const Reading& reading);

/// Looks for a reading by which truth and views explain a result far better
/// (io::find_better_reading), in the view that is judged or the only one. Without truth, results of
/// this program are not looked at. Empty if there is none, or the result does not fit.
[[nodiscard]] std::optional<io::BetterReading> find_better_reading(const Estimate& estimate,
                                                                   const Scene& scene);

/// Says so with both numbers: "the map fits the ground truth far better with rows and columns
/// exchanged (…)", and whether the views contradict it.
[[nodiscard]] std::string better_reading_finding(const io::BetterReading& found);

/// The same with the options that apply it: "…; if it is stored so, add --map-transpose".
[[nodiscard]] std::string better_reading_text(const io::BetterReading& found);

/// Whether a map of another program is the ground truth itself, number for number.
[[nodiscard]] bool is_ground_truth(const Estimate& estimate, const Scene& scene);

/// What speaks against a result that no other reading explains better, with both numbers: that its
/// maps fit the truth of other views, or but for a constant, far better, or explain little of it
/// (io::find_poor_fit); else empty. Results that were estimated from the samples of the light field
/// are not doubted. `is_of_others`: is_of_other_samples.
[[nodiscard]] std::string doubt_text(const Estimate& estimate, const Scene& scene,
                                     bool is_of_others);

/// What a user must know of a result in the place of a light field.
struct ResultFit {
  std::optional<io::BetterReading> better;
  /// How maps of another program were read, that the samples are others, and `doubt_text`.
  std::vector<std::string> notes;

  /// All of it, a sentence each.
  [[nodiscard]] std::vector<std::string> sentences() const;
};
/// Precondition: the result fits (check_fits).
[[nodiscard]] ResultFit fit_of(const Estimate& estimate, const Scene& scene);

/// The warnings of a scene that tell of the truth by which results are judged.
[[nodiscard]] std::vector<std::string> truth_warnings(const ConventionReport& report);

/// A result judged in one view.
struct JudgedResult {
  EvaluationPtr evaluation;
  ViewIndex view;
  std::optional<io::BetterReading> better;
  std::vector<std::string> notes;  ///< How it fits (fit_of), then of the evaluation.
};
/// Judges (`judge`) a result that fits. Throws likewise.
[[nodiscard]] JudgedResult judge_result(const Estimate& estimate, const Scene& scene,
                                        const EvaluationOptions& options, ViewIndex view);
/// What programs are told of it: method, view, units of the truth, `metrics`, seconds, another
/// reading that would fit better, and notes, those on the truth among them. What is not known has
/// no key.
[[nodiscard]] nlohmann::ordered_json judged_json(const Estimate& estimate, const Scene& scene,
                                                 const JudgedResult& judged, Protocol protocol,
                                                 const Metrics& metrics);

}  // namespace episcope
