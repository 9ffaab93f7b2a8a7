// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open/open.h"

#include "engine/core/error.h"
#include "engine/core/light_field/shear.h"
#include "engine/io/hdf5/hdf5_file.h"
#include "engine/io/open/foreign_form.h"
#include "engine/io/open/reader.h"

#include <memory>
#include <new>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

/// Readers ask an HDF5 file one after the other whether it is theirs: it stays open meanwhile.
std::unique_ptr<const Hdf5Input> kept_open(const fs::path& path) {
  std::error_code error;
  const fs::path file = fs::is_directory(path, error) ? path / "lf.h5" : path;
  if (!fs::is_regular_file(file, error) || !has_hdf5_signature(file)) return nullptr;
  try {
    return std::make_unique<const Hdf5Input>(file);
  } catch (const IoError&) {
    return nullptr;  // which readers will say
  }
}

Scene read_scene(const fs::path& path, const OpenOptions& options, const Progress& progress) {
  const auto kept = kept_open(path);
  const FoundReader found = find_reader(path, options);
  if (found.reader) return found.reader->read(found.path, options, progress);
  if (!fs::is_directory(path)) {
    const std::string advice = advice_on(path);
    throw IoError(path, advice.empty() ? "this is not a light field: an lf.h5, a scene folder or a "
                                         "folder of images is expected; choose another file"
                                       : advice);
  }
  const std::string advice = advice_on_folder(path);
  if (!advice.empty()) {
    throw IoError(path, "there is no light field in this folder, but " + advice);
  }
  throw IoError(
      path,
      std::string(fs::is_empty(path) ? "the folder is empty"
                                     : "there is no light field in this folder") +
          "; expected an lf.h5, a parameters.cfg with input_Cam000.png …, or images on a grid");
}

}  // namespace

Scene open_scene(const fs::path& path, const OpenOptions& options, const Progress& progress) {
  try {
    const Progress reading = progress.part(0, options.focus_px == 0 ? 1 : 0.8);
    Scene scene = read_scene(path, options, reading);
    if (options.focus_px == 0) return scene;
    return sheared(scene, options.focus_px, progress.part(0.8, 1));
  } catch (const fs::filesystem_error& error) {
    throw IoError(path,
                  "it cannot be read (" + error.code().message() + "); check its permissions");
  } catch (const std::bad_alloc&) {
    throw IoError(
        path, "not enough memory for this light field; close other programs or open a smaller one");
  }
}

}  // namespace episcope::io
