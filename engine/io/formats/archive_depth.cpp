// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/archive_depth.h"

#include "engine/core/camera_grid.h"
#include "engine/core/error.h"

#include "engine/core/finding.h"
#include "engine/core/indices.h"
#include "engine/core/parallel.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/models/array_file.h"
#include "engine/io/models/array_maps.h"
#include "engine/io/models/order/warp_check.h"
#include "engine/io/models/result_file.h"
#include "engine/io/models/scribble_file.h"
#include "engine/io/models/sidecar_maps/map_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>

namespace episcope::io {
namespace {

/// Whether the archive, or Episcope, gives a dataset of this name its meaning.
bool is_of_archive(const std::string& name) {
  constexpr const char* kNames[] = {kTrueLabels, "SCRIBBLES", "LABELS", kValid};
  return name.starts_with("GT_DEPTH") || name.starts_with(kRegionPrefix) ||
         name.starts_with("estimate/") || std::ranges::find(kNames, name) != std::end(kNames);
}

/// The name of the only dataset that holds depth of all views or of one by its name and shape, but
/// is not the archive's; empty if there is none.
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
  // What `write_archive` put beside depth.
  const auto repeats_depth = [&](const std::string& name) {
    return name.starts_with(kTrueDisparity) &&
           file->has(kTrueDepth + name.substr(std::string(kTrueDisparity).size()));
  };
  for (const ArrayEntry& entry : arrays.entries()) {
    const bool is_read = repeats_depth(entry.name) || entry.name == depth ||
                         (is_of_archive(entry.name) && (has_depth || entry.name != kTrueDepth));
    if (&entry == &*views || is_read) continue;
    others.push_back(&entry);
  }
  const ArrayLayout axes{views->shape, layout.has_channel_axis ? "vuyxc" : "vuyx"};
  ArrayMaps maps = read_array_maps(arrays, others, {axes, views->order}, wants_labels, progress);
  std::ranges::move(maps.notes, std::back_inserter(parts.report.warnings));
  if (!has_depth && !maps.truth.field.empty()) {
    settle_disparity(parts.samples, maps, maps.truth.field, parts.report);
    parts.truth.field = std::move(maps.truth.field);
    parts.expected.is_truth_sign_assumed = maps.is_sign_assumed;
  } else if (!maps.disparity_name.empty()) {
    const auto use = std::ranges::find(maps.uses, maps.disparity_name, &FileUse::example);
    *use = {"disparity maps, as there is depth", 1, maps.disparity_name, false};
  }
  if (parts.truth.labels.empty()) parts.truth.labels = std::move(maps.truth.labels);
  if (parts.valid.empty()) parts.valid = std::move(maps.valid);
  parts.truth.regions.merge(maps.truth.regions);
  return maps.uses;
}

namespace {

/// What is known about the depth before its units are settled.
struct DepthFacts {
  CameraGrid stored;  ///< dH, focalLength, shift, camDistance as the file has them.
  int width = 0;      ///< xRes.
  Interval depth;     ///< Range of the valid depth of the reference view.
};

struct UnitsFinding {
  CameraGrid camera;  ///< Gives px per view step.
  std::string text;   ///< As ConventionReport::units,
  std::string check;  ///< and `units_check`.
  std::vector<std::string> warnings;
};

constexpr double kPlausibleDisparity = 20;

struct UnitReading {
  CameraGrid camera;
  std::string name;
  bool has_width = true;  ///< dH is taken to hold the factor xRes.
  Interval disparity;
  double error = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool is_plausible() const {
    return std::max(std::abs(disparity.min), std::abs(disparity.max)) < kPlausibleDisparity;
  }
};

std::string number(double value) {
  return fmt::format("{:.4g}", value);
}

/// Depth where d = 0, infinite for a shift of 0.
double zero_depth(const CameraGrid& camera) {
  return camera.shift > 0 ? camera.baseline * camera.focal_length / camera.shift
                          : std::numeric_limits<double>::infinity();
}

bool holds_zero_depth(const UnitReading& reading, const Interval& depth) {
  const double zero = zero_depth(reading.camera);
  const double margin = 0.1 * depth.length() + 1e-9;
  return zero > depth.min - margin && zero < depth.max + margin;
}

std::vector<UnitReading> readings(const DepthFacts& facts) {
  const auto scaled = [&](double baseline, double shift) {
    CameraGrid camera = facts.stored;
    camera.baseline *= baseline;
    camera.shift *= shift;
    return camera;
  };
  const double width = facts.width;
  std::vector<UnitReading> all{
      {scaled(1, 1), std::string(finding_text("units.as_stored")), true, {}},
      {scaled(width, width), std::string(finding_text("units.width")), false, {}},
      {scaled(width, 1), std::string(finding_text("units.width_of_dh")), false, {}}};
  for (UnitReading& one : all) {
    one.disparity = {one.camera.disparity_from_depth(facts.depth.max),
                     one.camera.disparity_from_depth(facts.depth.min)};
  }
  return all;
}

/// Keeps the readings that satisfy a claim, or all if none does.
template <class Claim>
void prefer(std::vector<UnitReading>& readings, const Claim& claim) {
  if (std::any_of(readings.begin(), readings.end(), claim)) {
    std::erase_if(readings, [&](const UnitReading& one) { return !claim(one); });
  }
}

const UnitReading& best_by_warping(std::vector<UnitReading>& readings,
                                   const std::function<double(const CameraGrid&)>& warp_error) {
  if (readings.size() == 1) return readings.front();
  for (UnitReading& one : readings) one.error = warp_error(one.camera);
  const UnitReading* best = &readings.front();
  for (const UnitReading& one : readings) {
    if (one.error < 0.97 * best->error) best = &one;
  }
  return *best;
}

/// Determines whether dH and shift include the factor xRes: of the readings that give |d| < 20 px
/// and, if any does, a depth of zero disparity inside the depth range, the one that warps the views
/// onto each other best. `warp_error(camera)` is in grey levels.
UnitsFinding find_units(const DepthFacts& facts, Units choice,
                        const std::function<double(const CameraGrid&)>& warp_error) {
  std::vector<UnitReading> all = readings(facts);
  if (choice != Units::Auto) {
    std::erase_if(
        all, [&](const UnitReading& one) { return one.has_width != (choice == Units::WithWidth); });
  }
  prefer(all, [](const UnitReading& one) { return one.is_plausible(); });
  prefer(all, [&](const UnitReading& one) { return holds_zero_depth(one, facts.depth); });
  const UnitReading& taken = best_by_warping(all, warp_error);

  UnitsFinding finding{taken.camera, {}, {}, {}};
  finding.text =
      fmt::format(finding_text("units.stored"), taken.name, number(taken.disparity.min),
                  number(taken.disparity.max), number(facts.depth.min), number(facts.depth.max));
  if (std::isfinite(taken.error)) {
    finding.check = fmt::format(finding_text("depth.by_warping"), number(taken.error));
  }
  if (!taken.is_plausible()) {
    finding.warnings.push_back(fmt::format(finding_text("depth.implausible"),
                                           number(taken.disparity.min),
                                           number(taken.disparity.max)));
  }
  return finding;
}

/// Where camDistance contradicts dH·focalLength/shift, the latter becomes the depth of zero
/// disparity, since disparity is computed by it, and a warning says so.
void settle_zero_depth(CameraGrid& camera, ConventionReport& report) {
  if (!camera.is_known() || !camera.cam_distance) return;
  const double zero = zero_depth(camera);
  if (std::abs(zero - *camera.cam_distance) < 0.01 * *camera.cam_distance) return;
  const std::string stated = number(*camera.cam_distance);
  report.warnings.push_back(
      std::isfinite(zero) ? fmt::format(finding_text("depth.camera_distance"), number(zero), stated)
                          : fmt::format(finding_text("depth.no_camera_distance"), stated));
  camera.cam_distance.reset();
  if (std::isfinite(zero)) camera.cam_distance = zero;
}

DepthMaps read_depth(const Hdf5Input& file, const std::string& name, const FieldShape& shape,
                     MapViews views, const Progress& progress) {
  DepthMaps maps;
  if (!file.has_numbers(name)) return maps;
  maps.name = name;
  maps.depth = read_maps<float>(file, name, shape, progress.part(0, 0.8), views);
  if (file.has_numbers(name + "_MASK")) {
    maps.mask = read_maps<std::uint8_t>(file, name + "_MASK", shape, progress.part(0.8, 1), views);
  }
  return maps;
}

constexpr const char* kCameraNames[] = {"dH", "focalLength", "shift"};

/// On the root or on LF.
std::optional<double> camera_number(const Hdf5Input& file, const char* name) {
  const auto value = file.number("/", name);
  return value ? value : file.number("LF", name);
}

/// The attributes that turn depth into disparity, whatever they mean.
CameraGrid stored_camera(const Hdf5Input& file) {
  CameraGrid camera;
  camera.baseline = camera_number(file, "dH").value_or(0);
  camera.focal_length = camera_number(file, "focalLength").value_or(0);
  camera.cam_distance = camera_number(file, "camDistance");
  if (camera.cam_distance && !(*camera.cam_distance > 0 && std::isfinite(*camera.cam_distance))) {
    camera.cam_distance.reset();
  }
  const double from_distance =
      camera.cam_distance ? camera.baseline * camera.focal_length / *camera.cam_distance : 0;
  camera.shift = camera_number(file, "shift").value_or(from_distance);
  camera.pinhole = camera_in(file, "/").pinhole;
  const bool is_finite = std::isfinite(camera.baseline) && std::isfinite(camera.focal_length) &&
                         std::isfinite(camera.shift);
  return is_finite ? camera : CameraGrid{};
}

/// Why depth cannot be turned into disparity.
std::string camera_fault(const Hdf5Input& file) {
  for (const char* name : kCameraNames) {
    const std::string attribute = std::string("the attribute ") + name;
    const auto value = camera_number(file, name);
    if (value && !std::isfinite(*value)) return attribute + " is not a finite number; correct it";
    if (!value && (file.has_attribute("/", name) || file.has_attribute("LF", name))) {
      return attribute + " is not a single number; store it as one";
    }
  }
  if (camera_number(file, "dH") && camera_number(file, "focalLength")) {
    return "dH and focalLength must be positive; correct these attributes";
  }
  return "the file lacks the attributes dH and focalLength that turn depth into disparity";
}

/// `write_archive` states so where it had to make up attributes to hold disparity as depth.
bool states_no_camera(const Hdf5Input& file) {
  return file.text("/", "camera").value_or("").starts_with("unknown");
}

/// Units as chosen; a file that states its formula, as `write_archive` does, leaves no choice.
CameraGrid settle(const Hdf5Input& file, const DepthMaps& maps, const LightField::Samples& samples,
                  const CameraGrid& stored, Units choice, ConventionReport& report) {
  const bool is_stated = file.text("/", kConvention) == kConventionText;
  if (choice != Units::Auto || !is_stated) {
    return settle_units(maps, samples, stored, choice, report);
  }
  const CameraGrid camera = settle_units(maps, samples, stored, Units::WithWidth, report);
  report.units_were_chosen = false;
  report.units_check = "the file states this formula";
  return camera;
}

/// Of two layers both are needed to tell a transparent surface from what lies behind it.
void drop_single_layer(ArchiveTruth& truth, ConventionReport& report) {
  if (truth.foreground.empty() == truth.background.empty()) return;
  const bool lacks_foreground = truth.foreground.empty();
  report.warnings.push_back(
      fmt::format(finding_text("depth.no_layer"),
                  lacks_foreground ? "GT_DEPTH_BACKGROUND" : "GT_DEPTH_FOREGROUND",
                  lacks_foreground ? "GT_DEPTH_FOREGROUND" : "GT_DEPTH_BACKGROUND"));
  truth.foreground = {};
  truth.background = {};
}

void note_unused(const Hdf5Input& file, const std::string& name, ArchiveTruth& truth) {
  truth.unused_depth = name;
  truth.camera_fault = camera_fault(file);
  truth.has_attributes = std::ranges::any_of(kCameraNames, [&](const char* attribute) {
    return file.has_attribute("/", attribute) || file.has_attribute("LF", attribute);
  });
}

}  // namespace

CameraGrid read_camera(const Hdf5Input& file) {
  return states_no_camera(file) ? CameraGrid{} : stored_camera(file);
}

ArchiveTruth read_archive_depth(const Hdf5Input& file, const LightField::Samples& samples,
                                const OpenOptions& options, ConventionReport& report,
                                const Progress& progress) {
  const FieldShape shape = field_shape(samples);
  ArchiveTruth truth;
  truth.camera = stored_camera(file);
  const auto read = [&](const char* name, double begin, double end) {
    return read_depth(file, name, shape, options.map_views(), progress.part(begin, end));
  };
  const std::string other = file.has_numbers("GT_DEPTH") ? "" : other_depth(file, shape);
  DepthMaps field = read(other.empty() ? "GT_DEPTH" : other.c_str(), 0, 0.7);
  DepthMaps foreground = read("GT_DEPTH_FOREGROUND", 0.7, 0.8);
  DepthMaps background = read("GT_DEPTH_BACKGROUND", 0.8, 0.9);
  const DepthMaps& reference =
      !field.empty() ? field : (!background.empty() ? background : foreground);
  if (reference.empty()) {
    report.units = "no depth in this file";
    truth.camera = read_camera(file);
    settle_zero_depth(truth.camera, report);
    return truth;
  }
  if (!truth.camera.is_known()) {
    report.units = "depth ignored";
    note_unused(file, reference.name, truth);
    return truth;
  }
  truth.camera = settle(file, reference, samples, truth.camera, options.units, report);
  if (is_column_major(file, reference.name, shape)) {
    report.units += ", stored with all axes in the opposite order, as MATLAB writes arrays";
  }
  const auto finish = [&](DepthMaps& maps, double from) {
    return maps.empty() ? DisparityField{}
                        : disparity_from_depth(std::move(maps), truth.camera, report,
                                               progress.part(from, from + 0.03));
  };
  truth.field = finish(field, 0.9);
  truth.foreground = finish(foreground, 0.93);
  truth.background = finish(background, 0.96);
  drop_single_layer(truth, report);
  if (states_no_camera(file)) truth.camera = {};
  settle_zero_depth(truth.camera, report);
  return truth;
}

namespace {

/// The view whose neighbors tell most: the center, or another if depth is there only.
ViewIndex reference_view(const DepthMaps& maps, GridShape grid) {
  return maps.depth.contains(grid.center()) ? grid.center() : maps.depth.first();
}

Interval depth_range(const DepthMaps& maps, ViewIndex view) {
  Interval range{std::numeric_limits<double>::infinity(), 0};
  for (int y = 0; y < maps.depth.height(); ++y) {
    for (int x = 0; x < maps.depth.width(); ++x) {
      if (!maps.is_valid(view, y, x)) continue;
      const double z = maps.depth.view(view).at(y, x);
      range = {std::min(range.min, z), std::max(range.max, z)};
    }
  }
  return range;
}

DisparityField one_view(const DepthMaps& maps, ViewIndex view, const CameraGrid& camera) {
  DisparityField field{ViewStack<float>({1, 1}, maps.depth.height(), maps.depth.width(), 1, view),
                       {}};
  auto out = field.disparity.view(view);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const double z = maps.is_valid(view, y, x) ? maps.depth.view(view).at(y, x) : 0;
      out.at(y, x) = static_cast<float>(camera.disparity_from_depth(z));
    }
  }
  return field;
}

