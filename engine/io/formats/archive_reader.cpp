// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/archive_reader.h"

#include "engine/core/error.h"

#include "engine/core/finding.h"
#include "engine/io/base/json.h"
#include "engine/io/base/sample_range.h"
#include "engine/io/formats/archive_companions.h"
#include "engine/io/formats/archive_depth.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/models/array_samples.h"
#include "engine/io/models/assemble_scene.h"
#include "engine/io/models/estimated.h"
#include "engine/io/models/load_views.h"
#include "engine/io/models/order/view_axes.h"
#include "engine/io/models/sidecar_maps/map_name.h"
#include "engine/io/models/sidecar_maps/sidecar_maps.h"
#include "engine/io/models/stored_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <utility>

namespace episcope::io {
namespace {

/// What Episcope alone writes into a file of the archive form (write_scene.h). Each throws
/// IoError for a part that does not fit the light field, Cancelled.

/// Positions of the cameras and their unit, row by row as stored; unknown if there are none.
void read_positions(const Hdf5Input& file, GridShape grid, LightFieldInfo& info) {
  const std::vector<double> values = file.numbers("/", kPositions);
  if (values.empty()) return;
  const auto expected = 2 * static_cast<std::size_t>(grid.count());
  if (values.size() != expected) {
    throw IoError(file.path(), fmt::format("the attribute {} holds {} numbers, but {} are expected "
                                           "for {} views; correct or remove it",
                                           kPositions, values.size(), expected, grid.count()));
  }
  for (std::size_t i = 0; i < values.size(); i += 2) {
    info.positions.push_back({values[i], values[i + 1]});
  }
  info.position_unit = file.text("/", kPositionUnit).value_or("");
}

/// Positions by the distances of cameras side by side and one above the other, if they differ.
void add_positions(const Hdf5Input& file, GridShape grid, LightFieldInfo& info) {
  if (!info.positions.empty()) return;
  const double across = info.camera.baseline;
  const auto at_root = file.number("/", "dV");
  const double down = (at_root ? at_root : file.number("LF", "dV")).value_or(across);
  if (!(across > 0) || !(down > 0) || !std::isfinite(down) || down == across) return;
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i);
    info.positions.push_back({across * view.u, down * view.v});
  }
}

/// The mask of valid pixels as stored; empty if there is none.
ViewStack<std::uint8_t> read_valid(const Hdf5Input& file, const FieldShape& shape,
                                   const Progress& progress) {
  if (!file.has_numbers(kValid)) return {};
  const Hdf5Shape stored = file.dataset(kValid).shape;
  const Hdf5Shape one{static_cast<std::size_t>(shape.height),
                      static_cast<std::size_t>(shape.width)};
  // Of a single view it has the two axes of a map.
  if (stored.size() != 4 && !(shape.grid.count() == 1 && stored == one)) {
    throw IoError(file.path(), fmt::format("the dataset {} has the shape {}, but one mask for each "
                                           "view is expected; correct or remove it",
                                           kValid, shape_text(stored)));
  }
  return read_maps<std::uint8_t>(file, kValid, shape, progress);
}

/// Region masks by name.
std::map<std::string, Image<std::uint8_t>> read_regions(const Hdf5Input& file,
                                                        const FieldShape& shape) {
  std::map<std::string, Image<std::uint8_t>> regions;
  const Hdf5Shape expected{static_cast<std::size_t>(shape.height),
                           static_cast<std::size_t>(shape.width)};
  for (const Hdf5Dataset& dataset : file.datasets()) {
    if (!dataset.name.starts_with(kRegionPrefix) || dataset.name.find('/') != std::string::npos) {
      continue;  // files are named by regions
    }
    if (dataset.shape != expected) {
      throw IoError(file.path(),
                    fmt::format("the dataset {} has the shape {}, but {} is expected; "
                                "correct or remove it",
                                dataset.name, shape_text(dataset.shape), shape_text(expected)));
    }
    Image<std::uint8_t> mask(shape.height, shape.width);
    file.read(dataset.name, {{0, 0}, expected}, mask.data());
    regions.emplace(dataset.name.substr(std::strlen(kRegionPrefix)), std::move(mask));
  }
  return regions;
}

/// Labels and scribbles of an archive scene, in the stored order of views.
struct ArchiveLabels {
  ViewStack<std::int32_t> labels;
  Scribbles scribbles;
  std::optional<Provenance> estimated{};
};

