// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/hdf5_array_reader.h"

#include "engine/core/text/suffix.h"
#include "engine/io/archive/archive_depth.h"
#include "engine/io/archive/archive_group.h"
#include "engine/io/archive/archive_layout.h"
#include "engine/io/arrays/array_scene.h"
#include "engine/io/arrays/choose_layout.h"
#include "engine/io/arrays/folder_file.h"
#include "engine/io/arrays/hdf5_arrays.h"
#include "engine/io/arrays/several_fields.h"
#include "engine/io/beside/map_name.h"
#include "engine/io/open/scene_folder.h"

#include <algorithm>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHdf5Reader = "hdf5";

/// Of three axes, with enough views to be no picture with channels.
bool is_list_of_views(const ArrayEntry& entry) {
  constexpr std::size_t kFewestViews = 4;
  const ArrayShape& shape = entry.shape;
  return shape.size() == 3 && std::min(shape.front(), shape.back()) >= kFewestViews;
}

/// `[v][h][y][x]` or `[v][h][y][x][c]`, whose reader also explains what is wrong with it.
bool is_archive_form(const ArrayEntry& light_field) {
  if (can_be_stack(light_field)) return false;
  if (!can_be_light_field(light_field)) return true;
  const std::size_t axes = light_field.shape.size();
  const std::string& stated = light_field.stated_axes;
  if (axes == 4 && stated.empty()) {
    return possible_layouts(light_field.shape, light_field.order).front().axes == "vuyx";
  }
  if (axes != 5) return !is_list_of_views(light_field);
  const std::size_t last = light_field.shape.back();
  return (last == 1 || last == 3 || last == 4) && (stated.empty() || stated.starts_with("v,u,y,x"));
}

/// Maps and results have fewer axes, too, but no colours, and names that tell what they are.
bool is_like_views(const ArrayEntry& entry) {
  if (can_be_stack(entry)) return !has_other_name(entry);
  if (entry.is_of_views()) return !map_kind(telling_name(entry));
  if (!can_be_light_field(entry)) return false;
  if (entry.shape.size() >= 5) return true;
  if (has_light_field_name(entry)) return entry.shape.size() == 4 || is_list_of_views(entry);
  const bool is_list = entry.shape.size() == 4 && entry.shape.back() == 3;
  const bool is_grey = (entry.shape.size() == 4 || is_list_of_views(entry)) &&
                       entry.type == NumberType::UInt8 && entry.name != "SCRIBBLES";
  return (is_list || is_grey) && !map_kind(telling_name(entry)) && !has_other_name(entry);
}

bool is_meant(const fs::path& path, const OpenOptions& options) {
  if (!has_hdf5_signature(path)) return false;
  const auto file = std::make_shared<const Hdf5Input>(path);
  if (!options.dataset.empty() || !options.axes.empty()) return true;
  // Results, and what lies beside a light field of the archive.
  if (file->has("estimate")) return false;
  if (!archive_group(*file).empty()) return false;
  const bool is_beside = path.filename() != "lf.h5" && is_there(path.parent_path() / "lf.h5");
  const Hdf5Arrays arrays(file);
  const auto& entries = arrays.entries();
  const auto light_field = std::ranges::find(entries, "LF", &ArrayEntry::name);
  if (light_field != entries.end()) return !is_beside && !is_archive_form(*light_field);
  return std::ranges::any_of(entries, [&](const ArrayEntry& entry) {
    return is_like_views(entry) && (!is_beside || has_light_field_name(entry));
  });
}

bool has_hdf5_name(const fs::path& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".h5" || suffix == ".hdf5";
}

fs::path find_hdf5_array(const fs::path& path, const OpenOptions& options) {
  if (!fs::is_directory(path)) return is_meant(path, options) ? path : fs::path();
  const fs::path file = only_file_in(path, has_hdf5_name);
  return !file.empty() && is_meant(file, options) ? file : fs::path();
}

/// Depth and camera of an archive file whose light field has other axes than the archive's, as
/// where MATLAB wrote it.
OtherArrays archive_depth(const Hdf5Input& file, const OpenOptions& options) {
  if (!file.has("GT_DEPTH") || !read_camera(file).is_known()) return {};
  const auto add = [&file, options](SceneParts& parts, ConventionReport& report,
                                    const Progress& progress) {
    const bool fits = holds_maps(file, "GT_DEPTH", field_shape(parts.samples));
    parts.files.push_back({kind_text(MapKind::Depth), 1, "GT_DEPTH", fits});
    if (!fits) return;
    ArchiveTruth truth = read_archive_depth(file, parts.samples, options, report, progress);
    parts.truth.field = std::move(truth.field);
    parts.info.camera = truth.camera;
    parts.expected = expected_order(file);
    parts.expected.are_axes_known = false;
  };
  return {[](const ArrayEntry& entry) { return entry.name.starts_with("GT_DEPTH"); }, add};
}

Scene read_hdf5_array(const fs::path& path, const OpenOptions& options, const Progress& progress) {
  const auto input = std::make_shared<const Hdf5Input>(path);
  return read_array_scene(Hdf5Arrays(input), kHdf5Reader, options, progress,
                          archive_depth(*input, options));
}

SceneProbe probe_hdf5_array(const fs::path& path, const OpenOptions& options) {
  return probe_arrays(Hdf5Arrays(std::make_shared<const Hdf5Input>(path)), options);
}

}  // namespace

Reader hdf5_array_reader() {
  return {.id = kHdf5Reader,
          .name = "an array of an HDF5 file",
          .options = array_options(),
          .find = find_hdf5_array,
          .read = read_hdf5_array,
          .probe = probe_hdf5_array};
}

}  // namespace episcope::io
