// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/stratified/stratified_scene.h"

#include <algorithm>
#include <string_view>

namespace episcope::scenes {

std::span<const StratifiedRecipe> stratified_recipes() {
  static constexpr StratifiedRecipe all[] = {
      {"backgammon", "teeth before a wall, from a small step at the top to a large one",
       StratifiedScene::Backgammon, backgammon_model, backgammon_regions},
      {"dots", "dots of eight sizes before a wall, under noise that grows downwards",
       StratifiedScene::Dots, dots_model, dots_regions},
      {"stripes", "dark and bright bars before a wall, with less and less texture downwards",
       StratifiedScene::Stripes, stripes_model, stripes_regions},
      {"pyramids", "pyramids, a ball and a bowl on a wall", StratifiedScene::Pyramids,
       pyramids_model, pyramids_regions},
  };
  return all;
}

const StratifiedRecipe* find_stratified(const std::string& id) {
  const auto all = stratified_recipes();
  const auto found = std::ranges::find(all, std::string_view(id), &StratifiedRecipe::id);
  return found == all.end() ? nullptr : &*found;
}

Model stratified_model(const StratifiedRecipe& recipe, const Stage& stage, unsigned seed) {
  const Draw draw(seed);
  return recipe.lay_out(stage, draw.part(static_cast<std::uint64_t>(recipe.kind)));
}

void add_regions(const StratifiedRecipe& recipe, const Stage& stage, ViewIndex center,
                 GroundTruth& truth) {
  truth.stratified = recipe.kind;
  truth.regions.merge(recipe.regions(stage, truth.labels.view(center)));
}

}  // namespace episcope::scenes