bool contains_zero(const ViewStack<std::int32_t>& labels) {
  return !labels.empty() && std::find(labels.data(), labels.data() + labels.size(), 0) !=
                                labels.data() + labels.size();
}

/// Reads GT_LABELS and SCRIBBLES if present. Unpainted pixels (0, −1 or 255 in files)
/// become 0. Where 0 is a label and −1 or 255 means "none", labels and scribbles are raised by one,
/// which `report` tells. Throws IoError, Cancelled.
ArchiveLabels read_archive_labels(const Hdf5Input& file, const FieldShape& shape,
                                  ConventionReport& report, const Progress& progress) {
  ArchiveLabels found;
  if (file.has_numbers(kTrueLabels)) {
    found.labels = read_maps<std::int32_t>(file, kTrueLabels, shape, progress.part(0, 0.9));
    found.scribbles.labels = read_label_list(file, kTrueLabels);
    found.estimated = estimated_in(file, kTrueLabels);
  }
  if (!file.has_numbers("SCRIBBLES")) return found;
  StoredScribbles stored =
      read_scribble_dataset(file, shape, contains_zero(found.labels), progress.part(0.9, 1));
  if (stored.scribbles.labels.empty() && !stored.raises_labels) {
    stored.scribbles.labels = std::move(found.scribbles.labels);
  }
  found.scribbles = std::move(stored.scribbles);
  if (!stored.raises_labels) return found;
  report.raised_labels = true;
  std::for_each(found.labels.data(), found.labels.data() + found.labels.size(), raise_label);
  report.warnings.emplace_back(finding_text("labels.raised"));
  return found;
}

template <class T>
ViewStack<T> read_views(const Hdf5Input& file, const ArchiveLayout& layout,
                        const std::function<void(ImageView<const T>)>& on_center,
                        const Progress& progress) {
  const FieldShape& shape = layout.shape;
  ViewStack<T> stack(shape.grid, shape.height, shape.width, layout.channels);
  const auto read = [&](ViewIndex view) {
    Hdf5Block block{
        {static_cast<std::size_t>(view.v), static_cast<std::size_t>(view.u), 0, 0},
        {1, 1, static_cast<std::size_t>(shape.height), static_cast<std::size_t>(shape.width)}};
    if (layout.has_channel_axis) {
      block.start.push_back(0);
      block.count.push_back(static_cast<std::size_t>(layout.channels));
    }
    file.read(kArchiveLightField, block, stack.view(view).data);
  };
  const ViewIndex center = shape.grid.center();
  progress.check();
  if (shape.grid.count() > 1 && read_rows_of_views(file, kArchiveLightField, stack, progress)) {
    on_center(stack.view(center));
    return stack;
  }
  read(center);
  on_center(stack.view(center));
  if (shape.grid.count() > 1 && read_stored_views(file, kArchiveLightField, stack, progress)) {
    return stack;
  }
  for (int i = 0; i < shape.grid.count(); ++i) {
    progress.check();
    const ViewIndex view = shape.grid.view_at(i);
    if (!(view == center)) read(view);
    progress.report((i + 1.0) / shape.grid.count());
  }
  return stack;
}

/// Views that are better read from the file whenever they are looked at, if it stores them as they
/// are in memory. Floats are read: some of them may have to be changed.
template <class T>
std::optional<ViewStack<T>> map_views(const Hdf5Input& file, const ArchiveLayout& layout,
                                      const OpenOptions& options) {
  const FieldShape& shape = layout.shape;
  const Hdf5Shape stored = file.dataset(kArchiveLightField).shape;
  const bool has_all_channels =
      !layout.has_channel_axis || stored.back() == static_cast<std::size_t>(layout.channels);
  if (std::is_floating_point_v<T> || !has_all_channels || options.equalize ||
      !options.levels.empty())
    return std::nullopt;
  const std::size_t bytes = static_cast<std::size_t>(shape.grid.count()) * shape.height *
                            shape.width * layout.channels * sizeof(T);
  if (!is_better_mapped(static_cast<double>(bytes))) return std::nullopt;
  const auto offset = file.place_in_file<T>(kArchiveLightField);
  if (!offset) return std::nullopt;
  const auto map = [&](std::size_t size) { return large_part_of_file(file.path(), *offset, size); };
  return ViewStack<T>(shape.grid, shape.height, shape.width, layout.channels, {}, map);
}

