// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/archive/archive_depth.h"

#include "engine/io/archive/archive_names.h"
#include "engine/io/archive/depth_maps.h"
#include "engine/io/archive/depth_units.h"
#include "engine/io/archive/other_maps.h"

#include <algorithm>
#include <cmath>

namespace episcope::io {
namespace {

DepthMaps read_depth(const Hdf5Input& file, const std::string& name, const FieldShape& shape,
                     MapViews views, const Progress& progress) {
  DepthMaps maps;
  if (!file.has(name)) return maps;
  maps.name = name;
  maps.depth = read_maps<float>(file, name, shape, progress.part(0, 0.8), views);
  if (file.has(name + "_MASK")) {
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
  const std::vector<double> pinhole = file.numbers("/", kPinhole);
  if (pinhole.size() == 3) camera.pinhole = Pinhole{pinhole[0], pinhole[1], pinhole[2]};
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
      std::string(lacks_foreground ? "GT_DEPTH_BACKGROUND" : "GT_DEPTH_FOREGROUND") +
      " is ignored because the other layer, " +
      (lacks_foreground ? "GT_DEPTH_FOREGROUND" : "GT_DEPTH_BACKGROUND") +
      ", is missing or holds no depth; add it, or store a single layer as GT_DEPTH.");
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
  const std::string other = file.has("GT_DEPTH") ? "" : other_depth(file, shape);
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

}  // namespace episcope::io
