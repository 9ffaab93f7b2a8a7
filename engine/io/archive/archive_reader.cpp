// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/archive/archive_reader.h"

#include "engine/core/error.h"
#include "engine/core/text/suffix.h"
#include "engine/io/archive/archive_depth.h"
#include "engine/io/archive/archive_extras.h"
#include "engine/io/archive/archive_group.h"
#include "engine/io/archive/archive_labels.h"
#include "engine/io/archive/archive_layout.h"
#include "engine/io/archive/archive_samples.h"
#include "engine/io/archive/companions.h"
#include "engine/io/archive/other_maps.h"
#include "engine/io/labels/label_list.h"
#include "engine/io/labels/scribble_dataset.h"
#include "engine/io/maps/sample_range.h"
#include "engine/io/open/assemble_scene.h"
#include "engine/io/open/folder_account.h"
#include "engine/io/open/scene_folder.h"
#include "engine/io/open/scene_name.h"
#include "engine/io/open/view_crop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

std::string whole(double value) {
  return std::isfinite(value) ? std::to_string(std::llround(value)) : "NaN";
}

/// Sizes in attributes only repeat the shape of LF; one that differs speaks for a mistake.
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

std::optional<Interval> stated_range(const Hdf5Input& file) {
  const auto min = file.number("/", "disp_min");
  const auto max = file.number("/", "disp_max");
  if (!min || !max || !(*min < *max)) return std::nullopt;
  return Interval{*min, *max};
}

/// Labels of the file or of labels.h5 beside it, whose use is noted.
ArchiveLabels read_labels(const Hdf5Input& file, const FieldShape& shape, ConventionReport& report,
                          FolderAccount& account, const Progress& progress) {
  const bool has_own = file.has(kTrueLabels) || file.has("SCRIBBLES");
  ArchiveLabels own =
      has_own ? read_archive_labels(file, shape, report, progress) : ArchiveLabels();
  const fs::path beside = file.path().parent_path() / "labels.h5";
  if (!is_there(beside)) return own;
  const Hdf5Input labels(beside);
  // Where several light fields share a folder, labels that we wrote name theirs.
  const auto owner = labels.text("/", "light_field");
  if (owner && *owner != file.path().filename().string()) return own;
  if (!has_own) {
    account.use(beside, "label files");
    return read_archive_labels(labels, shape, report, progress);
  }
  // What was painted is saved beside the file and never into it.
  if (owner && labels.has("SCRIBBLES")) {
    account.use(beside, "scribble files");
    own.scribbles = read_scribble_dataset(labels, shape, false, progress).scribbles;
  }
  return own;
}

void tell_unused_depth(const ArchiveTruth& depth, bool has_disparity, ConventionReport& report) {
  if (depth.unused_depth.empty()) return;
  if (!has_disparity) {
    report.warnings.push_back(depth.unused_depth + " is ignored because " + depth.camera_fault +
                              ".");
  } else if (depth.has_attributes) {
    report.warnings.push_back("The camera of the file is not used: " + depth.camera_fault + ".");
  }
}

/// For the report.
std::string group_text(const Hdf5Input& file) {
  return file.group().empty() ? std::string() : ", group " + file.group();
}