/// 0 where a fourth channel is 0, an alpha. Empty if there is none, or if it is 0 nowhere, or
/// everywhere, as programs write that know no alpha.
ViewStack<std::uint8_t> read_alpha(const Hdf5Input& file, const ArchiveLayout& layout,
                                   const Progress& progress) {
  const FieldShape& shape = layout.shape;
  const Hdf5Shape stored = file.dataset(kArchiveLightField).shape;
  const auto channels = static_cast<std::size_t>(layout.channels);
  if (!layout.has_channel_axis || stored.back() != channels + 1) return {};
  ViewStack<std::uint8_t> valid(shape.grid, shape.height, shape.width);
  std::vector<float> alpha(valid.view_size());
  std::size_t seen = 0;
  for (int i = 0; i < shape.grid.count(); ++i) {
    progress.check();
    Hdf5Block block = view_block(stored, shape.grid.view_at(i));
    block.start.back() = channels;
    block.count.back() = 1;
    file.read(kArchiveLightField, block, alpha.data());
    std::ranges::transform(alpha, valid.view(shape.grid.view_at(i)).data, [&](float value) {
      seen += value != 0 ? 1 : 0;
      return static_cast<std::uint8_t>(value != 0);
    });
  }
  const bool tells = seen > 0 && seen < valid.size();
  return tells ? std::move(valid) : ViewStack<std::uint8_t>();
}

/// The samples of an archive file in the stored order of views and in their stored type; other
/// integers take the narrowest type that holds them. Those of a large light field
/// (is_better_mapped) stay in the file, if it stores them as an array of 8 or 16 bits that nothing
/// asks to change: they are there at once, and read when they are looked at. Shows the center view
/// (OpenOptions::on_center_view) with `info`. Throws IoError, Cancelled.
LightField::Samples read_archive_samples(const Hdf5Input& file, ArchiveLayout layout,
                                         const OpenOptions& options, const LightFieldInfo& info,
                                         const Progress& progress) {
  const auto read = [&]<class T>(T) -> LightField::Samples {
    const auto show = [&](ImageView<const T> center) {
      if (options.on_center_view && layout.type != Hdf5Type::Integer) {
        options.on_center_view(preview_rgb(center), info, layout.shape.grid);
      }
    };
    if (auto mapped = map_views<T>(file, layout, options)) {
      show(mapped->view(mapped->grid().center()));
      return std::move(*mapped);
    }
    return read_views<T>(file, layout, show, progress);
  };
  if (layout.type == Hdf5Type::UInt8) return read(std::uint8_t{});
  if (layout.type == Hdf5Type::UInt16) return read(std::uint16_t{});
  LightField::Samples samples = read(float{});
  if (layout.type == Hdf5Type::Integer) narrow(samples);
  return samples;
}

namespace fs = std::filesystem;

std::optional<Interval> stated_range(const Hdf5Input& file) {
  const auto min = file.number("/", "disp_min");
  const auto max = file.number("/", "disp_max");
  if (!min || !max || !(*min < *max)) return std::nullopt;
  return Interval{*min, *max};
}

/// Names datasets of the archive, and others that are named like maps, that are of no use.
void tell_faults(const Hdf5Input& file, ConventionReport& report) {
  std::set<std::string> names{"GT_DEPTH",
                              "GT_DEPTH_MASK",
                              "GT_DEPTH_FOREGROUND",
                              "GT_DEPTH_FOREGROUND_MASK",
                              "GT_DEPTH_BACKGROUND",
                              "GT_DEPTH_BACKGROUND_MASK",
                              kTrueLabels,
                              "SCRIBBLES",
                              kValid};
  for (const Hdf5Dataset& one : file.datasets()) {
    const bool is_of_pixels = one.type == Hdf5Type::Other && one.shape.size() > 1;
    if (is_of_pixels && map_kind(one.name)) names.insert(one.name);
  }
  for (const std::string& name : names) {
    const std::string fault = file.fault_of(name);
    if (!fault.empty())
      report.warnings.push_back(fmt::format(finding_text("dataset.left_out"), name, fault));
  }
}