/// If all valid depth lies in one view, the field shrinks to that view.
void keep_only_valid_view(DisparityField& field, const std::vector<std::size_t>& valid_counts) {
  const auto is_used = [](std::size_t count) { return count > 0; };
  if (valid_counts.size() < 2 ||
      std::count_if(valid_counts.begin(), valid_counts.end(), is_used) != 1) {
    return;
  }
  const auto used = std::find_if(valid_counts.begin(), valid_counts.end(), is_used);
  const ViewIndex view =
      field.disparity.view_at(static_cast<int>(std::distance(valid_counts.begin(), used)));
  const auto shrink = [&]<class T>(ViewStack<T>& stack) {
    ViewStack<T> single({1, 1}, stack.height(), stack.width(), 1, view);
    std::copy_n(stack.view(view).data, stack.view_size(), single.data());
    stack = std::move(single);
  };
  shrink(field.disparity);
  shrink(field.valid);
}

/// Turns the depth of a view into disparity, 0 where `valid` is 0 or becomes so because there is no
/// depth. Written without branches or calls, since all views of a large light field pass through
/// it. Returns how many pixels are valid.
std::size_t turn_view(float* z, std::uint8_t* valid, std::size_t size, const CameraGrid& camera) {
  const double at_depth_one = camera.baseline * camera.focal_length;
  const double shift = camera.shift;
  std::size_t count = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const float depth = z[i];
    const bool is_depth = (depth > 0) & (depth <= std::numeric_limits<float>::max());
    const bool is_valid = is_depth & (valid[i] != 0);
    const auto disparity =
        static_cast<float>(at_depth_one / (is_valid ? depth : 1.0F) - shift);  // eq. 1
    valid[i] = is_valid ? 1 : 0;
    z[i] = is_valid ? disparity : 0;
    count += is_valid ? 1 : 0;
  }
  return count;
}

