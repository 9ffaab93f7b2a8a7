// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"
#include "engine/disparity/common/run_options.h"
#include "engine/disparity/plane/even_views.h"
#include "engine/disparity/plane/plane_parameters.h"
#include "engine/disparity/stereo/stereo_costs.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// Disparity and confidence of one view.
struct MapOfView {
  ImageView<const float> disparity, confidence;
};

/// A light field as its views are compared, without differences in brightness, and the data term of
/// one view. Refers to light field and parameters. Members throw DeviceFailure, Cancelled.
class EvenedViews {
 public:
  EvenedViews(const LightField& light_field, const PlaneParameters& parameters, Device device);

  /// The evened one, or the given one if its views are alike.
  [[nodiscard]] const LightField& light_field() const { return even_ ? *even_ : lf_; }
  [[nodiscard]] StereoCosts& stereo() { return stereo_; }

  /// By the means of the views, as nothing is known of disparities, and prepares the data term.
  void begin(const Progress& progress);
  /// By what the sure part of a map tells, and prepares it anew.
  void improve(const MapOfView& map, const Progress& progress);
  /// About what was evened, for the notes of an estimate; may be empty.
  [[nodiscard]] const std::string& note() const { return note_; }

  /// What was evened, in numbers of which there is one at least, and the same light field again,
  /// without a data term.
  [[nodiscard]] std::vector<double> evened() const;
  void restore(const std::vector<double>& evened, const Progress& progress);

 private:
  void use(const Brightness& brightness, const Progress& progress);
  void prepare(const StereoCostParameters& matching, const Progress& progress);

  const LightField& lf_;
  const PlaneParameters& parameters_;
  Device device_;
  Brightness brightness_;
  std::optional<LightField> even_;
  StereoCosts stereo_;
  std::string note_;
};

}  // namespace episcope
