// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/load_scene.h"

#include "app/session/collections.h"
#include "app/session/raw_scene.h"
#include "engine/capture/mesh_file.h"
#include "engine/capture/plenoptic/decode_files.h"
#include "engine/capture/plenoptic/processed_container.h"
#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/parameter.h"
#include "engine/core/shear.h"
#include "engine/core/text.h"
#include "engine/core/version.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/models/reader.h"
#include "engine/io/open.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <system_error>
#include <tuple>
#include <utility>
#include <variant>

namespace episcope {
namespace {

constexpr const char* kDemo = "demo";

// Of scenes with options there is no end: they are rendered each time.
bool is_worth_keeping(const scenes::BuiltinRequest& request) {
  return request.is_plain() && request.scene != scenes::kRandomScene;
}

SceneCache cache_for(const scenes::BuiltinRequest& request, const std::filesystem::path& folder) {
  return SceneCache(is_worth_keeping(request) ? folder : std::filesystem::path());
}

Scene render_center_view(const scenes::BuiltinRequest& request, const Progress& progress) {
  scenes::RenderOptions center_only = request.options;
  center_only.grid = {1, 1};
  return scenes::render_builtin(request.scene, center_only, progress);
}

void show_center_view(const Scene& center, GridShape grid, const io::OpenOptions& open) {
  const LightField& light_field = *center.light_field;
  if (!open.on_center_view || light_field.sample_type() != SampleType::UInt8) return;
  const ImageView<const std::uint8_t> view = light_field.view<std::uint8_t>({0, 0});
  Image<std::uint8_t> rgb(view.height, view.width, view.channels);
  std::copy_n(view.data, view.size(), rgb.data());
  open.on_center_view(rgb, light_field.info(), grid);
}

// What a kept built-in scene lacks: where it comes from and, in older archives, its region masks.
void complete_kept_scene(Scene& kept, const Scene& center) {
  // Nobody else has seen the scene yet, and a copy of its truth would double the memory.
  const auto truth = std::const_pointer_cast<GroundTruth>(kept.truth);
  if (truth->has_disparity() || truth->has_layers()) {
    truth->regions = center.truth->regions;
    truth->stratified = center.truth->stratified;
  }
  kept.convention = center.convention;
}

Scene load_builtin(const std::string& id, const LoadOptions& options, const Progress& progress) {
  require_builtin_input(id);
  if (is_gantry(id)) return load_gantry(id, options, progress);
  if (id == kPlenopticScene) return load_plenoptic(progress);
  const std::string source = id == kDemo ? id : std::string(kDemo) + ":" + id;
  const scenes::BuiltinRequest request = scenes::read_request(id);
  progress.step("rendering the center view");
  const Scene center = render_center_view(request, progress.part(0, 0.02));
  show_center_view(center, request.options.grid, options.open);
  progress.step("reading the built-in scene");
  std::optional<Scene> scene =
      cache_for(request, options.cache_folder)
          .read(request.scene, request.options, options.needs_truth, progress.part(0.02, 0.9));
  if (scene) {
    complete_kept_scene(*scene, center);
  } else {
    progress.step("rendering all views");
    scene = scenes::render_builtin(request.scene, request.options, progress.part(0.02, 1));
  }
  if (scene->light_field->info().source != source) {
    LightFieldInfo info = scene->light_field->info();
    info.name = request.name();
    info.source = source;
    info.reading = {scenes::kBuiltinReader, {}};
    scene->light_field = with_info(*scene->light_field, std::move(info));
  }
  return std::move(*scene);
}

// A folder that cannot be opened may hold light fields below; a single one is what is meant.
Scene open_light_field(const std::string& input, const io::OpenOptions& options,
                       const Progress& progress) {
  if (capture::is_lfp_container(input)) {
    if (const auto processed = capture::read_processed(input)) return scene_of(*processed);
    Scene scene = capture::decode_files({.raw = input}, {}, progress);
    return options.focus_px == 0 ? std::move(scene) : sheared(scene, options.focus_px, progress);
  }
  try {
    return io::open_scene(input, options, progress);
  } catch (const io::Undecided&) {
    throw;
  } catch (const IoError&) {
    const auto below = collection_at(input, options, progress);
    if (below.size() == 1) return io::open_scene(below.front().path, options, progress);
    if (!below.empty()) throw IsCollection(input, below.size());
    throw;
  }
}

}  // namespace

LightFieldPtr with_info(const LightField& light_field, LightFieldInfo info) {
  auto samples = std::visit([](const auto& stack) { return LightField::Samples(stack.clone()); },
                            light_field.samples());
  return std::make_shared<const LightField>(std::move(samples), std::move(info),
                                            light_field.valid().clone());
}

std::string builtin_scene_id(const std::string& input) {
  const std::string prefix = std::string(kDemo) + ":";
  if (input == kDemo || input == prefix) return kDemo;
  if (input.starts_with(std::string(kDemo) + "?")) return input;
  return input.starts_with(prefix) ? input.substr(prefix.size()) : std::string();
}

std::string reader_of(const std::string& input, const io::OpenOptions& options) {
  if (!builtin_scene_id(input).empty()) return scenes::kBuiltinReader;
  if (const io::Reader* reader = io::find_reader(input, options).reader) return reader->id;
  const auto below = collection_at(input, options, Progress());
  return below.size() == 1 ? below.front().reader : std::string();
}

Scene load_scene(const std::string& input, const LoadOptions& options, const Progress& progress) {
  const std::string id = builtin_scene_id(input);
  if (id.empty()) {
    io::OpenOptions open = options.open;
    open.needs_truth = options.needs_truth;
    Scene scene = open_light_field(input, open, progress);
    if (options.needs_truth) read_kept_scribbles(scene, progress);
    return scene;
  }
  const double focus_px = options.open.focus_px;
  Scene scene = load_builtin(id, options, progress.part(0, focus_px == 0 ? 1 : 0.8));
  if (focus_px == 0) return scene;
  return sheared(scene, focus_px, progress.part(0.8, 1));
}

namespace {

/// Options that nothing came of.
void warn_of_ignored(const ParameterSet& given, Scene& scene) {
  const std::string& id = scene.light_field->info().reading.reader;
  const io::Reader* reader = io::reader_named(id);
  const std::string name = reader ? reader->name : "a built-in scene";
  for (const auto& [key, value] : given) {
    if (key == Reading::kFocus || (reader && reader->has_option(key))) continue;
    scene.convention.warnings.push_back(fmt::format(finding_text("option.ignored"), key, name));
  }
}

}  // namespace

Scene open_input(const std::string& input, io::OpenOptions open, bool needs_truth,
                 const Progress& progress) {
  const bool is_builtin = !builtin_scene_id(input).empty();
  const ParameterSet given = io::given_options(open);
  const LoadOptions load{
      .open = std::move(open), .cache_folder = default_cache_folder(), .needs_truth = needs_truth};
  progress.step("reading " + std::filesystem::path(input).filename().string());
  Scene scene = load_scene(input, load, progress.part(0, is_builtin ? 0.9 : 1));
  warn_of_ignored(given, scene);
  if (is_builtin) store_in_cache(input, scene, load.cache_folder, progress.part(0.9, 1));
  return scene;
}

void store_in_cache(const std::string& input, const Scene& scene,
                    const std::filesystem::path& cache_folder, const Progress& progress) {
  const std::string id = builtin_scene_id(input);
  const bool is_kept_elsewhere = id.empty() || is_gantry(id) || id == kPlenopticScene;
  if (is_kept_elsewhere || cache_folder.empty() || scene.convention.focus_px != 0) return;
  const scenes::BuiltinRequest request = scenes::read_request(id);
  if (!is_worth_keeping(request)) return;
  const SceneCache cache(cache_folder);
  if (!io::is_there(cache.place(request.scene, request.options))) {
    cache.write(request.scene, request.options, scene, progress);
  }
}

std::vector<scenes::BuiltinSceneInfo> builtin_inputs() {
  std::vector<scenes::BuiltinSceneInfo> all = scenes::builtin_scenes();
  const auto random = std::ranges::find(all, scenes::kRandomScene, &scenes::BuiltinSceneInfo::id);
  all.insert(random,
             {kGantryScene,
              "photographs of a gantry, to calibrate, rectify and give a depth from a scan"});
  all.insert(std::ranges::find(all, scenes::kRandomScene, &scenes::BuiltinSceneInfo::id),
             {kPlenopticScene, "the demo as a plenoptic camera records it, decoded"});
  return all;
}

void require_builtin_input(const std::string& id) {
  const std::string scene = id.substr(0, id.find('?'));
  std::vector<std::string> ids;
  for (const scenes::BuiltinSceneInfo& each : builtin_inputs()) ids.push_back(each.id);
  if (std::ranges::find(ids, scene) == ids.end()) {
    throw Unavailable(no_such_name("built-in scene", scene, ids) + " (there are " +
                      joined(ids, ", ") + ")");
  }
  if (is_gantry(id)) {
    std::ignore = gantry_options(id);
  } else if (scene == kPlenopticScene) {
    if (id != scene) throw InvalidInput("the built-in scene plenoptic has no options");
  } else {
    std::ignore = scenes::read_request(id);
  }
}

std::string builtin_input_name(const std::string& id) {
  if (is_gantry(id)) return kGantryScene;
  return id == kPlenopticScene ? kPlenopticScene : scenes::read_request(id).name();
}

namespace {

std::string key_of(const std::string& id, const scenes::RenderOptions& options) {
  return fmt::format("{}-{}-{}x{}-{}x{}x{}-n{:g}-s{}-d{:g}", id, kVersion, options.grid.v,
                     options.grid.u, options.height, options.width, options.channels,
                     options.noise_sigma, options.seed, options.disparity_scale);
}

}  // namespace

std::filesystem::path SceneCache::place(const std::string& id,
                                        const scenes::RenderOptions& options) const {
  return folder_ / key_of(id, options);
}

std::optional<Scene> SceneCache::read(const std::string& id, const scenes::RenderOptions& options,
                                      bool needs_truth, const Progress& progress) const {
  const std::filesystem::path file = place(id, options) / "lf.h5";
  std::error_code ignored;
  if (folder_.empty() || !std::filesystem::exists(file, ignored)) return std::nullopt;
  try {
    // The order is ours: checking it would only take time.
    io::OpenOptions open;
    open.flip = io::Flip::None;
    open.needs_truth = needs_truth;
    return io::open_scene(file, open, progress);
  } catch (const Error&) {
    std::filesystem::remove_all(place(id, options), ignored);
    return std::nullopt;
  }
}

bool SceneCache::write(const std::string& id, const scenes::RenderOptions& options,
                       const Scene& scene, const Progress& progress) const {
  if (folder_.empty()) return false;
  std::error_code ignored;
  std::filesystem::create_directories(folder_, ignored);
  std::filesystem::remove_all(place(id, options), ignored);
  try {
    io::AtomicFolder made(place(id, options));
    io::write_archive(made.temporary() / "lf.h5", scene, progress);
    made.commit();
    return true;
  } catch (const Error&) {
    return false;
  }
}

namespace {

namespace fs = std::filesystem;

// Changes when what is made changes.
constexpr const char* kGantryVersion = "1";

fs::path place_of(const capture::DemoOptions& options, const fs::path& cache) {
  return cache / "gantry" /
         fmt::format("{}_{}x{}_{}x{}_{:g}_{}", kGantryVersion, options.grid.v, options.grid.u,
                     options.width, options.height, options.noise, options.seed);
}

// The text with the commands is written last.
bool is_whole(const fs::path& folder) {
  return io::is_there(folder / "readme.txt");
}

// Returns whether the folder is there, which may have been made meanwhile.
bool make_folder(const fs::path& place, const capture::DemoOptions& options,
                 const Progress& progress) {
  std::error_code ignored;
  fs::create_directories(place.parent_path(), ignored);
  try {
    io::AtomicFolder made(place);
    capture::write_demo_folder(made.temporary(), options, progress);
    made.commit();
  } catch (const IoError&) {  // a cache is a convenience
  }
  return is_whole(place);
}

void show_center(const capture::DemoOptions& options, const io::OpenOptions& open,
                 const Progress& progress) {
  if (!open.on_center_view) return;
  const capture::DemoRig rig = capture::demo_rig(options);
  const capture::TriangleMesh mesh = capture::scan_mesh(options.detail);
  LightFieldInfo info;
  info.name = kGantryScene;
  open.on_center_view(capture::demo_photograph(rig, mesh, options.grid.center(), progress), info,
                      options.grid);
}

LightFieldPtr photographs_of(const capture::DemoOptions& options, LightFieldInfo info,
                             const fs::path& cache, const Progress& progress) {
  const fs::path place = place_of(options, cache);
  const bool is_kept =
      !cache.empty() && (is_whole(place) || make_folder(place, options, progress.part(0, 0.95)));
  if (!is_kept) {
    return std::make_shared<const LightField>(
        capture::demo_photographs(capture::demo_rig(options), capture::scan_mesh(options.detail),
                                  progress),
        std::move(info));
  }
  const io::OpenOptions as_written{.flip = io::Flip::None};
  const std::string photographs = GantryFolder{place}.photographs().string();
  return with_info(*io::open_scene(photographs, as_written, progress.part(0.95, 1)).light_field,
                   std::move(info));
}

}  // namespace

bool is_gantry(const std::string& id) {
  return id.substr(0, id.find('?')) == kGantryScene;
}

capture::DemoOptions gantry_options(const std::string& id) {
  const capture::DemoOptions plain;
  scenes::BuiltinRequest request{kGantryScene, {}};
  request.options.grid = plain.grid;
  request.options.height = plain.height;
  request.options.width = plain.width;
  request.options.noise_sigma = plain.noise;
  request.options.seed = plain.seed;
  scenes::read_options(id, request);
  const scenes::RenderOptions& given = request.options;
  const bool is_possible = given.grid.u >= 3 && given.grid.v >= 3 && given.grid.u <= 21 &&
                           given.grid.v <= 21 && given.width >= 160 && given.height >= 120 &&
                           given.width <= 4096 && given.height <= 4096 && given.noise_sigma <= 255;
  if (!is_possible) {
    throw InvalidInput(
        fmt::format("cannot photograph '{}': the gantry has 3 to 21 rows and columns, photographs "
                    "have 160x120 to 4096x4096 px and noise of 255 at most",
                    id));
  }
  capture::DemoOptions options;
  options.grid = given.grid;
  options.height = given.height;
  options.width = given.width;
  options.noise = given.noise_sigma;
  options.seed = given.seed;
  return options;
}

std::vector<fs::path> GantryFolder::pattern() const {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path / "pattern")) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

