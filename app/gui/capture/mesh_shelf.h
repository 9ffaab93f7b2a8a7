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

/// A mesh that was read, and as the 3D view shows it.
struct ReadMesh {
  std::shared_ptr<const capture::TriangleMesh> mesh;
  CloudPartsPtr cloud;
};

/// The meshes of objects, read in the background, each file once.
class MeshShelf : public QObject {
  Q_OBJECT

 public:
  MeshShelf(const Workbench& bench, QObject* parent);

  /// Reads a file, anew if it was read before; `then` is called if it is a mesh.
  void read(const std::string& file, const std::function<void()>& then);
  /// Reads the files that are not there, but for those that could not be read, and forgets all
  /// others. What was cancelled is read again.
  void keep(const std::set<std::string>& files);
  /// Null if it is not there (yet).
  [[nodiscard]] const ReadMesh* find(const std::string& file) const;
  [[nodiscard]] bool isReading(const std::string& file) const { return reading_.contains(file); }
  /// Whether it could not be read.
  [[nodiscard]] bool isBroken(const std::string& file) const { return broken_.contains(file); }

 signals:
  /// A mesh is there that `keep` asked for, or reading one has failed or was cancelled.
  void changed();

 private:
  Workbench bench_;
  std::map<std::string, ReadMesh> meshes_;
  std::map<std::string, quint64> reading_;  // with its newest job
  std::set<std::string> broken_;
};

}  // namespace episcope