void warn_of_gaps(const std::string& name, std::size_t valid, std::size_t total,
                  ConventionReport& report) {
  if (valid == total) return;
  const double share = 100 * static_cast<double>(total - valid) / static_cast<double>(total);
  report.warnings.push_back(fmt::format(finding_text("depth.holes"), name, share));
}

}  // namespace

DisparityField disparity_from_depth(DepthMaps maps, const CameraGrid& camera,
                                    ConventionReport& report, const Progress& progress) {
  DisparityField field;
  const ViewStack<float>& depth = maps.depth;
  // A mask of all views becomes what is valid; another is copied.
  const bool is_mask_whole = maps.mask.grid() == depth.grid() && maps.mask.first() == depth.first();
  field.valid = is_mask_whole ? std::move(maps.mask)
                              : ViewStack<std::uint8_t>(depth.grid(), depth.height(), depth.width(),
                                                        1, depth.first());
  std::vector<std::size_t> valid_counts(static_cast<std::size_t>(depth.grid().count()));
  parallel_for(depth.grid().count(), progress, [&](int i) {
    const ViewIndex view = depth.view_at(i);
    const auto z = maps.depth.view(view);
    const auto valid = field.valid.view(view);
    if (!is_mask_whole && maps.mask.contains(view)) {
      std::copy_n(maps.mask.view(view).data, valid.size(), valid.data);
    } else if (!is_mask_whole) {
      std::fill_n(valid.data, valid.size(), std::uint8_t{1});
    }
    valid_counts[static_cast<std::size_t>(i)] = turn_view(z.data, valid.data, z.size(), camera);
  });
  field.disparity = std::move(maps.depth);
  keep_only_valid_view(field, valid_counts);
  std::size_t valid = 0;
  for (const std::size_t count : valid_counts) valid += count;
  warn_of_gaps(maps.name, valid, field.valid.size(), report);
  if (valid == 0) return {};
  if (valid == field.valid.size()) field.valid = {};
  return field;
}

