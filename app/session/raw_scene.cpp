// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/raw_scene.h"

#include "engine/capture/plenoptic/decode_files.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/formats/write_scene.h"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace episcope {
namespace {

scenes::BuiltinRequest before_camera(scenes::BuiltinRequest scene,
                                     const capture::SyntheticCamera& camera) {
  scene.options.width = camera.view_width();
  scene.options.height = camera.view_height();
  scene.options.channels = camera.mosaic == capture::Mosaic::Gray ? 1 : 3;
  scene.options.noise_sigma = 0;
  scene.options.positions.clear();
  return scene;
}

}  // namespace

capture::PupilLight light_of(const scenes::BuiltinRequest& scene,
                             const capture::SyntheticCamera& camera) {
  return [request = before_camera(scene, camera)](const std::vector<CameraPosition>& positions,
                                                  const Progress& progress) {
    scenes::RenderOptions options = request.options;
    options.grid = {1, static_cast<int>(positions.size())};
    options.positions = positions;
    return scenes::render_builtin(request.scene, options, progress);
  };
}

Scene ideal_views(const scenes::BuiltinRequest& scene, const capture::SyntheticCamera& camera,
                  int views, const Progress& progress) {
  scenes::BuiltinRequest request = before_camera(scene, camera);
  request.options.grid = {views, views};
  return scenes::render_builtin(request.scene, request.options, progress);
}

capture::FoundPictures expose_plenoptic(const Progress& progress) {
  capture::SyntheticCamera camera = capture::synthetic_camera(capture::CameraModel::F01);
  camera.width = 2000;
  camera.height = 1504;
  progress.step("exposing the sensor");
  capture::SyntheticPictures seen =
      capture::expose(camera, light_of({"demo", {}}, camera), progress);
  capture::FoundPictures found;
  found.pictures.raw = std::move(seen.raw);
  found.pictures.white = std::move(seen.white);
  found.pictures.raw.name = kPlenopticScene;
  found.pictures.raw.source = std::string("demo:") + kPlenopticScene;
  return found;
}

Scene load_plenoptic(const Progress& progress) {
  const capture::FoundPictures found = expose_plenoptic(progress.part(0, 0.6));
  const capture::LensGrid grid = find_lenses(found.pictures, progress.part(0.6, 0.8));
  return scene_of(decode(found.pictures, grid, {}, progress.part(0.8, 1)), found);
}

RawFolder write_raw_folder(const std::filesystem::path& folder, const scenes::BuiltinRequest& scene,
                           const capture::SyntheticCamera& camera, const Progress& progress) {
  io::AtomicFolder target(folder);
  progress.step("exposing " + scene.scene);
  const capture::SyntheticPictures pictures =
      capture::expose(camera, light_of(scene, camera), progress.part(0, 0.8));
  RawFolder files;
  const std::filesystem::path raw =
      capture::write_pictures(target.temporary(), camera, pictures).filename();
  const bool is_f01 = camera.model == capture::CameraModel::F01;
  files.raw = folder / raw;
  if (is_f01) files.white = folder / "calibration";
  files.ideal = folder / "ideal.h5";
  io::write_archive(target.temporary() / "ideal.h5",
                    ideal_views(scene, camera, 9, progress.part(0.8, 0.9)), progress.part(0.9, 1));
  io::write_atomically(
      target.temporary() / "readme.txt",
      fmt::format("A raw picture of a plenoptic camera, computed, in this folder:\n\n"
                  "episcope-cli decode {}{} -o lf.h5\nepiscope lf.h5\n\n"
                  "ideal.h5 holds the views that it is made of, with their disparity.\n",
                  raw.string(), is_f01 ? " --white calibration" : ""));
  target.commit();
  return files;
}

}  // namespace episcope
