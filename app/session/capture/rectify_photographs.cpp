// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/capture/rectify_photographs.h"

#include "engine/io/archive/write_scene.h"

#include <memory>
#include <utility>

namespace episcope {

RectifiedFile rectify_to_file(RectifyTask task, const Progress& progress) {
  const capture::LensCamera& camera = task.work.lens->camera;
  RectifiedFile made{capture::rectify(*task.photographs.light_field, camera, task.work.rectify,
                                      progress.part(0, 0.9)),
                     task.work};
  Scene scene = std::move(task.photographs);
  scene.light_field = made.rectified.light_field;
  scene.truth = std::make_shared<GroundTruth>();
  scene.scribbles = {};
  io::write_archive(task.output, scene, progress.part(0.9, 1));
  made.work.rows = {made.rectified.before, made.rectified.after};
  for (CaptureObject& object : made.work.objects) {
    object.pose.reset();
    for (capture::PointPair& pair : object.pairs) {
      const capture::PlanePoint place = made.rectified.center_pixel(camera, {pair.x_px, pair.y_px});
      pair.x_px = place.x;
      pair.y_px = place.y;
    }
  }
  return made;
}

}  // namespace episcope
