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

/// Teeth that taper to the right from a strip at the left, before a wall; both slant so that the
/// step between them grows downwards, up to 0.9 … 1.5 px. Half of the seeds have noise that grows
/// downwards. Masks between the strip and the last tip: `foreground_fattening`, the gaps, and
/// `foreground_thinning`, the teeth.
[[nodiscard]] Model backgammon_model(const Stage& stage, Draw draw);
[[nodiscard]] Regions backgammon_regions(const Stage& stage, CenterLabels labels);

/// 4×4 boxes, each with a dot of every size from 1 (a quarter of the box) to 8 (a twentieth),
/// 0.6 … 1.5 px before a wall, under noise that grows from nothing at the top to 4 … 12/255 at the
/// bottom. Masks: `dots_by_size` and `boxes`, both numbered, and `background`.
[[nodiscard]] Model dots_model(const Stage& stage, Draw draw);
[[nodiscard]] Regions dots_regions(const Stage& stage, CenterLabels labels);

/// Upright bars, dark and bright in turn, that widen to the right, 0.3 … 1.5 px before a bright
/// wall; in four bands from the top the texture loses its contrast. Half of the seeds have noise
/// that grows downwards. Masks: `low_texture`, the wall in the lower two bands, `high_contrast`,
/// the dark bars, and `low_contrast`, the bright ones.
[[nodiscard]] Model stripes_model(const Stage& stage, Draw draw);
[[nodiscard]] Regions stripes_regions(const Stage& stage, CenterLabels labels);

/// Seven pyramids, a ball and a bowl before a wall that faces the cameras. Masks: `pyramids`,
/// `sphere_out` (the ball), `sphere_in` (the bowl) and `plane` (the wall).
[[nodiscard]] Model pyramids_model(const Stage& stage, Draw draw);
[[nodiscard]] Regions pyramids_regions(const Stage& stage, CenterLabels labels);

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
