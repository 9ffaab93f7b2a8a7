// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "app/session/capture/mesh_truth.h"

#include <QObject>
#include <QString>

#include <cstdint>
#include <map>
#include <vector>

namespace episcope {

class CaptureDocuments;
class MeshShelf;

/// What meshes and their poses give: a result, ground truth, files of poses.
class MeshResults : public QObject {
  Q_OBJECT

 public:
  MeshResults(const Workbench& bench, const CaptureDocuments& documents, const MeshShelf& shelf,
              QObject* parent);

  /// The depth of all objects in the centre view becomes a result, in the place of the former.
  void showOverView();
  /// Writes the light field with the depth of all objects in all views.
  void writeTruth(const QString& path);
  /// The pose of the current object.
  void savePose(const QString& path);

 private:
  /// All objects with mesh and pose. The user is told which are left out.
  [[nodiscard]] std::vector<PosedMesh> posedMeshes() const;

  Workbench bench_;
  const CaptureDocuments& documents_;
  const MeshShelf& shelf_;
  std::map<std::uint64_t, int> results_;  // by OpenScene::id
};

}  // namespace episcope