/// Labels of the file or of the file beside it, whose use is noted.
ArchiveLabels read_labels(const Hdf5Input& file, const FieldShape& shape, ConventionReport& report,
                          FileUsage& account, const Progress& progress) {
  const bool has_own = file.has_numbers(kTrueLabels) || file.has_numbers("SCRIBBLES");
  ArchiveLabels own =
      has_own ? read_archive_labels(file, shape, report, progress) : ArchiveLabels();
  const fs::path beside = labels_beside(file.path());
  if (!is_there(beside)) return own;
  const Hdf5Input labels(beside);
  tell_faults(labels, report);
  // Where several light fields share a folder, labels that we wrote name theirs.
  const auto owner = labels.text("/", "light_field");
  if (owner && *owner != file.path().filename().string()) return own;
  if (!owner && !is_label_file_of(file.path(), beside)) {
    account.leave_out({beside}, "label files, as several light fields are there");
    return own;
  }
  if (!has_own) {
    account.use(beside, "label files");
    return read_archive_labels(labels, shape, report, progress);
  }
  // What was painted is saved beside the file and never into it.
  if (owner && labels.has_numbers("SCRIBBLES")) {
    account.use(beside, "scribble files");
    own.scribbles = read_scribble_dataset(labels, shape, false, progress).scribbles;
  }
  return own;
}

void tell_unused_depth(const ArchiveTruth& depth, bool has_disparity, ConventionReport& report) {
  if (depth.unused_depth.empty()) return;
  if (!has_disparity) {
    report.warnings.push_back(
        fmt::format(finding_text("depth.ignored"), depth.unused_depth, depth.camera_fault));
  } else if (depth.has_attributes) {
    report.warnings.push_back(fmt::format(finding_text("depth.camera_unused"), depth.camera_fault));
  }
}

StatedFacts read_stated(const Hdf5Input& file) {
  const auto text = [&](const char* name) { return file.text("/", name).value_or(""); };
  return {.origin = text(kOrigin), .samples = text(kSamples), .sign = text(kSign)};
}

/// For the report.
std::string group_text(const Hdf5Input& file) {
  return file.group().empty() ? std::string() : ", group " + file.group();
}

// Reads an archive step by step.
class ArchiveReading {
 public:
  ArchiveReading(const fs::path& path, const OpenOptions& options)
      : path_(path),
        options_(options),
        input_(open_archive_file(path)),
        layout_(archive_layout(file_)),
        account_(path.has_parent_path() ? path.parent_path() : fs::path(".")) {}

  Scene read(const Progress& progress) {
    begin_report();
    begin_info();
    progress.step("reading views");
    parts_.samples =
        read_archive_samples(file_, layout_, options_, parts_.info, progress.part(0, 0.45));
    show_epis(parts_.samples, options_);
    // Samples that stay in the file are read by the checks.
    const double read = is_mapped() ? 0.1 : 0.8;
    read_maps(progress.part(0, read));
    assemble(std::move(parts_), options_, scene_, progress.part(read, 1));
    settle_sign();
    settle_scribbles();
    add_companions();
    return std::move(scene_);
  }

 private:
  [[nodiscard]] bool is_mapped() const {
    return std::visit([](const auto& stack) { return stack.kind() == LargeKind::File; },
                      parts_.samples);
  }