std::optional<GantryFolder> gantry_folder(const std::string& input, const fs::path& cache_folder) {
  if (cache_folder.empty()) return {};
  const std::string id = builtin_scene_id(input);
  fs::path folder = fs::path(input).parent_path();
  if (is_gantry(id)) {
    folder = place_of(gantry_options(id), cache_folder);
  } else if (!id.empty() || folder.parent_path() != cache_folder / "gantry") {
    return {};
  }
  if (!is_whole(folder)) return {};
  return GantryFolder{folder};
}

Scene load_gantry(const std::string& id, const LoadOptions& options, const Progress& progress) {
  const capture::DemoOptions demo = gantry_options(id);
  progress.step("photographing the center view");
  show_center(demo, options.open, progress.part(0, 0.05));
  LightFieldInfo info;
  info.name = kGantryScene;
  info.source = "demo:" + id;
  info.reading.reader = scenes::kBuiltinReader;
  Scene scene;
  scene.light_field =
      photographs_of(demo, std::move(info), options.cache_folder, progress.part(0.05, 1));
  scene.truth = std::make_shared<const GroundTruth>();
  scene.convention.format = "photographs of the built-in gantry";
  scene.convention.order = "canonical order";
  scene.convention.order_check = "exact by construction";
  scene.convention.sign = "checked";
  scene.convention.sign_check = "exact by construction";
  return scene;
}

}  // namespace episcope
