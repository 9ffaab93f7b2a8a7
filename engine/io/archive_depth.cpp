// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/archive_depth.h"

#include "engine/io/depth_maps.h"

namespace episcope::io {
namespace {

FieldShape shape_of(const LightField::Samples& samples) {
  return std::visit(
      [](const auto& stack) {
        return FieldShape{stack.grid(), stack.height(), stack.width()};
      },
      samples);
}

DepthMaps read_depth(const Hdf5Input& file, const std::string& name, const FieldShape& shape,
                     const Progress& progress) {
  DepthMaps maps;
  if (!file.has(name)) return maps;
  maps.name = name;
  maps.depth = read_maps<float>(file, name, shape, progress.part(0, 0.8));
  if (file.has(name + "_MASK")) {
    maps.mask = read_maps<std::uint8_t>(file, name + "_MASK", shape, progress.part(0.8, 1));
  }
  return maps;
}

}  // namespace

CameraGrid read_camera(const Hdf5Input& file) {
  const auto number = [&](const char* name) {
    const auto value = file.number("/", name);
    return value ? value : file.number("LF", name);
  };
  CameraGrid camera;
  camera.baseline = number("dH").value_or(0);
  camera.focal_length = number("focalLength").value_or(0);
  camera.cam_distance = number("camDistance");
  const double from_distance =
      camera.cam_distance ? camera.baseline * camera.focal_length / *camera.cam_distance : 0;
  camera.shift = number("shift").value_or(from_distance);
  return camera;
}

ArchiveTruth read_archive_depth(const Hdf5Input& file, const LightField::Samples& samples,
                                OpenOptions::Units units, ConventionReport& report,
                                const Progress& progress) {
  const FieldShape shape = shape_of(samples);
  ArchiveTruth truth;
  truth.camera = read_camera(file);
  DepthMaps field = read_depth(file, "GT_DEPTH", shape, progress.part(0, 0.7));
  DepthMaps foreground = read_depth(file, "GT_DEPTH_FOREGROUND", shape, progress.part(0.7, 0.8));
  DepthMaps background = read_depth(file, "GT_DEPTH_BACKGROUND", shape, progress.part(0.8, 0.9));
  const DepthMaps& reference =
      !field.empty() ? field : (!background.empty() ? background : foreground);
  if (reference.empty()) {
    report.units = "no depth in this file";
    return truth;
  }
  if (!truth.camera.is_known()) {
    report.units = "depth left out";
    report.warnings.push_back(reference.name +
                              " is left out, since the file lacks the attributes dH and "
                              "focalLength that turn depth into disparity.");
    return truth;
  }
  truth.camera = settle_units(reference, samples, truth.camera, units, report);
  const auto finish = [&](DepthMaps& maps, double from) {
    return maps.empty() ? DisparityField{}
                        : disparity_from_depth(std::move(maps), truth.camera, report,
                                               progress.part(from, from + 0.03));
  };
  truth.field = finish(field, 0.9);
  truth.foreground = finish(foreground, 0.93);
  truth.background = finish(background, 0.96);
  return truth;
}

}  // namespace episcope::io
