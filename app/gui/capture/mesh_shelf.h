// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"
#include "app/session/capture_output.h"
#include "engine/capture/triangle_mesh.h"
#include "widgets/cloud/cloud_look.h"

#include <QObject>
#include <QString>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace episcope {

class CaptureDocuments;
class MeshShelf;

/// Outputs of meshes and poses: a result, ground truth, files of poses.
class MeshResults : public QObject {
  Q_OBJECT

 public:
  MeshResults(const Workbench& bench, const CaptureDocuments& documents, const MeshShelf& shelf,
              QObject* parent);

  /// Adds the depth of all objects in the center view as a result, replacing the previous one.
  void showOverView();
  /// Writes the light field with the depth of all objects in all views as ground truth.
  void writeTruth(const QString& path);
  /// Writes the pose of the current object.
  void savePose(const QString& path);

 private:
  /// All objects with mesh and pose. Tells the user which are left out.
  [[nodiscard]] std::vector<PosedMesh> posedMeshes() const;

  Workbench bench_;
  const CaptureDocuments& documents_;
  const MeshShelf& shelf_;
  std::map<std::uint64_t, int> results_;  // by OpenScene::id
};

/// A mesh, and its form for the 3D view.
struct ReadMesh {
  std::shared_ptr<const capture::TriangleMesh> mesh;
  CloudPartsPtr cloud;
};

/// Meshes of objects; reads each file once, in the background.
class MeshShelf : public QObject {
  Q_OBJECT

 public:
  MeshShelf(const Workbench& bench, QObject* parent);

  /// Reads a file, even if it was read before; calls `then` on success.
  void read(const std::string& file, const std::function<void()>& then);
  /// Reads missing files, except those that failed before, and forgets all others. Reads cancelled
  /// files again.
  void keep(const std::set<std::string>& files);
  /// Null if the mesh is not read (yet).
  [[nodiscard]] const ReadMesh* find(const std::string& file) const;
  [[nodiscard]] bool isReading(const std::string& file) const { return reading_.contains(file); }
  /// Whether reading the mesh failed.
  [[nodiscard]] bool isBroken(const std::string& file) const { return broken_.contains(file); }

 signals:
  /// A mesh requested by `keep` was read, failed or was cancelled.
  void changed();

 private:
  Workbench bench_;
  std::map<std::string, ReadMesh> meshes_;
  std::map<std::string, quint64> reading_;  // with its newest job
  std::set<std::string> broken_;
};

}  // namespace episcope
