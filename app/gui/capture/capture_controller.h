// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "app/gui/capture/pick_snapper.h"
#include "app/gui/capture/picked_pairs.h"
#include "app/gui/frame/jobs.h"
#include "app/session/parts.h"
#include "engine/capture/mesh/triangle_mesh.h"
#include "engine/capture/pose/solve_pose.h"

#include <QObject>
#include <QString>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>

namespace episcope {

class CapturePanel;
class Photographs;

/// From a mesh and pairs of points to a pose, a result and ground truth, of the open light field.
class CaptureController : public QObject {
  Q_OBJECT

 public:
  CaptureController(const Workbench& bench, QWidget* tab);

  void openMesh(const QString& path);
  void importPairs(const QString& path);
  void exportPairs(const QString& path);
  void savePose(const QString& path);
  void writeTruth(const QString& path);
  /// Marks a point of the mesh for the next pair.
  void pickVertex(std::size_t vertex);

  [[nodiscard]] Photographs& photographs() { return *photographs_; }
  /// Of the light field that is shown.
  [[nodiscard]] const PickedPairs& pairs() const { return now_->pairs; }
  [[nodiscard]] const std::optional<capture::SolvedPose>& pose() const { return pose_; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Loaded;
  /// What belongs to one of the open light fields.
  struct OfScene {
    PickedPairs pairs;
    int result = 0;  ///< Of the mesh.
  };

  void makePanel();
  void connectPanel();
  void followScene();
  void openFormerMesh();
  void loadMesh(const QString& path);
  void keep();
  void followPhotographs();
  void addPair();
  void showOverView();
  void changed();
  void solve();
  void showNext();
  /// What the next pair would take in the view, px.
  /// The mark beside the cross-hair, if picks are to move to one.
  [[nodiscard]] std::optional<capture::SnappedPick> snapped();
  /// The place in the view that the next pair would take.
  [[nodiscard]] QString nextText();
  void showPairs();
  /// The pairs on the centre view and on the mesh, while the tab is there.
  void showMarks();
  /// The demo brings its lens, its mesh and its picks.
  void followGantry();
  [[nodiscard]] QString poseText() const;
  /// Why there can be no pose; empty = there can.
  [[nodiscard]] QString obstacle() const;

  Workbench bench_;
  QWidget* tab_;
  Photographs* photographs_;
  CapturePanel* panel_ = nullptr;
  std::filesystem::path mesh_file_;
  std::shared_ptr<const capture::TriangleMesh> mesh_;
  std::optional<std::size_t> vertex_;
  PickSnapper snapper_;
  std::optional<capture::SolvedPose> pose_;
  QString problem_;  // why there is no pose
  std::map<std::uint64_t, OfScene> of_scenes_;
  OfScene* now_ = &of_scenes_[0];
};

}  // namespace episcope
