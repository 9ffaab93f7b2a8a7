// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "engine/capture/mesh/triangle_mesh.h"
#include "widgets/cloud/cloud_look.h"

#include <QObject>

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>

namespace episcope {

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
