// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/builtin.h"

#include "engine/core/error.h"
#include "engine/core/isa.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"
#include "engine/core/parameter.h"
#include "engine/core/text.h"
#include "engine/scenes/random_scene.h"
#include "engine/scenes/recipes.h"
#include "engine/scenes/stratified_scene.h"
#include "engine/scenes/trace_kernel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
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

// The camera grid of a stage: eq. 1 with every disparity times `disparity_scale`.
CameraGrid camera_grid_of(const Stage& stage, double disparity_scale) {
  const double side = std::max(stage.width, stage.height);
  CameraGrid camera;
  camera.baseline = stage.parallax * disparity_scale / stage.focal_px * side;  // eq. 2: b · xRes
  camera.focal_length = stage.focal_px / side;
  camera.shift = stage.parallax * disparity_scale / stage.zero_depth;
  camera.cam_distance = stage.zero_depth;
  return camera;
}

// Throws Unavailable for an unknown scene, naming the nearest and all.
void require_builtin(const std::string& id) {
  std::vector<std::string> ids;
  for (const BuiltinSceneInfo& scene : builtin_scenes()) ids.push_back(scene.id);
  if (std::ranges::find(ids, id) != ids.end()) return;
  throw Unavailable(no_such_name("built-in scene", id, ids) + " (there are " + joined(ids, ", ") +
                    ")");
}

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
  const std::vector<std::string> names = all_names<RandomKind>();
  if (std::ranges::find(names, value) == names.end()) {
    refuse(text, no_such_name("kind", value, names) + " (there are " + joined(names, ", ") + ")");
  }
  options.kind = value_named<RandomKind>(value);
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

struct View {
  ViewCamera camera;
  std::vector<Bounds> bounds;  // Of every primitive.
};

View make_view(const Stage& stage, const Model& model, double scale, CameraPosition at) {
  const double parallax = stage.parallax * scale;
  const double baseline = parallax / stage.focal_px;
  const double shift = parallax / stage.zero_depth;
  View view;
  view.camera.origin[0] = baseline * at.x;
  view.camera.origin[1] = baseline * at.y;
  view.camera.principal[0] = (stage.width - 1) / 2.0 + shift * at.x;
  view.camera.principal[1] = (stage.height - 1) / 2.0 + shift * at.y;
  view.camera.focal_px = stage.focal_px;
  for (const Primitive& primitive : model.primitives) {
    view.bounds.push_back(bounds_in_view(primitive, view.camera, stage.width, stage.height));
  }
  return view;
}

// In steps from the center view.
CameraPosition position_of(const RenderOptions& options, int index) {
  if (!options.positions.empty()) return options.positions[index];
  const ViewIndex view = options.grid.view_at(index), center = options.grid.center();
  return {static_cast<double>(view.u - center.u), static_cast<double>(view.v - center.v)};
}

struct RowBuffers {
  explicit RowBuffers(int width)
      : color(3 * static_cast<std::size_t>(width)),
        primitive(width),
        depth(width),
        pane(width),
        pane_depth(width),
        is_edge(width) {}

  [[nodiscard]] RowResult result() {
    return {color.data(), primitive.data(),  depth.data(),
            pane.data(),  pane_depth.data(), is_edge.data()};
  }

  std::vector<float> color;
  std::vector<int> primitive;
  std::vector<double> depth;
  std::vector<int> pane;
  std::vector<double> pane_depth;
  std::vector<unsigned char> is_edge;
  std::vector<Candidate> candidates;
};

