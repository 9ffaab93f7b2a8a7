// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/gantry_scene.h"

#include "engine/capture/demo_folder.h"
#include "engine/capture/mesh_file.h"
#include "engine/core/error.h"
#include "engine/io/open.h"
#include "engine/scenes/builtin.h"

#include <fmt/format.h>

#include <unistd.h>
#include <algorithm>
#include <memory>
#include <system_error>
#include <utility>

namespace episcope {
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
  std::error_code ignored;
  return fs::exists(folder / "readme.txt", ignored);
}

// Nobody sees a folder that is not whole. Returns whether it is there.
bool make_folder(const fs::path& place, const capture::DemoOptions& options,
                 const Progress& progress) {
  const fs::path begun = place.string() + fmt::format(".{}", ::getpid());
  std::error_code ignored;
  try {
    capture::write_demo_folder(begun, options, progress);
    fs::rename(begun, place, ignored);  // if it was made meanwhile, that one is as good
  } catch (const IoError&) {            // a cache is a convenience
  } catch (...) {
    fs::remove_all(begun, ignored);
    throw;
  }
  fs::remove_all(begun, ignored);
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

LightField::Samples copy_of(const LightField& field) {
  return std::visit([](const auto& all) { return LightField::Samples(all.clone()); },
                    field.samples());
}

LightField::Samples photographs_of(const capture::DemoOptions& options, const fs::path& cache,
                                   const Progress& progress) {
  if (!cache.empty()) {
    const fs::path place = place_of(options, cache);
    if (is_whole(place) || make_folder(place, options, progress.part(0, 0.95))) {
      const io::OpenOptions as_written{.flip = io::Flip::None};
      return copy_of(*io::open_scene(GantryFolder{place}.photographs().string(), as_written,
                                     progress.part(0.95, 1))
                          .light_field);
    }
  }
  return copy_of(capture::demo_photographs(capture::demo_rig(options),
                                           capture::scan_mesh(options.detail), progress));
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
  scene.light_field = std::make_shared<const LightField>(
      photographs_of(demo, options.cache_folder, progress.part(0.05, 1)), std::move(info));
  scene.truth = std::make_shared<const GroundTruth>();
  scene.convention.format = "photographs of the built-in gantry";
  scene.convention.order = "canonical order";
  scene.convention.order_check = "exact by construction";
  scene.convention.sign = "checked";
  scene.convention.sign_check = "exact by construction";
  return scene;
}

}  // namespace episcope
