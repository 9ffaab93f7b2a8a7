// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/capture/pair_marks.h"

#include "engine/capture/mesh_file.h"
#include "engine/capture/solve_pose.h"
#include "widgets/cloud/cloud_look.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

namespace episcope {
namespace {

constexpr std::size_t kMovingFaces = 60'000;

// A canvas counts from the corner of a pixel.
QPointF on_canvas(double x_px, double y_px) {
  return {x_px + 0.5, y_px + 0.5};
}

}  // namespace

CloudPartsPtr mesh_parts(const capture::TriangleMesh& mesh) {
  CloudPart part{make_mesh_cloud(mesh.vertices, mesh.faces), {}};
  if (mesh.faces.size() > kMovingFaces) {
    const capture::TriangleMesh coarse = capture::cluster_vertices(mesh, kMovingFaces);
    part.few = make_mesh_cloud(coarse.vertices, coarse.faces);
  }
  auto parts = std::make_shared<CloudParts>();
  parts->push_back(std::move(part));
  return parts;
}

std::array<double, 3> in_mesh_view(const capture::Point3& point) {
  return {point.x, -point.y, -point.z};
}

std::vector<CaptureRow> pair_rows(const std::vector<capture::PointPair>& pairs,
                                  const std::optional<capture::SolvedPose>& pose) {
  std::vector<CaptureRow> rows;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const capture::PointPair& pair = pairs[i];
    CaptureRow row{.name = QString::fromStdString(pair.name),
                   .pixel = {pair.x_px, pair.y_px},
                   .point = {pair.point.x, pair.point.y, pair.point.z},
                   .off_px = {},
                   .is_locked = pair.is_locked};
    if (pose) {
      row.off_px = pose->pairs[i].residual_px;
      row.is_outlier = pose->pairs[i].is_outlier;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

PairMarks pair_marks(const std::vector<capture::PointPair>& pairs, const capture::RigidPose* pose,
                     const std::optional<Pinhole>& pinhole,
                     const std::function<bool(int)>& is_emphasised) {
  PairMarks marks;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const capture::PointPair& pair = pairs[i];
    const bool is_strong = is_emphasised(static_cast<int>(i));
    CanvasMark mark{
        on_canvas(pair.x_px, pair.y_px), {}, QString::fromStdString(pair.name), is_strong};
    if (pose && pinhole) {
      const auto [dx, dy] = capture::reprojection_residual(pair, *pose, *pinhole);
      if (std::isfinite(dx)) mark.wanted = on_canvas(pair.x_px + dx, pair.y_px + dy);
    }
    marks.on_view.push_back(std::move(mark));
    marks.on_mesh.push_back({in_mesh_view(pair.point), pair.name, is_strong});
  }
  return marks;
}

}  // namespace episcope
