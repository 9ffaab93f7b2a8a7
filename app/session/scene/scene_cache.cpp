// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/scene/scene_cache.h"

#include "engine/core/error.h"
#include "engine/core/version.h"
#include "engine/io/archive/write_scene.h"
#include "engine/io/hdf5/hdf5_file.h"
#include "engine/io/open/open.h"

#include <fmt/format.h>

#include <cstdio>
#include <random>
#include <system_error>

namespace episcope {
namespace {

// Removes a folder when it goes out of scope, whatever happened.
struct TemporaryFolder {
  std::filesystem::path path;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
};

std::string random_suffix() {
  std::random_device random;
  return fmt::format(".{:08x}", random());
}

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
                                      const Progress& progress) const {
  const std::filesystem::path file = place(id, options) / "lf.h5";
  std::error_code ignored;
  if (folder_.empty() || !std::filesystem::exists(file, ignored)) return std::nullopt;
  try {
    // The order is ours: checking it would only take time.
    io::OpenOptions open;
    open.flip = io::Flip::None;
    return io::open_scene(file, open, progress);
  } catch (const Error&) {
    std::filesystem::remove_all(place(id, options), ignored);
    return std::nullopt;
  }
}

std::optional<ViewStack<std::uint8_t>> SceneCache::read_samples(
    const std::string& id, const scenes::RenderOptions& options, const Progress& progress) const {
  const std::filesystem::path path = place(id, options) / "lf.h5";
  std::error_code ignored;
  if (folder_.empty() || !std::filesystem::exists(path, ignored)) return std::nullopt;
  try {
    const io::Hdf5Input file(path);
    ViewStack<std::uint8_t> stack(options.grid, options.height, options.width, options.channels);
    const auto length = [](int n) { return static_cast<std::size_t>(n); };
    const io::Hdf5Shape shape{length(options.grid.v), length(options.grid.u),
                              length(options.height), length(options.width),
                              length(options.channels)};
    const io::Hdf5Dataset dataset = file.dataset("LF");
    if (dataset.shape != shape || dataset.type != io::Hdf5Type::UInt8) return std::nullopt;
    for (int i = 0; i < options.grid.count(); ++i) {
      progress.check();
      const ViewIndex view = options.grid.view_at(i);
      const io::Hdf5Block block{{length(view.v), length(view.u), 0, 0, 0},
                                {1, 1, shape[2], shape[3], shape[4]}};
      file.read("LF", block, stack.view(view).data);
      progress.report((i + 1.0) / options.grid.count());
    }
    return stack;
  } catch (const IoError&) {
    return std::nullopt;
  }
}

bool SceneCache::write(const std::string& id, const scenes::RenderOptions& options,
                       const Scene& scene, const Progress& progress) const {
  if (folder_.empty()) return false;
  const std::filesystem::path final_place = place(id, options);
  std::error_code failure;
  std::filesystem::create_directories(folder_, failure);
  if (failure) return false;
  const TemporaryFolder temporary{final_place.string() + random_suffix()};
  std::filesystem::create_directory(temporary.path, failure);
  if (failure) return false;
  try {
    io::write_archive(temporary.path / "lf.h5", scene, progress);
  } catch (const Error&) {
    return false;
  }
  std::filesystem::remove_all(final_place, failure);
  std::filesystem::rename(temporary.path, final_place, failure);
  return !failure;
}

}  // namespace episcope