// One cast of all views: what every row needs and where it writes.
class ViewsCast {
 public:
  ViewsCast(const Stage& stage, const Model& model, const RenderOptions& options)
      : stage_(stage),
        model_(model),
        options_(options),
        trace_row_(trace_row_for(best_isa())),
        exposure_(model.sensor, {stage.height, stage.width, options.channels, options.noise_sigma,
                                 options.seed}) {
    assert(model.primitives.size() <= kMaxCandidates);
    for (int i = 0; i < options.grid.count(); ++i) {
      views_.push_back(make_view(stage, model, options.disparity_scale, position_of(options, i)));
    }
    has_panes_ = std::any_of(model.primitives.begin(), model.primitives.end(),
                             [](const Primitive& p) { return p.is_pane; });
    cast_.samples = stack<std::uint8_t>(options.channels);
    cast_.truth.field.disparity = stack<float>();
    cast_.truth.field.valid = stack<std::uint8_t>();
    cast_.truth.labels = stack<std::int32_t>();
    if (has_panes_) {
      for (DisparityField* field : {&cast_.truth.foreground, &cast_.truth.background}) {
        field->disparity = stack<float>();
        field->valid = stack<std::uint8_t>();
      }
    }
    edges_ = Image<std::uint8_t>(stage.height, stage.width);
    surfaces_ = Image<std::int32_t>(stage.height, stage.width, 1, -1);
  }

  Cast run(const Progress& progress) {
    const int width = round_up(stage_.width, kTraceGroup);
    parallel_for_workers(options_.grid.count() * stage_.height, progress, [this, width] {
      return [this, buffers = RowBuffers(width)](int item) mutable {
        cast_row(options_.grid.view_at(item / stage_.height), item % stage_.height, buffers);
      };
    });
    add_regions();
    return std::move(cast_);
  }

 private:
  template <class T>
  [[nodiscard]] ViewStack<T> stack(int channels = 1) const {
    return ViewStack<T>(options_.grid, stage_.height, stage_.width, channels);
  }

  void cast_row(ViewIndex index, int y, RowBuffers& buffers) {
    const View& view = views_[static_cast<std::size_t>(index.v) * options_.grid.u + index.u];
    buffers.candidates.clear();
    for (std::size_t i = 0; i < view.bounds.size(); ++i) {
      const Bounds& bounds = view.bounds[i];
      if (y >= bounds.y_begin && y < bounds.y_end) {
        buffers.candidates.push_back({static_cast<int>(i), bounds.x_begin, bounds.x_end});
      }
    }
    RowJob job;
    job.model = model_.view();
    job.camera = view.camera;
    job.candidates = buffers.candidates.data();
    job.candidate_count = static_cast<int>(buffers.candidates.size());
    job.y = y;
    job.fill = model_.sensor.fill;
    job.width = static_cast<int>(buffers.primitive.size());
    trace_row_(job, buffers.result());
    write_samples(index, y, buffers);
    write_truth(index, y, buffers);
    if (index == options_.grid.center()) {
      std::copy_n(buffers.is_edge.data(), stage_.width, edges_.row(y));
      std::copy_n(buffers.primitive.data(), stage_.width, surfaces_.row(y));
    }
  }

  void write_samples(ViewIndex index, int y, const RowBuffers& buffers) {
    const auto out = cast_.samples.view(index);
    const ViewIndex center = options_.grid.center();
    exposure_.write_row({index.v - center.v, index.u - center.u}, y, buffers.color.data(),
                        static_cast<std::uint64_t>(out.row(y) - cast_.samples.data()), out.row(y));
  }

  void write_truth(ViewIndex index, int y, const RowBuffers& buffers) {
    GroundTruth& truth = cast_.truth;
    for (int x = 0; x < stage_.width; ++x) {
      const int solid = buffers.primitive[x];
      const int pane = buffers.pane[x];
      const bool is_seen = solid >= 0;
      const float behind = is_seen ? disparity(buffers.depth[x]) : 0;
      const float before = pane >= 0 ? disparity(buffers.pane_depth[x]) : behind;
      const int front = pane >= 0 ? pane : solid;
      truth.labels.view(index).at(y, x) = front >= 0 ? model_.primitives[front].label : 0;
      truth.field.disparity.view(index).at(y, x) = before;
      // Where two surfaces are seen there is no one disparity.
      truth.field.valid.view(index).at(y, x) = is_seen && pane < 0;
      if (!has_panes_) continue;
      truth.foreground.disparity.view(index).at(y, x) = before;
      truth.foreground.valid.view(index).at(y, x) = pane >= 0;
      truth.background.disparity.view(index).at(y, x) = behind;
      truth.background.valid.view(index).at(y, x) = is_seen && pane >= 0;
    }
  }

