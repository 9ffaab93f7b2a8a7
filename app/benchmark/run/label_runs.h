// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/benchmark/run/record.h"
#include "app/session/labels/labeling_inputs.h"
#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"
#include "engine/labeling/labeler_parameters.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace episcope {

/// The name of a way to label: "image+estimate-rayspace".
[[nodiscard]] std::string label_entry(const LabelerParameters& parameters);

/// Labels of all views with these parameters.
[[nodiscard]] BenchmarkRun plan_label_run(const LabelerParameters& parameters);

/// Changes with what labels and their scores depend on besides `scene_fingerprint`: the strokes,
/// and true labels and disparity of all views.
[[nodiscard]] std::string label_fingerprint(const Scene& scene);

/// Labels the views of one scene from its strokes, in several ways; borrows the scene. The
/// disparity that they share is estimated once, when it is first needed.
class LabelRuns {
 public:
  LabelRuns(const Scene& scene, std::string name);

  /// Labels all views, judges them, and writes pictures of the labels of the centre view and of
  /// what is wrong below `folder`; score, seconds without the disparity, and files go into the
  /// record. Throws InvalidInput without strokes or what the features need, IoError, Cancelled.
  void run(const LabelerParameters& parameters, const std::filesystem::path& folder,
           const Progress& progress, BenchmarkRecord& record);

 private:
  [[nodiscard]] const LabelingDisparity& disparity_for(const LabelerParameters& parameters,
                                                       const Progress& progress);

  const Scene& scene_;
  std::string name_;
  std::optional<LabelingDisparity> estimate_, truth_;
};

}  // namespace episcope
