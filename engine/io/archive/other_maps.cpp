// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/archive/other_maps.h"

#include "engine/io/archive/archive_names.h"
#include "engine/io/arrays/array_maps.h"
#include "engine/io/arrays/hdf5_arrays.h"
#include "engine/io/beside/map_name.h"
#include "engine/io/labels/label_list.h"

#include <algorithm>
#include <vector>

namespace episcope::io {
namespace {

constexpr const char* kTrueDepth = "GT_DEPTH";

/// Whether the archive, or Episcope, gives a dataset of this name its meaning.
bool is_of_archive(const std::string& name) {
  constexpr const char* kNames[] = {kTrueLabels, "SCRIBBLES", "LABELS", kValid};
  return name.starts_with("GT_DEPTH") || name.starts_with(kRegionPrefix) ||
         name.starts_with("estimate/") || std::ranges::find(kNames, name) != std::end(kNames);
}

}  // namespace

std::vector<FileUse> read_other_maps(const std::shared_ptr<const Hdf5Input>& file,
                                     const ArchiveLayout& layout, bool wants_labels,
                                     ArchiveParts parts, const Progress& progress) {
  const Hdf5Arrays arrays(file);
  const auto views = std::ranges::find(arrays.entries(), kArchiveLightField, &ArrayEntry::name);
  if (views == arrays.entries().end()) return {};
  const bool has_depth = !parts.truth.field.empty();
  const std::string depth = has_depth ? other_depth(*file, layout.shape) : "";
  std::vector<const ArrayEntry*> others;
  for (const ArrayEntry& entry : arrays.entries()) {
    const bool is_read = entry.name == depth ||
                         (is_of_archive(entry.name) && (has_depth || entry.name != kTrueDepth));
    if (&entry == &*views || is_read) continue;
    others.push_back(&entry);
  }
  const ArrayLayout axes{views->shape, layout.has_channel_axis ? "vuyxc" : "vuyx"};
  ArrayMaps maps = read_array_maps(arrays, others, {axes, views->order}, wants_labels, progress);
  if (!has_depth && !maps.truth.field.empty()) {
    settle_disparity(parts.samples, maps, maps.truth.field, parts.camera, parts.report);
    parts.truth.field = std::move(maps.truth.field);
    parts.expected.is_truth_sign_assumed = maps.is_sign_assumed;
  } else if (!maps.disparity_name.empty()) {
    const auto use = std::ranges::find(maps.uses, maps.disparity_name, &FileUse::example);
    *use = {"disparity maps, as there is depth", 1, maps.disparity_name, false};
  }
  if (parts.truth.labels.empty()) parts.truth.labels = std::move(maps.truth.labels);
  if (parts.valid.empty()) parts.valid = std::move(maps.valid);
  return maps.uses;
}

std::string other_depth(const Hdf5Input& file, const FieldShape& shape) {
  const auto length = [](int value) { return static_cast<std::size_t>(value); };
  const Hdf5Shape one{length(shape.height), length(shape.width)};
  const Hdf5Shape all{length(shape.grid.v), length(shape.grid.u), one[0], one[1]};
  std::vector<std::string> found;
  for (const Hdf5Dataset& dataset : file.datasets()) {
    const bool is_depth = map_kind(last_name(dataset.name)) == MapKind::Depth;
    const bool fits = dataset.shape == all || dataset.shape == one;
    if (is_depth && fits && !is_of_archive(dataset.name)) found.push_back(dataset.name);
  }
  return found.size() == 1 ? found.front() : "";
}

}  // namespace episcope::io
