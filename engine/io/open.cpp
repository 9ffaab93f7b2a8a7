// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open.h"

#include "engine/core/error.h"
#include "engine/core/shear.h"
#include "engine/core/text.h"
#include "engine/io/base/foreign_content.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/io/formats/archive_reader.h"
#include "engine/io/formats/array_reader.h"
#include "engine/io/formats/benchmark_reader.h"
#include "engine/io/formats/blender_reader.h"
#include "engine/io/formats/frames_reader.h"
#include "engine/io/formats/image_grid.h"
#include "engine/io/formats/mosaic_layout.h"
#include "engine/io/formats/mosaic_reader.h"
#include "engine/io/formats/sequence_reader.h"
#include "engine/io/models/names/view_folders.h"
#include "engine/io/models/reader.h"
#include "engine/io/models/scribble_file.h"
#include "engine/io/models/sidecar_maps/find_maps.h"
#include "engine/io/models/sidecar_maps/scene_files.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <new>
#include <string_view>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* kConvert =
    "views are not read from GIF pictures, which hold 256 colors; use the originals, or convert "
    "them to PNG";

struct FormWithoutMark {
  std::string_view suffix;
  const char* advice;
};

constexpr const char* kExport =
    "this is a picture of a light-field camera in a form that is not read; export its views as "
    "images, and open their folder";
constexpr const char* kDevelop =
    "raw photographs are not read; develop all views alike to TIFF of 16 bit, without correction "
    "of the lens, and open these";

/// Forms that the first bytes do not tell.
constexpr FormWithoutMark kWithoutMark[] = {
    {".lfi", kExport},  {".lfx", kExport},  {".ray", kExport},  {".dng", kDevelop},
    {".nef", kDevelop}, {".cr2", kDevelop}, {".cr3", kDevelop}, {".arw", kDevelop},
    {".raf", kDevelop}, {".orf", kDevelop}, {".rw2", kDevelop}};

// Advice on a file whose content is of no form that is read (foreign_content.h), or whose suffix
// names a form that its bytes do not tell. The end of a sentence; empty for other files.
std::string advice_on(const fs::path& path) {
  const std::string content = foreign_content(path);
  if (!content.empty()) return content;
  const auto known = std::ranges::find(kWithoutMark, suffix_of(path), &FormWithoutMark::suffix);
  return known == std::end(kWithoutMark) ? std::string() : known->advice;
}

// Advice on a folder without a light field, by its first file of an unsupported format or GIF
// picture, with its name. Empty if there is none. Throws std::filesystem::filesystem_error.
std::string advice_on_folder(const fs::path& folder) {
  constexpr std::string_view kPicture = ".gif";
  std::string first;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string advice =
        suffix_of(entry.path()) == kPicture ? std::string(kConvert) : advice_on(entry.path());
    const std::string name = entry.path().filename().string();
    if (advice.empty() || (!first.empty() && first <= name + ": " + advice)) continue;
    first = name + ": " + advice;
  }
  return first;
}

}  // namespace

std::span<const Reader> readers() {
  static const Reader kReaders[] = {blender_reader(), sequence_reader(),  frames_reader(),
                                    mosaic_reader(),  matlab_reader(),    hdf5_array_reader(),
                                    numpy_reader(),   archive_reader(),   benchmark_reader(),
                                    excerpt_reader(), image_grid_reader()};
  return kReaders;
}

namespace {

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
  if (found.path == path && is_segmentation_file(path)) {
    throw NoLightField(path, std::string("holds labels and no light field; ") + kRemedyForLabels);
  }
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
  if (options.equalize && options.keep_brightness) {
    throw InvalidInput("equalize and no-equalize exclude each other; choose one of them");
  }
  try {
    const Progress reading = progress.part(0, options.focus_px == 0 ? 1 : 0.8);
    Scene scene = read_scene(path, options, reading);
    if (options.focus_px == 0) return scene;
    return sheared(scene, options.focus_px, progress.part(0.8, 1));
  } catch (const fs::filesystem_error& error) {
    throw IoError(path,
                  "it cannot be read (" + error.code().message() + "); check its permissions");
  } catch (const std::bad_alloc&) {
    throw IoError(path, kNotEnoughMemory);
  }
}

bool reads_as_truth(const fs::path& map, const fs::path& input) {
  std::error_code error;
  if (fs::is_directory(input, error)) return is_found_as_truth(map, views_folder(input));
  if (!fs::is_regular_file(input, error)) return false;
  const bool is_picture = is_image_name(input);
  const std::string scene = is_picture ? scene_of_mosaic(input) : input.stem().string();
  // Only beside NumPy arrays and pictures may maps be called after nothing.
  const bool may_be_only = is_picture || suffix_of(input) == ".npy";
  const SceneFiles own({scene}, light_fields_beside(input), may_be_only);
  const fs::path folder = input.has_parent_path() ? input.parent_path() : fs::path(".");
  return is_found_as_truth(map, folder, own);
}

}  // namespace episcope::io