CameraGrid settle_units(const DepthMaps& maps, const LightField::Samples& samples,
                        const CameraGrid& stored, Units units, ConventionReport& report) {
  const GridShape grid = grid_of(samples);
  const ViewIndex view = reference_view(maps, grid);
  const Interval range = depth_range(maps, view);
  if (!(range.max > 0)) {
    report.units = "no valid depth";
    return stored;
  }
  const UnitsFinding finding =
      find_units({stored, maps.depth.width(), range}, units, [&](const CameraGrid& camera) {
        const DisparityField field = one_view(maps, view, camera);
        return warp_errors(samples, view, field.view(view)).best();
      });
  report.units = finding.text;
  report.units_check = finding.check;
  report.units_were_chosen = units != Units::Auto;
  report.warnings.insert(report.warnings.end(), finding.warnings.begin(), finding.warnings.end());
  return finding.camera;
}

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
  if (!file.has_numbers(dataset)) return {};
  return file.dataset(dataset).shape.size() > 2 ? "all views" : "the center view";
}

std::string truth_of(const Hdf5Input& file) {
  if (const std::string views = covered(file, "GT_DEPTH"); !views.empty()) {
    return "depth of " + views;
  }
  const bool has_layers =
      file.has_numbers("GT_DEPTH_FOREGROUND") && file.has_numbers("GT_DEPTH_BACKGROUND");
  return has_layers ? "depth of two layers" : "";
}

