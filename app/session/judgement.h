// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/scene.h"
#include "engine/evaluation/metrics/metrics.h"

#include <optional>
#include <string>

namespace episcope {

/// The error of a result in one view. Of a result in two layers against a truth in two layers, keys
/// are those of `layered_metrics`, and the maps are those of the foreground.
struct Judgement {
  ViewIndex view;
  Evaluation evaluation;
};

/// Judges `view`; if it is empty, the centre view or the one that the truth covers. Region masks
/// count in the centre view only. Throws InvalidInput if scene or result lacks what is compared.
[[nodiscard]] Judgement judge(const Estimate& estimate, const Scene& scene,
                              EvaluationOptions options, std::optional<ViewIndex> view = {});

}  // namespace episcope
