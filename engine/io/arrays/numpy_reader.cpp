// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/numpy_reader.h"

#include "engine/core/error.h"
#include "engine/core/text/suffix.h"
#include "engine/io/arrays/array_scene.h"
#include "engine/io/arrays/folder_file.h"
#include "engine/io/arrays/npy_file.h"
#include "engine/io/arrays/numpy_file.h"
#include "engine/io/beside/map_name.h"

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNumpyReader = "numpy";

/// Of the `.npy` files of a folder, most hold maps.
bool can_hold_views(const fs::path& path) {
  const std::string suffix = suffix_of(path);
  if (suffix == ".npz") return true;
  if (suffix != ".npy" || map_kind(path.stem().string())) return false;
  try {
    return NpyFile(path).shape().size() > 3;
  } catch (const IoError&) {
    return false;
  }
}

fs::path find_numpy(const fs::path& path, const OpenOptions&) {
  if (fs::is_directory(path)) {
    fs::path only = only_file_in(path, can_hold_views);
    return only.empty() && is_folder_of_views(path) ? path : only;
  }
  return is_numpy_file(path) ? path : fs::path();
}

Scene read_numpy(const fs::path& path, const OpenOptions& options, const Progress& progress) {
  return read_array_scene(NumpyFile(path), kNumpyReader, options, progress);
}

SceneProbe probe_numpy(const fs::path& path, const OpenOptions& options) {
  return probe_arrays(NumpyFile(path), options);
}

}  // namespace

Reader numpy_reader() {
  return {.id = kNumpyReader,
          .name = "a NumPy array",
          .options = array_options(),
          .find = find_numpy,
          .read = read_numpy,
          .probe = probe_numpy};
}

}  // namespace episcope::io