std::string labels_of(const Hdf5Input& file) {
  const std::string views = covered(file, kTrueLabels);
  const std::string labels = views.empty() ? "" : "labels of " + views;
  if (!file.has_numbers("SCRIBBLES")) return labels;
  return labels.empty() ? "scribbles" : labels + ", scribbles";
}

/// Labels of the file itself, or of the file beside it unless that belongs to another file.
std::string labels_with(const Hdf5Input& file) {
  if (const std::string own = labels_of(file); !own.empty()) return own;
  const fs::path beside = labels_beside(file.path());
  if (!has_hdf5_signature(beside)) return {};
  const Hdf5Input labels(beside);
  const auto owner = labels.text("/", "light_field");
  const bool is_own =
      owner ? *owner == file.path().filename().string() : is_label_file_of(file.path(), beside);
  return is_own ? labels_of(labels) : "";
}

}  // namespace

bool is_label_file_of(const std::filesystem::path& file, const std::filesystem::path& labels) {
  if (file.filename() == "lf.h5" || labels.filename() != "labels.h5") return true;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(labels.parent_path(), error)) {
    const fs::path& other = entry.path();
    if (!has_hdf5_name(other) || other.filename() == file.filename()) continue;
    try {
      if (has_hdf5_signature(other) && Hdf5Input(other).has(kArchiveLightField)) return false;
    } catch (const IoError&) {
      continue;  // damaged
    }
  }
  return true;
}

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
    throw IoError(file.path(), "the dataset LF " + file.fault_of(kArchiveLightField) +
                                   "; store numbers alone, each field as a dataset of its own");
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
    report.warnings.push_back(
        fmt::format(finding_text("attribute.unlike"), names[axis], whole(*stated), shape[axis]));
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