Scene read_archive(const std::filesystem::path& path, const OpenOptions& options,
                   const Progress& progress) {
  const auto input = open_archive(path);
  const Hdf5Input& file = *input;
  const ArchiveLayout layout = archive_layout(file);
  const GridShape grid = layout.shape.grid;
  Scene scene;
  ConventionReport& report = scene.convention;
  report.format = "archive (" + path.filename().string() + group_text(file) + ")";
  compare_sizes(file, report);
  LightFieldInfo info{scene_name(path),
                      path.string(),
                      read_camera(file),
                      stated_range(file),
                      {.reader = kArchiveReader, .options = {}}};

  read_positions(file, grid, info);
  progress.step("reading views");
  LightField::Samples samples =
      read_archive_samples(file, layout, options, info, progress.part(0, 0.55));
  ViewStack<std::uint8_t> valid = read_valid(file, layout.shape, progress.part(0.55, 0.6));
  settle_range(samples, options.levels, report);
  progress.step("reading depth");
  ArchiveTruth depth = read_archive_depth(file, samples, options, report, progress.part(0.6, 0.85));
  progress.step("reading labels");
  ArchiveLabels labels;
  FolderAccount account(path.has_parent_path() ? path.parent_path() : fs::path("."));
  account.use(path, "light field");
  std::map<std::string, Image<std::uint8_t>> regions;
  if (options.needs_truth) {
    regions = read_regions(file, layout.shape);
    labels = read_labels(file, layout.shape, report, account, progress.part(0.85, 0.95));
  }
  GroundTruth truth{std::move(depth.field), std::move(depth.foreground),
                    std::move(depth.background), std::move(labels.labels), std::move(regions)};
  info.camera = depth.camera;
  ExpectedOrder expected = expected_order(file);
  const std::vector<FileUse> others = read_other_maps(
      input, layout, options.needs_truth, {samples, truth, valid, info.camera, expected, report},
      progress.part(0.95, 0.97));
  tell_unused_depth(depth, !truth.field.empty(), report);
  assemble({.samples = std::move(samples),
            .truth = std::move(truth),
            .info = std::move(info),
            .expected = std::move(expected),
            .valid = std::move(valid)},
           options, scene, progress);
  scene.scribbles = std::move(labels.scribbles);
  put_in_order(scene.scribbles, grid, flip_of(report));
  if (report.crop.leaves_out()) {
    scene.scribbles = cropped(std::move(scene.scribbles), report.crop);
  }
  scene.companions = find_companions(path.parent_path(), *scene.light_field, report);
  for (const Companion& companion : scene.companions) {
    account.use(companion.path, companion_name(companion.kind));
  }
  report.files = account.uses();
  report.files.insert(report.files.end(), others.begin(), others.end());
  return scene;
}

bool is_hdf5_name(const fs::path& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".h5" || suffix == ".hdf5";
}

bool holds_archive(const Hdf5Input& file) {
  return file.has(kArchiveLightField) || !archive_group(file).empty();
}

/// The HDF5 file of a folder that holds a light field; empty if there is none, or several without
/// an lf.h5.
fs::path file_in(const fs::path& folder) {
  if (is_there(folder / "lf.h5")) return folder / "lf.h5";
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (is_hdf5_name(entry.path()) && entry.is_regular_file(error) &&
        has_hdf5_signature(entry.path())) {
      files.push_back(entry.path());
    }
  }
  std::erase_if(files, [](const fs::path& path) { return !holds_archive(Hdf5Input(path)); });
  return files.size() == 1 ? files.front() : fs::path();
}

fs::path find_archive(const fs::path& path, const OpenOptions&) {
  if (const fs::path folder = scene_folder(path); !folder.empty()) {
    // An image is a picture of the scene that it lies in, not of any light field beside it.
    return fs::is_directory(path) || is_there(folder / "lf.h5") ? file_in(folder) : fs::path();
  }
  if (!has_hdf5_signature(path) && !is_hdf5_name(path)) return {};
  const Hdf5Input file(path);
  if (holds_archive(file)) return path;
  if (file.has("estimate")) {
    throw IoError(path,
                  "this file holds a disparity result, not a light field; open the light field "
                  "that it belongs to");
  }
  // Labels, depth or a companion: the light field lies beside it.
  const fs::path beside = path.parent_path() / "lf.h5";
  return is_there(beside) ? beside : path;
}

constexpr const char* kOptions[] = {"flip", "crop", "units", "levels"};

}  // namespace

Reader archive_reader() {
  return {.id = kArchiveReader,
          .name = "a light field of the 2013 archive",
          .options = kOptions,
          .find = find_archive,
          .read = read_archive,
          .probe = probe_archive};
}

}  // namespace episcope::io
