// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/capture/rectify_photographs.h"

#include "engine/io/archive/write_scene.h"

#include <memory>
#include <utility>

namespace episcope {

RectifiedFile rectify_to_file(RectifyTask task, const Progress& progress) {
  RectifiedFile made{capture::rectify(*task.photographs.light_field, task.camera, task.options,
                                      progress.part(0, 0.9)),
                     std::move(task.picks)};
  Scene scene = std::move(task.photographs);
  scene.light_field = made.rectified.light_field;
  scene.truth = std::make_shared<GroundTruth>();
  scene.scribbles = {};
  io::write_archive(task.output, scene, progress.part(0.9, 1));
  for (capture::PointPair& pair : made.pairs) {
    const capture::PlanePoint place =
        made.rectified.center_pixel(task.camera, {pair.x_px, pair.y_px});
    pair.x_px = place.x;
    pair.y_px = place.y;
  }
  return made;
}

}  // namespace episcope
