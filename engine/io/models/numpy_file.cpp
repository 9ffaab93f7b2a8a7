// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/numpy_file.h"

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/json.h"
#include "engine/io/base/npy.h"
#include "engine/io/models/choose_layout.h"
#include "engine/io/models/estimated.h"
#include "engine/io/models/sidecar_maps/map_name.h"
#include "engine/io/models/sidecar_maps/scene_files.h"

#include <algorithm>
#include <fstream>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBeside = 100;
constexpr std::size_t kMostInFolder = 10'000;

bool begins_as_npy(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string begin(kNpyPrefix, '\0');
  return in.read(begin.data(), static_cast<std::streamsize>(begin.size())) && has_npy_magic(begin);
}

/// Where other light fields lie there, only maps that are named after this one.
std::vector<fs::path> maps_beside(const fs::path& path) {
  std::vector<fs::path> found;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  bool is_only = true;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const fs::path& other = entry.path();
    if (suffix_of(other) != ".npy" || other.filename() == path.filename()) continue;
    const std::string stem = other.stem().string();
    const bool is_map = map_kind(stem) || is_bare_truth_name(stem);
    is_only = is_only && is_map;
    if (is_map) found.push_back(other);
  }
  const SceneFiles own({path.stem().string()}, light_fields_beside(path), is_only);
  std::erase_if(found, [&](const fs::path& map) { return !own.contains(map); });
  if (found.size() > kMostBeside) return {};
  std::ranges::sort(found);
  return found;
}

/// In the order of their names; none if there are too many, or images.
std::vector<fs::path> arrays_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (is_image_name(entry.path())) return {};
    const bool is_hidden = entry.path().filename().string().starts_with('.');
    if (!is_hidden && suffix_of(entry.path()) == ".npy") found.push_back(entry.path());
    if (found.size() > kMostInFolder) return {};
  }
  std::ranges::sort(found);
  return found;
}

/// Colored, or grey in whole numbers: maps have one channel, and fractions mostly.
bool is_of_pictures(const ArrayEntry& entry) {
  if (!entry.is_of_views() || !entry.other_kind.empty() || has_other_name(entry)) return false;
  const std::size_t axes = entry.shape.size() - entry.leading.size();
  return axes == 3 || entry.type == NumberType::UInt8 || entry.type == NumberType::UInt16;
}

}  // namespace

bool is_folder_of_views(const fs::path& folder) {
  const std::vector<fs::path> arrays = arrays_in(folder);
  const bool are_maps = std::ranges::all_of(
      arrays, [](const fs::path& path) { return map_kind(path.stem().string()).has_value(); });
  if (are_maps) return false;
  const NumpyFile file(folder);
  return std::ranges::any_of(file.entries(), is_of_pictures);
}

bool is_numpy_file(const fs::path& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".npy" || suffix == ".npz" || begins_as_npy(path);
}

NumpyFile::NumpyFile(const fs::path& path)
    : ArrayFile(path, fs::is_directory(path)      ? "folder of NumPy arrays"
                      : suffix_of(path) == ".npz" ? "NumPy archive"
                                                  : "NumPy array") {
  if (fs::is_directory(path)) {
    for (const fs::path& one : arrays_in(path)) add_source({one.stem().string(), one, {}}, false);
    join_parts();
    return;
  }
  require_readable_file(path);
  if (suffix_of(path) == ".npz") {
    add_archive(path);
    return;
  }
  add_source({path.stem().string(), path, {}}, true);
  const std::string scene = lower_case(path.stem().string());
  for (const fs::path& map : maps_beside(path)) {
    const std::string name = map.stem().string();
    add_source({name, map, {}, name_beside(name, {scene})}, false);
  }
}

std::optional<Provenance> NumpyFile::estimated(const std::string& map) const {
  return map == "disparity" ? estimated_from_json(estimated_) : std::nullopt;
}

void NumpyFile::add_archive(const fs::path& path) {
  if (!has_zip_signature(path)) {
    throw IoError(path, "this is not an .npz file, despite its name; choose another file");
  }
  for (const ZipEntry& entry : list_zip(path)) {
    if (entry.name == kEstimatedFile && !entry.is_deflated && entry.stored < kLargestJson) {
      estimated_.resize(entry.stored);
      std::ifstream in(path, std::ios::binary);
      in.seekg(static_cast<std::streamoff>(entry.begin));
      in.read(estimated_.data(), static_cast<std::streamsize>(estimated_.size()));
    }
    if (!entry.name.ends_with(".npy")) continue;
    add_source({entry.name.substr(0, entry.name.size() - 4), path, entry}, false);
  }
  join_parts();
}

void NumpyFile::add_source(Source source, bool is_needed) {
  ArrayEntry entry{source.name, {}, {}, {}, {}, {}};
  entry.told = source.told;
  try {
    const NpyHeader header = source.zipped ? read_zipped_header(source.path, *source.zipped)
                                           : NpyFile(source.path).header();
    entry.shape = stored_shape(header);
    entry.type = header.type;
    entry.order = header.is_fortran ? IndexOrder::Fortran : IndexOrder::C;
  } catch (const IoError& error) {
    if (is_needed) throw;
    entry.other_kind = "no readable array of numbers";
  }
  add(std::move(entry));
  sources_.push_back(std::move(source));
}

std::unique_ptr<ArrayInput> NumpyFile::open_stored(const ArrayEntry& entry) const {
  const auto source = std::ranges::find(sources_, entry.name, &Source::name);
  if (!source->zipped) return std::make_unique<NpyFile>(source->path);
  require_plausible_size(path(), entry.shape, entry.type, source->zipped->stored);
  return open_zipped_npy(source->path, *source->zipped);
}

}  // namespace episcope::io
