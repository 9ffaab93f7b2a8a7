// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/scene.h"
#include "engine/evaluation/metrics/metrics.h"

#include <memory>
#include <optional>

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

}  // namespace episcope
