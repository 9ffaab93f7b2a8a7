// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/capture/capture_controller.h"
#include "engine/capture/mesh_file.h"
#include "engine/capture/solve_pose.h"
#include "tests/app/gui/window_fixture.h"
#include "widgets/controls/labels.h"

#include <QLabel>
#include <QTest>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace episcope {

inline constexpr Pinhole kPinhole{120, 47.5, 47.5};

/// Turned by 0.1 about y, `z` mm away.
inline capture::RigidPose pose_at(double z) {
  const double c = std::cos(0.1), s = std::sin(0.1);
  return {{c, 0, s, 0, 1, 0, -s, 0, c}, {5, -8, z}};
}

/// An exact pair.
inline capture::PointPair pair_of(const std::string& name, const capture::Vertex& vertex,
                                  double z = 900) {
  const capture::Point3 on_mesh{vertex[0], vertex[1], vertex[2]};
  const capture::Point3 p = pose_at(z).apply(on_mesh);
  return {name, kPinhole.focal_px * p.x / p.z + kPinhole.center_x,
          kPinhole.focal_px * p.y / p.z + kPinhole.center_y, on_mesh};
}

/// Views of 96×96 px whose pinhole is known, or is not.
inline Scene posed_scene(bool has_pinhole) {
  Scene scene = scenes::render_builtin("edge", WindowFixture::smallOptions(), Progress());
  LightFieldInfo info = scene.light_field->info();
  info.camera.baseline = 10;
  info.camera.focal_length = kPinhole.focal_px;
  info.camera.shift = 10 * 120.0 / 900;
  if (has_pinhole) info.camera.pinhole = kPinhole;
  const auto& samples = std::get<ViewStack<std::uint8_t>>(scene.light_field->samples());
  scene.light_field = std::make_shared<LightField>(samples.clone(), info);
  return scene;
}

/// The window on such a light field, with the Capture tab.
class Capturing : public WindowFixture {
 public:
  explicit Capturing(bool has_pinhole = true) : mesh(capture::scan_mesh(12)) {
    capture::write_mesh(file("scan.ply"), mesh);
    const auto scene = std::make_shared<const Scene>(posed_scene(has_pinhole));
    window.bench().session.open(scene, "edge");
    trigger("tab.capture");
    // The first OpenGL widget has the native window recreated.
    QTRY_VERIFY(window.findChild<QWidget*>("capturePanel")->isVisible());
  }

  [[nodiscard]] std::filesystem::path file(const char* name) const {
    return path(name).toStdString();
  }
  CaptureController& capture() { return find<CaptureController>(window); }
  [[nodiscard]] QString text(const char* label) const {
    return window.findChild<QLabel*>(label)->text();
  }
  [[nodiscard]] QString full(const char* label) const {
    return window.findChild<ElidedLabel*>(label)->fullText();
  }
  void awaitMesh(const QString& name) {
    QTRY_VERIFY2_WITH_TIMEOUT(full("capture.mesh").startsWith(name + " ·"),
                              qPrintable(full("capture.mesh")), kPatience);
  }
  void openMesh() {
    capture().openMesh(path("scan.ply"));
    awaitMesh("scan.ply");
  }
  /// Exact pairs of vertices far apart.
  void importPairs(std::size_t count) {
    std::vector<capture::PointPair> pairs;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t vertex = (i * 7919) % mesh.vertices.size();
      pairs.push_back(pair_of("p" + std::to_string(i + 1), mesh.vertices[vertex]));
    }
    capture::write_pairs(file("pairs.csv"), pairs);
    capture().importPairs(path("pairs.csv"));
  }

  capture::TriangleMesh mesh;
};

}  // namespace episcope
