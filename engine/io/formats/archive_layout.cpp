// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/archive_layout.h"

#include "engine/core/error.h"
#include "engine/io/models/label_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace episcope::io {
namespace {

bool has_archive_form(const Hdf5Dataset& dataset) {
  const std::size_t axes = dataset.shape.size();
  if (dataset.type == Hdf5Type::Other || axes < 4 || axes > 5) return false;
  const std::size_t last = dataset.shape.back();
  return axes == 4 || last == 1 || last == 3 || last == 4;
}

bool has_depth(const Hdf5Input& file, const std::string& group) {
  return file.has(group + "/GT_DEPTH") ||
         (file.has(group + "/GT_DEPTH_FOREGROUND") && file.has(group + "/GT_DEPTH_BACKGROUND"));
}

}  // namespace

std::string archive_group(const Hdf5Input& file) {
  if (file.has(kArchiveLightField)) return {};
  const std::string end = std::string("/") + kArchiveLightField;
  std::vector<std::string> groups;
  for (const Hdf5Dataset& dataset : file.datasets()) {
    if (!dataset.name.ends_with(end) || !has_archive_form(dataset)) continue;
    groups.push_back(dataset.name.substr(0, dataset.name.size() - end.size()));
  }
  const bool is_one = groups.size() == 1 && has_depth(file, groups.front());
  return is_one ? groups.front() : std::string();
}

std::shared_ptr<const Hdf5Input> open_archive_file(const std::filesystem::path& path) {
  auto file = std::make_shared<const Hdf5Input>(path);
  const std::string group = archive_group(*file);
  return group.empty() ? file : std::make_shared<const Hdf5Input>(path, group);
}

namespace {

namespace fs = std::filesystem;

std::string whole(double value) {
  return std::isfinite(value) ? std::to_string(std::llround(value)) : "NaN";
}

std::optional<SampleType> sample_type(Hdf5Type type) {
  if (type == Hdf5Type::UInt8) return SampleType::UInt8;
  if (type == Hdf5Type::UInt16) return SampleType::UInt16;
  if (type == Hdf5Type::Float) return SampleType::Float32;
  return std::nullopt;  // decided by the samples
}

/// "all views" or "the center view" of a dataset; empty if there is none.
std::string covered(const Hdf5Input& file, const char* dataset) {
  if (!file.has(dataset)) return {};
  return file.dataset(dataset).shape.size() > 2 ? "all views" : "the center view";
}

std::string truth_of(const Hdf5Input& file) {
  if (const std::string views = covered(file, "GT_DEPTH"); !views.empty()) {
    return "depth of " + views;
  }
  const bool has_layers = file.has("GT_DEPTH_FOREGROUND") && file.has("GT_DEPTH_BACKGROUND");
  return has_layers ? "depth of two layers" : "";
}

std::string labels_of(const Hdf5Input& file) {
  const std::string views = covered(file, kTrueLabels);
  const std::string labels = views.empty() ? "" : "labels of " + views;
  if (!file.has("SCRIBBLES")) return labels;
  return labels.empty() ? "scribbles" : labels + ", scribbles";
}

/// Labels of the file itself, or of the file beside it unless that belongs to another file.
std::string labels_with(const Hdf5Input& file) {
  if (const std::string own = labels_of(file); !own.empty()) return own;
  const fs::path beside = labels_beside(file.path());
  if (!has_hdf5_signature(beside)) return {};
  const Hdf5Input labels(beside);
  const auto owner = labels.text("/", "light_field");
  return owner && *owner != file.path().filename().string() ? "" : labels_of(labels);
}

}  // namespace

ArchiveLayout archive_layout(const Hdf5Input& file) {
  const Hdf5Dataset dataset =
      file.dataset(kArchiveLightField,
                   "choose another file, or name the dataset of a light field with --dataset, with "
                   "--mosaic views and --grid 9x9 if it holds all views in one picture");
  const Hdf5Shape& shape = dataset.shape;
  if (shape.size() != 4 && shape.size() != 5) {
    throw IoError(file.path(), fmt::format("the dataset LF has {} axes ({}), but v × h × y × x × "
                                           "channels is expected; store it in this form",
                                           shape.size(), shape_text(shape)));
  }
  if (dataset.type == Hdf5Type::Other) {
    throw IoError(file.path(), "the dataset LF holds no numbers; choose another file");
  }
  const auto is_odd = [](std::size_t length) { return length == 0 || length > 100000; };
  if (std::any_of(shape.begin(), shape.end(), is_odd)) {
    throw IoError(file.path(), "the dataset LF has the shape " + shape_text(shape) +
                                   ", which is not that of a light field; choose another file");
  }
  const std::size_t channels = shape.size() == 5 ? shape[4] : 1;
  const double stated = file.number("/", "channels").value_or(1);
  if (shape.size() == 4 && stated != 1) {
    throw IoError(file.path(), "the dataset LF has 4 axes (" + shape_text(shape) +
                                   "), but the attribute channels says " + whole(stated) +
                                   "; store it as v × h × y × x × channels");
  }
  if (channels != 1 && channels != 3 && channels != 4) {
    throw IoError(file.path(),
                  fmt::format("the dataset LF has the shape {} and so {} channels, but 1 (grey) or "
                              "3 (RGB) are expected; store it in this form",
                              shape_text(shape), channels));
  }
  const auto length = [&](std::size_t axis) { return static_cast<int>(shape[axis]); };
  return {{{length(0), length(1)}, length(2), length(3)},
          channels == 1 ? 1 : 3,
          shape.size() == 5,
          dataset.type};
}

void compare_sizes(const Hdf5Input& file, ConventionReport& report) {
  const Hdf5Shape shape = file.dataset(kArchiveLightField).shape;
  constexpr const char* names[] = {"vRes", "hRes", "yRes", "xRes", "channels"};
  for (std::size_t axis = 0; axis < shape.size(); ++axis) {
    const auto stated = file.number("/", names[axis]);
    if (!stated || *stated == static_cast<double>(shape[axis])) continue;
    report.warnings.push_back(fmt::format(
        "The attribute {} says {}, but LF has {} along that axis; the shape of LF is used.",
        names[axis], whole(*stated), shape[axis]));
  }
}

ExpectedOrder expected_order(const Hdf5Input& file) {
  if (file.text("/", "convention") || file.text(kArchiveLightField, "convention")) {
    return {{}, "the file states its order in the attribute convention", true};
  }
  const bool is_raw = file.number("/", "dH") && file.number("/", "shift");
  if (is_raw) return {{true, false}, "raw files of the archive store h reversed"};
  return {{}, "the file has no attributes of the archive"};
}

SceneProbe probe_archive(const fs::path& path, const OpenOptions&) {
  const std::shared_ptr<const Hdf5Input> input = open_archive_file(path);
  const Hdf5Input& file = *input;
  if (!file.has(kArchiveLightField)) throw NoLightField(path, "this file holds no light field");
  const ArchiveLayout layout = archive_layout(file);
  return {.grid = layout.shape.grid,
          .height = layout.shape.height,
          .width = layout.shape.width,
          .channels = layout.channels,
          .sample_type = sample_type(layout.type),
          .truth = truth_of(file),
          .labels = labels_with(file)};
}

}  // namespace episcope::io
