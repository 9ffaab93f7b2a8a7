// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/builtin.h"

#include "engine/core/error.h"
#include "engine/core/parameter.h"
#include "engine/core/text.h"
#include "engine/scenes/caster.h"
#include "engine/scenes/random_scene.h"
#include "engine/scenes/recipes.h"
#include "engine/scenes/stratified_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>
#include <utility>

namespace episcope::scenes {
namespace {

// What is rendered: the cameras and what they see.
struct Laid {
  Stage stage;
  Model model;
  bool has_scribbles = false;
  const StratifiedRecipe* stratified = nullptr;
};

Laid lay_out(const std::string& id, const RenderOptions& options) {
  if (id == kRandomScene) {
    RandomScene scene = random_scene(options.width, options.height, options.seed, options.kind);
    return {scene.stage, std::move(scene.model), true};
  }
  const Stage stage = make_stage(options.width, options.height);
  if (const StratifiedRecipe* stratified = find_stratified(id)) {
    return {stage, stratified_model(*stratified, stage, options.seed), false, stratified};
  }
  const Recipe& recipe = *std::ranges::find(recipes(), id, &Recipe::id);
  return {stage, recipe.lay_out(stage), recipe.has_scribbles};
}

void require_range(const char* name, double value, double min, double max) {
  if (value >= min && value <= max) return;
  const auto text = [](double number) {
    std::string digits = to_text(number);
    return digits;
  };
  throw InvalidInput(std::string("cannot render a built-in scene with ") + name + " " +
                     text(value) + ": it must be from " + text(min) + " to " + text(max));
}

void check(const RenderOptions& options) {
  require_range("views in v", options.grid.v, 1, 101);
  require_range("views in u", options.grid.u, 1, 101);
  require_range("height", options.height, 8, 8192);
  require_range("width", options.width, 8, 8192);
  require_range("noise", options.noise_sigma, 0, 255);
  require_range("disparity scale", options.disparity_scale, 1e-3, 100);
  const auto positions = static_cast<int>(options.positions.size());
  if (positions != 0 && positions != options.grid.count()) {
    throw InvalidInput(fmt::format(
        "cannot render a built-in scene of {} views at {} positions: each view needs one",
        options.grid.count(), positions));
  }
  if (options.channels != 1 && options.channels != 3) {
    throw InvalidInput(fmt::format(
        "cannot render a built-in scene with {} channels: it must be 1 (grey) or 3 (RGB)",
        options.channels));
  }
}

}  // namespace

std::span<const Recipe> recipes() {
  static constexpr Recipe all[] = {
      {"demo", "a still life: vase with flowers, balls, box, cone and can on a table", demo_scene,
       true},
      {"fronto", "one plane of disparity 0.37 px", fronto_scene, false},
      {"slant", "a plane slanted from -1 px to 1 px", slant_scene, false},
      {"edge", "two planes, -0.5 px and 0.8 px, with a straight vertical edge", edge_scene, false},
      {"bars", "thin bars of 1, 2, 3 and 5 px in front of a plane", bars_scene, false},
      {"objects", "a sphere and a box on the ground, with labels and scribbles", objects_scene,
       true},
      {"transparent",
       "a semi-transparent pane in front of a plane, with ground truth for both layers",
       transparent_scene, false},
  };
  return all;
}

std::vector<BuiltinSceneInfo> builtin_scenes() {
  std::vector<BuiltinSceneInfo> scenes;
  for (const Recipe& recipe : recipes()) scenes.push_back({recipe.id, recipe.summary});
  for (const StratifiedRecipe& recipe : stratified_recipes()) {
    scenes.push_back({recipe.id, recipe.summary});
  }
  scenes.push_back({kRandomScene, "3 to 40 objects drawn from a seed: random?seed=7&kind=thin"});
  return scenes;
}

bool is_drawn(const std::string& id) {
  return id == kRandomScene || find_stratified(id) != nullptr;
}

void require_builtin(const std::string& id) {
  std::vector<std::string> ids;
  for (const BuiltinSceneInfo& scene : builtin_scenes()) ids.push_back(scene.id);
  if (std::ranges::find(ids, id) != ids.end()) return;
  throw Unavailable(no_such_name("built-in scene", id, ids) + " (there are " + joined(ids, ", ") +
                    ")");
}

std::string builtin_name(const std::string& id, const RenderOptions& options) {
  if (!is_drawn(id)) return id;
  if (options.kind == RandomKind::Any) return fmt::format("{}_{}", id, options.seed);
  return fmt::format("{}_{}_{}", id, random_kind_name(options.kind), options.seed);
}

std::string builtin_text(const std::string& id, const RenderOptions& options) {
  if (!is_drawn(id)) return id;
  const std::string text = fmt::format("{}?seed={}", id, options.seed);
  return options.kind == RandomKind::Any ? text : text + "&kind=" + random_kind_name(options.kind);
}

Scene render_builtin(const std::string& id, const RenderOptions& options,
                     const Progress& progress) {
  require_builtin(id);
  check(options);
  const Laid laid = lay_out(id, options);
  progress.step("rendering the scene " + id);
  Cast cast = cast_views(laid.stage, laid.model, options, progress);

  LightFieldInfo info;
  info.name = builtin_name(id, options);
  info.source = id == "demo" ? "demo" : "demo:" + builtin_text(id, options);
  info.reading.reader = kBuiltinReader;
  info.positions = options.positions;
  info.camera = camera_grid_of(laid.stage, options.disparity_scale);
  Scene scene;
  scene.light_field = std::make_shared<const LightField>(std::move(cast.samples), std::move(info));
  if (laid.has_scribbles) {
    const ViewIndex center = options.grid.center();
    scene.scribbles.views.push_back({center, scribble(cast.truth.labels.view(center))});
  }
  if (laid.stratified) {
    add_regions(*laid.stratified, laid.stage, options.grid.center(), cast.truth);
  }
  scene.truth = std::make_shared<const GroundTruth>(std::move(cast.truth));
  scene.convention.format = "built-in scene";
  scene.convention.order = "canonical order";
  scene.convention.order_check = "exact by construction";
  scene.convention.sign = "checked";
  scene.convention.sign_check = "exact by construction";
  scene.convention.units = "exact disparity by eq. 1";
  return scene;
}

namespace {

constexpr const char* kKeys =
    "seed=N, kind=NAME, size=256 or 320x240, grid=9x9, noise=SIGMA, channels=3 or 1";

[[noreturn]] void refuse(const std::string& text, const std::string& reason) {
  throw InvalidInput(fmt::format("cannot read the built-in scene '{}': {}", text, reason));
}

// A whole text as a number that is not negative.
template <class T>
bool read_number(std::string_view text, T& number) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end && number >= 0;
}

// "256x192"; one number alone stands for both.
bool read_pair(std::string_view text, int& first, int& second) {
  const auto cross = text.find('x');
  if (cross == text.npos) {
    if (!read_number(text, first)) return false;
    second = first;
    return true;
  }
  return read_number(text.substr(0, cross), first) && read_number(text.substr(cross + 1), second);
}

bool read_value(const std::string& key, const std::string& value, RenderOptions& options) {
  if (key == "seed") return read_number(value, options.seed);
  if (key == "noise") return read_number(value, options.noise_sigma);
  if (key == "channels") return read_number(value, options.channels);
  if (key == "size") return read_pair(value, options.width, options.height);
  return read_pair(value, options.grid.v, options.grid.u);
}

void read_kind(const std::string& text, const BuiltinRequest& request, const std::string& value,
               RenderOptions& options) {
  if (request.scene != kRandomScene) {
    refuse(text, fmt::format("only the scene '{}' has a kind", kRandomScene));
  }
  const auto kind = random_kind_of(value);
  if (!kind) {
    const std::vector<std::string>& names = random_kind_names();
    refuse(text, no_such_name("kind", value, names) + " (there are " + joined(names, ", ") + ")");
  }
  options.kind = *kind;
}

void read_option(const std::string& text, const std::string& option, BuiltinRequest& request) {
  const auto equals = option.find('=');
  const std::string key = option.substr(0, equals);
  const std::string value = equals == option.npos ? std::string() : option.substr(equals + 1);
  if (key == "kind") return read_kind(text, request, value, request.options);
  const std::vector<std::string> keys = {"seed", "size", "grid", "noise", "channels"};
  if (std::ranges::find(keys, key) == keys.end()) {
    refuse(text,
           fmt::format("'{}' is not known; after '?' write these, joined by '&': {}", key, kKeys));
  }
  if (!read_value(key, value, request.options)) {
    refuse(text, fmt::format("'{}' is no {}; write {}", value, key, kKeys));
  }
}

}  // namespace

void read_options(const std::string& text, BuiltinRequest& request) {
  const auto question = text.find('?');
  if (question == text.npos) return;
  std::string rest = text.substr(question + 1);
  while (true) {
    const auto end = rest.find('&');
    read_option(text, rest.substr(0, end), request);
    if (end == rest.npos) return;
    rest.erase(0, end + 1);
  }
}

BuiltinRequest read_request(const std::string& text) {
  BuiltinRequest request;
  request.scene = text.substr(0, text.find('?'));
  require_builtin(request.scene);
  read_options(text, request);
  return request;
}

}  // namespace episcope::scenes
