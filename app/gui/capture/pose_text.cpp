// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/capture/pose_text.h"

#include "app/gui/capture/capture_controller.h"
#include "app/gui/capture/capture_documents.h"
#include "app/session/session.h"

#include <cmath>

namespace episcope {
namespace {

// Why there can be no pose; empty = there can.
QString obstacle(const Session& session) {
  if (!session.scene()) return CaptureController::tr("Open a light field first.");
  if (!session.light_field()->info().camera.pinhole) {
    return CaptureController::tr(
        "This light field does not tell its focal length and centre in pixels, which a pose "
        "needs. Rectify photographs with their calibrated lens; pairs are carried over.");
  }
  return {};
}

}  // namespace

QString pose_text(const Session& session, const CaptureDocuments& documents) {
  const QString missing = obstacle(session);
  if (!missing.isEmpty()) return missing;
  if (!documents.problem().isEmpty()) return documents.problem();
  const CaptureObject* object = documents.now().work().object();
  if (!object || !object->pose) {
    return CaptureController::tr("%1 of at least 4 pairs; 10 are better.")
        .arg(documents.now().pairs().size());
  }
  const capture::SolvedPose& pose = *object->pose;
  QString text =
      CaptureController::tr("Mean reprojection error %1 px; depth to ± %2 (unit of the mesh)")
          .arg(pose.reprojection_error_px, 0, 'f', 2)
          .arg(pose.delta_tz, 0, 'g', 3);
  if (std::isfinite(pose.delta_tz_px)) {
    text += CaptureController::tr(", ± %1 px of disparity").arg(pose.delta_tz_px, 0, 'f', 4);
  }
  return text + '.';
}

}  // namespace episcope
