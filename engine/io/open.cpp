// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open.h"

#include "engine/core/error.h"
#include "engine/core/shear.h"
#include "engine/core/text.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/io/formats/archive_reader.h"
#include "engine/io/formats/array_reader.h"
#include "engine/io/formats/benchmark_reader.h"
#include "engine/io/formats/blender_reader.h"
#include "engine/io/formats/frames_reader.h"
#include "engine/io/formats/image_grid.h"
#include "engine/io/formats/mosaic_reader.h"
#include "engine/io/formats/sequence_reader.h"
#include "engine/io/models/reader.h"

#include <memory>
#include <new>
#include <string_view>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

struct UnsupportedForm {
  std::string_view suffix;
  const char* advice;
};

constexpr const char* kUnpack =
    "this is an archive of files; unpack it and open the folder that it makes";
constexpr const char* kDecode =
    "this is a raw picture of a Lytro camera; make a light field of it with episcope-cli decode";
constexpr const char* kSave =
    "this is an object that a program has saved for itself; save the array as .npy, .npz or .h5";

constexpr const char* kConvert =
    "views are not read from GIF pictures, which hold 256 colors; use the originals, or convert "
    "them to PNG";

constexpr UnsupportedForm kUnsupportedForms[] = {
    {".zip", kUnpack}, {".tar", kUnpack}, {".gz", kUnpack},  {".tgz", kUnpack},
    {".xz", kUnpack},  {".bz2", kUnpack}, {".zst", kUnpack}, {".7z", kUnpack},
    {".rar", kUnpack}, {".lfp", kDecode}, {".lfr", kDecode}, {".lfx", kDecode},
    {".pt", kSave},    {".pth", kSave},   {".pkl", kSave},   {".pickle", kSave}};

}  // namespace

std::span<const Reader> readers() {
  static const Reader kReaders[] = {blender_reader(), sequence_reader(),  frames_reader(),
                                    mosaic_reader(),  matlab_reader(),    hdf5_array_reader(),
                                    numpy_reader(),   archive_reader(),   benchmark_reader(),
                                    excerpt_reader(), image_grid_reader()};
  return kReaders;
}

std::string advice_on(const fs::path& path) {
  const std::string suffix = suffix_of(path);
  for (const UnsupportedForm& form : kUnsupportedForms) {
    if (suffix == form.suffix) return form.advice;
  }
  return foreign_content(path);
}

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
    throw IoError(path, kNotEnoughMemory);
  }
}

}  // namespace episcope::io
