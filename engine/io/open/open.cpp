// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open/open.h"

#include "engine/core/error.h"
#include "engine/core/light_field/shear.h"
#include "engine/io/archive/archive_reader.h"
#include "engine/io/archive/excerpt_reader.h"
#include "engine/io/benchmark/benchmark_reader.h"
#include "engine/io/durable/system_error.h"
#include "engine/io/grid/decode_image.h"
#include "engine/io/grid/grid_names.h"
#include "engine/io/grid/image_grid_reader.h"
#include "engine/io/hdf5/hdf5_file.h"

#include <algorithm>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

bool is_hdf5_name(const fs::path& path) {
  const std::string suffix = path.extension().string();
  return suffix == ".h5" || suffix == ".hdf5" || suffix == ".H5";
}

/// The HDF5 file of a folder that holds a light field; empty if there is none.
fs::path find_archive_file(const fs::path& folder) {
  if (fs::exists(folder / "lf.h5")) return folder / "lf.h5";
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (is_hdf5_name(entry.path()) && has_hdf5_signature(entry.path())) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  const auto found = std::find_if(files.begin(), files.end(),
                                  [](const fs::path& path) { return Hdf5Input(path).has("LF"); });
  return found == files.end() ? fs::path() : *found;
}

Scene open_folder(const fs::path& folder, const OpenOptions& options, const Progress& progress) {
  const fs::path archive = find_archive_file(folder);
  if (!archive.empty()) return read_archive(archive, options, progress);
  const bool is_grid_wanted = !options.pattern.empty() || options.snake;
  if (!is_grid_wanted && is_benchmark_folder(folder)) {
    return read_benchmark(folder, options, progress);
  }
  if (!is_grid_wanted && is_excerpt_folder(folder)) return read_excerpt(folder, options, progress);
  for (const char* name : {"lf", "views", "images", "rectified"}) {
    if (fs::is_directory(folder / name) && count_images(folder / name) > 1) {
      return read_image_grid(folder / name, options, progress);
    }
  }
  if (count_images(folder) > 0) return read_image_grid(folder, options, progress);
  const bool is_empty = fs::is_empty(folder);
  throw IoError(folder, std::string(is_empty ? "the folder is empty"
                                             : "there is no light field in this folder") +
                            "; a lf.h5, a parameters.cfg with input_Cam000.png …, or images on a "
                            "grid were looked for");
}

Scene open_file(const fs::path& path, const OpenOptions& options, const Progress& progress) {
  require_readable_file(path);
  if (has_hdf5_signature(path) || is_hdf5_name(path)) {
    const Hdf5Input file(path);
    const fs::path light_field = path.parent_path() / "lf.h5";
    if (file.has("LF") || !fs::exists(light_field) || file.has("estimate")) {
      if (!file.has("LF") && file.has("estimate")) {
        throw IoError(path,
                      "this file holds a disparity result and no light field; open the light "
                      "field that it belongs to");
      }
      return read_archive(path, options, progress);
    }
    return read_archive(light_field, options, progress);
  }
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (path.filename() == "parameters.cfg" || is_image_name(path)) {
    return open_folder(folder, options, progress);
  }
  throw IoError(path,
                "this is no light field: an lf.h5, a scene folder or a folder of images is "
                "expected; choose another file");
}

}  // namespace

Scene open_scene(const fs::path& path, const OpenOptions& options, const Progress& progress) {
  try {
    const Progress reading = progress.part(0, options.focus_px == 0 ? 1 : 0.8);
    Scene scene = fs::is_directory(path) ? open_folder(path, options, reading)
                                         : open_file(path, options, reading);
    if (options.focus_px == 0) return scene;
    return sheared(scene, options.focus_px, progress.part(0.8, 1));
  } catch (const fs::filesystem_error& error) {
    throw IoError(path,
                  "it cannot be read (" + error.code().message() + "); check its permissions");
  } catch (const std::bad_alloc&) {
    throw IoError(path,
                  "the light field needs more memory than this machine has free; close other "
                  "programs or open a smaller one");
  }
}

}  // namespace episcope::io
