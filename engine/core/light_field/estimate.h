// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/disparity_field.h"
#include "engine/core/light_field/layered_disparity.h"
#include "engine/core/light_field/reading.h"
#include "engine/core/parameter/parameter.h"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace episcope {

/// Where an estimate comes from: everything needed to reproduce it.
struct Provenance {
  std::string method;             ///< Id as in `episcope-cli methods`; of foreign results any name.
  ParameterSet parameters;        ///< Every parameter of the method with the value used.
  Interval range{};               ///< Disparity range searched, px per view step; {0, 0} = unknown.
  double seconds = 0;             ///< Wall-clock time; 0 = unknown.
  std::string version;            ///< Of Episcope.
  std::string source;             ///< Path or name of the light field.
  std::uint64_t source_hash = 0;  ///< LightField::sample_hash, 0 = unknown.
  Reading reading{};              ///< How that light field was read.
  std::vector<std::string> notes;  ///< What a user should know of this run: gap, unsolved views.
  int border_px = 0;  ///< Pixels at each side of the views that foreign maps lack; not judged.
};

/// A disparity estimate. Covers all views or one.
struct Estimate : Provenance {
  DisparityField field;
  ViewStack<float> confidence;  ///< In [0, 1], shape of `field.disparity`; empty = unknown.
  LayeredDisparity layered;     ///< Empty unless the method estimates two layers.

  [[nodiscard]] const Provenance& provenance() const { return *this; }
  void set_provenance(Provenance provenance) {
    static_cast<Provenance&>(*this) = std::move(provenance);
  }
  [[nodiscard]] bool contains(ViewIndex view) const { return field.contains(view); }
};

using EstimatePtr = std::shared_ptr<const Estimate>;

}  // namespace episcope