  void begin_report() {
    report_.format =
        fmt::format(finding_text("format.archive"), path_.filename().string() + group_text(file_));
    report_.stated = read_stated(file_);
    if (!report_.stated.origin.empty()) report_.format += ", " + report_.stated.origin;
    compare_sizes(file_, report_);
    tell_faults(file_, report_);
    account_.use(path_, "light field");
  }
  void begin_info() {
    parts_.info = {scene_name(path_),
                   path_.string(),
                   read_camera(file_),
                   stated_range(file_),
                   {.reader = kArchiveReader, .options = {}}};
    read_positions(file_, layout_.shape.grid, parts_.info);
    add_positions(file_, layout_.shape.grid, parts_.info);
  }
  // What is stored beside the samples.
  void read_maps(const Progress& progress) {
    parts_.valid = read_valid(file_, layout_.shape, progress.part(0.55, 0.58));
    if (parts_.valid.empty()) parts_.valid = read_alpha(file_, layout_, progress.part(0.58, 0.6));
    if (!options_.levels.empty()) report_.stated.samples.clear();
    report_.samples = report_.stated.samples;
    if (report_.samples.empty()) settle_range(parts_.samples, options_.levels, report_);
    progress.step("reading depth");
    ArchiveTruth depth =
        read_archive_depth(file_, parts_.samples, options_, report_, progress.part(0.6, 0.85));
    GroundTruth& truth = parts_.truth;
    truth.field = std::move(depth.field);
    truth.foreground = std::move(depth.foreground);
    truth.background = std::move(depth.background);
    parts_.info.camera = depth.camera;
    progress.step("reading labels");
    if (options_.needs_truth) {
      truth.regions = read_regions(file_, layout_.shape);
      ArchiveLabels labels =
          read_labels(file_, layout_.shape, report_, account_, progress.part(0.85, 0.95));
      truth.labels = std::move(labels.labels);
      truth.labels_estimated = std::move(labels.estimated);
      if (truth.labels_estimated) {
        report_.warnings.push_back(
            fmt::format(finding_text("labels.estimated"), estimated_text(*truth.labels_estimated)));
      }
      scribbles_ = std::move(labels.scribbles);
    }
    parts_.expected = expected_order(file_);
    others_ = read_other_maps(input_, layout_, options_.needs_truth,
                              {parts_.samples, truth, parts_.valid, parts_.expected, report_},
                              progress.part(0.95, 0.98));
    tell_unused_depth(depth, !truth.field.empty(), report_);
    settle_truth(progress.part(0.98, 1));
  }
  // Maps of other files where the archive holds none; how they were estimated.
  void settle_truth(const Progress& progress) {
    GroundTruth& truth = parts_.truth;
    if (!truth.has_disparity() && !truth.has_layers()) {
      infos_ = add_maps_named_after(path_, options_, parts_, {account_, report_}, progress);
      return;
    }
    for (const char* name : {kTrueDepth, "GT_DEPTH_FOREGROUND"}) {
      if (!truth.estimated && file_.has_numbers(name)) truth.estimated = estimated_in(file_, name);
    }
    if (!truth.estimated || !options_.needs_truth) return;
    report_.warnings.push_back(
        fmt::format(finding_text("truth.estimated"), estimated_text(*truth.estimated)));
  }
  void settle_sign() {
    if (report_.order_was_chosen) report_.stated.sign.clear();
    if (report_.stated.sign.empty() || !report_.sign.empty()) return;
    report_.sign = "checked";
    report_.sign_check = report_.stated.sign;
  }
  void settle_scribbles() {
    if (scribbles_.labels.empty()) scribbles_.labels = std::move(infos_);
    put_in_order(scribbles_, layout_.shape.grid, flip_of(report_));
    if (report_.crop.leaves_out()) scribbles_ = cropped(std::move(scribbles_), report_.crop);
    scene_.scribbles = std::move(scribbles_);
  }
  void add_companions() {
    scene_.companions = find_companions(path_.parent_path(), *scene_.light_field, report_);
    for (const Companion& companion : scene_.companions) {
      account_.use(companion.path, companion_name(companion.kind));
    }
    report_.files = account_.uses();
    report_.files.insert(report_.files.end(), others_.begin(), others_.end());
  }

  const fs::path& path_;
  const OpenOptions& options_;
  std::shared_ptr<const Hdf5Input> input_;
  const Hdf5Input& file_ = *input_;
  ArchiveLayout layout_;
  FileUsage account_;
  SceneParts parts_;
  Scribbles scribbles_;
  std::vector<LabelInfo> infos_;
  std::vector<FileUse> others_;
  Scene scene_;
  ConventionReport& report_ = scene_.convention;
};

Scene read_archive(const std::filesystem::path& path, const OpenOptions& options,
                   const Progress& progress) {
  return ArchiveReading(path, options).read(progress);
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
    if (has_hdf5_name(entry.path()) && entry.is_regular_file(error) &&
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
  if (!has_hdf5_signature(path) && !has_hdf5_name(path)) return {};
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

constexpr const char* kArchiveOptions[] = {"flip", "crop", "units", "levels"};

}  // namespace

Reader archive_reader() {
  return {.id = kArchiveReader,
          .name = "a light field of the 2013 archive",
          .options = kArchiveOptions,
          .find = find_archive,
          .read = read_archive,
          .probe = probe_archive};
}

}  // namespace episcope::io
