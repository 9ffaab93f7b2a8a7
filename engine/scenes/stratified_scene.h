// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/scene.h"
#include "engine/scenes/stage.h"

#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace episcope::scenes {

/// Region masks by name, as GroundTruth::regions.
using Regions = std::map<std::string, Image<std::uint8_t>>;

/// Object labels of the center view.
using CenterLabels = ImageView<const std::int32_t>;

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

/// The scene of this seed, laid out for the cameras of a stage.
[[nodiscard]] Model stratified_model(const StratifiedRecipe& recipe, const Stage& stage,
                                     unsigned seed);

/// Says in the truth of a rendering which scene it is, and adds its masks.
void add_regions(const StratifiedRecipe& recipe, const Stage& stage, ViewIndex center,
                 GroundTruth& truth);

}  // namespace episcope::scenes