  [[nodiscard]] float disparity(double depth) const {
    const double parallax = stage_.parallax * options_.disparity_scale;
    return static_cast<float>(parallax / depth - parallax / stage_.zero_depth);  // eq. 1
  }

  // Rays that leave out parts of a pixel miss edges in it.
  void add_edges_between_pixels() {
    for (int y = 0; y < stage_.height; ++y) {
      for (int x = 0; x < stage_.width; ++x) {
        const int surface = surfaces_.at(y, x);
        const int right = surfaces_.at(y, std::min(x + 1, stage_.width - 1));
        const int below = surfaces_.at(std::min(y + 1, stage_.height - 1), x);
        if (surface != right || surface != below) edges_.at(y, x) = 1;
      }
    }
  }

  void add_regions() {
    if (model_.sensor.fill < 1) add_edges_between_pixels();
    constexpr int reach = 2;  // px around an edge that an estimator's window mixes.
    Image<std::uint8_t> discontinuities(stage_.height, stage_.width);
    Image<std::uint8_t> planes(stage_.height, stage_.width);
    Image<std::uint8_t> smooth(stage_.height, stage_.width);
    for (int y = 0; y < stage_.height; ++y) {
      for (int x = 0; x < stage_.width; ++x) {
        discontinuities.at(y, x) = is_near_edge(y, x, reach);
        const int surface = surfaces_.at(y, x);
        if (surface < 0 || discontinuities.at(y, x) != 0) continue;
        const bool is_curved = model_.primitives[surface].shape == Shape::Revolution;
        (is_curved ? smooth : planes).at(y, x) = 1;
      }
    }
    add_region("discontinuities", std::move(discontinuities));
    add_region("planes", std::move(planes));
    add_region("smooth_surfaces", std::move(smooth));
  }

  [[nodiscard]] bool is_near_edge(int y, int x, int reach) const {
    for (int j = std::max(y - reach, 0); j <= std::min(y + reach, stage_.height - 1); ++j) {
      for (int i = std::max(x - reach, 0); i <= std::min(x + reach, stage_.width - 1); ++i) {
        if (edges_.at(j, i) != 0) return true;
      }
    }
    return false;
  }

  void add_region(const std::string& name, Image<std::uint8_t> mask) {
    if (std::any_of(mask.begin(), mask.end(), [](std::uint8_t m) { return m != 0; })) {
      cast_.truth.regions.emplace(name, std::move(mask));
    }
  }

  const Stage& stage_;
  const Model& model_;
  const RenderOptions& options_;
  TraceRow trace_row_;
  Exposure exposure_;
  std::vector<View> views_;
  bool has_panes_ = false;
  Cast cast_;
  Image<std::uint8_t> edges_;     // Of the center view.
  Image<std::int32_t> surfaces_;  // Primitives of the center view.
};

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

std::string builtin_name(const std::string& id, const RenderOptions& options) {
  if (!is_drawn(id)) return id;
  if (options.kind == RandomKind::Any) return fmt::format("{}_{}", id, options.seed);
  return fmt::format("{}_{}_{}", id, name_of(options.kind), options.seed);
}

std::string builtin_text(const std::string& id, const RenderOptions& options) {
  if (!is_drawn(id)) return id;
  const std::string text = fmt::format("{}?seed={}", id, options.seed);
  return options.kind == RandomKind::Any ? text : text + "&kind=" + name_of(options.kind);
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

Cast cast_views(const Stage& stage, const Model& model, const RenderOptions& options,
                const Progress& progress) {
  return ViewsCast(stage, model, options).run(progress);
}

EPISCOPE_DECLARE_KERNEL(void trace_row(const RowJob& job, const RowResult& result));

TraceRow trace_row_for([[maybe_unused]] Isa isa) {
  return EPISCOPE_CHOOSE_KERNEL(isa, trace_row);
}

}  // namespace episcope::scenes
