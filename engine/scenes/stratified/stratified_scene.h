// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/ground_truth.h"
#include "engine/scenes/stratified/layouts.h"

#include <span>

namespace episcope::scenes {

/// A scene that isolates one difficulty, in the manner of the stratified scenes of the 2016
/// benchmark [HJKG16], with the masks of its metrics. Texture, steps and noise are drawn from a
/// seed.
struct StratifiedRecipe {
  const char* id;
  const char* summary;
  StratifiedScene kind;
  Model (*lay_out)(const Stage& stage, Draw draw);
  Regions (*regions)(const Stage& stage, CenterLabels labels);
};

[[nodiscard]] std::span<const StratifiedRecipe> stratified_recipes();

/// Null if there is none of this id.
[[nodiscard]] const StratifiedRecipe* find_stratified(const std::string& id);

/// What the cameras of a stage see of the scene of this seed.
[[nodiscard]] Model stratified_model(const StratifiedRecipe& recipe, const Stage& stage,
                                     unsigned seed);

/// Says in the truth of a rendering which scene it is, and adds its masks.
void add_regions(const StratifiedRecipe& recipe, const Stage& stage, ViewIndex center,
                 GroundTruth& truth);

}  // namespace episcope::scenes
