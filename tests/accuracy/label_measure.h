// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/labeling_inputs.h"
#include "engine/core/scene.h"
#include "engine/evaluation/label_quality.h"
#include "engine/labeling/labeler.h"
#include "tests/accuracy/strokes.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope::accuracy {

/// A scene with the strokes of a simulated user, and the true labels of what was painted: nobody
/// can expect others to be found, so they are 0.
struct PaintedScene {
  std::string name;
  Scene scene;
  Scribbles strokes;
  ViewStack<std::int32_t> truth;
};

/// A name for files of a scene: all but letters, digits and "-" become "_".
[[nodiscard]] std::string file_stem(std::string scene);

/// Strokes on the center view; StrokeStyle::Stored takes those of the scene.
[[nodiscard]] PaintedScene paint_scene(const std::string& name, StrokeStyle style, Scene scene);

/// How well labels came out, and how long they took.
struct MeasuredLabels {
  LabelQuality quality;
  std::optional<double> consistency;  ///< Share of rays along which labels agree; of all views.
  double seconds = 0;
};

/// Labels all views, or the center view alone, which has no consistency.
[[nodiscard]] MeasuredLabels measure_labels(const PaintedScene& painted,
                                            const LabelerParameters& parameters,
                                            const LabelingDisparity& disparity, bool center_only);

/// Where disparity for labels comes from.
struct DisparitySource {
  std::string method = kLabelingEstimator;
  std::filesystem::path kept;  ///< Folder where estimates are kept and found again; empty = none.
};

/// The truth for FeatureSet::ImageTruth, else an estimate of all views by the source's method.
/// Throws as find_labeling_disparity.
[[nodiscard]] LabelingDisparity disparity_for(const PaintedScene& painted, FeatureSet features,
                                              const DisparitySource& source);

}  // namespace episcope::accuracy
