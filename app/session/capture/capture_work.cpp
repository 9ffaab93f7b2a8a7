// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/capture/capture_work.h"

#include "engine/core/error.h"

#include <cstddef>
#include <filesystem>

namespace episcope {

const CaptureObject* CaptureWork::object() const {
  const bool is_there = current >= 0 && current < static_cast<int>(objects.size());
  return is_there ? &objects[static_cast<std::size_t>(current)] : nullptr;
}

CaptureLens lens_of(const capture::Calibration& calibration) {
  CaptureLens lens{.camera = calibration.camera};
  for (const capture::PatternPhotograph& each : calibration.photographs) {
    lens.photographs.push_back(
        {std::filesystem::path(each.name).filename().string(), each.rms, each.problem});
  }
  return lens;
}

std::string solve_poses(CaptureWork& work, const CameraGrid& camera) {
  std::string problem;
  for (CaptureObject& object : work.objects) {
    object.pose.reset();
    if (!camera.pinhole || object.pairs.size() < 4) continue;
    try {
      object.pose = capture::solve_pose(object.pairs, camera);
    } catch (const InvalidInput& error) {
      if (&object == work.object()) problem = error.what();
    }
  }
  return problem;
}

}  // namespace episcope
