// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"
#include "app/session/capture_work.h"
#include "engine/capture/mesh_file.h"
#include "engine/capture/pixel_surface.h"
#include "engine/core/indices.h"
#include "engine/core/light_field.h"
#include "widgets/cloud/cloud_look.h"

#include <QObject>
#include <QString>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

class QKeyEvent;

namespace episcope {

class CaptureDocuments;
class MeshShelf;

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
class CapturePanel;
class MeshResults;
class Photographs;
class RawPictures;
struct ReadMesh;

/// Snaps picks in the center view to the nearest corner or blob. Caches the grey center view of the
/// last light field.
class PickSnapper {
 public:
  static constexpr double kReach_px = 5;

  [[nodiscard]] std::optional<capture::SnappedPick> snap(const LightFieldPtr& light_field,
                                                         PixelIndex pixel);

 private:
  std::weak_ptr<const LightField> light_field_;
  Image<float> grey_;
};

/// The Capture tab: objects with their meshes, picks on view and mesh, and the poses computed from
/// them; on a page of its own, raw pictures.
class CaptureController : public QObject {
  Q_OBJECT

 public:
  CaptureController(const Workbench& bench, QWidget* tab);

  /// Opens the mesh of the current object; the first mesh creates an object.
  void openMesh(const QString& path);
  void addObject(const QString& mesh);
  void importPairs(const QString& path);
  void exportPairs(const QString& path);
  void savePose(const QString& path);
  void writeTruth(const QString& path);
  /// Marks a point of the mesh for the next pair.
  void pickVertex(std::size_t vertex);

  [[nodiscard]] Photographs& photographs() { return *photographs_; }
  [[nodiscard]] RawPictures& rawPictures() { return *raw_pictures_; }
  /// Work on the shown light field.
  [[nodiscard]] const CaptureWork& work() const;
  /// Pairs of the current object.
  [[nodiscard]] const std::vector<capture::PointPair>& pairs() const;
  [[nodiscard]] const std::optional<capture::SolvedPose>& pose() const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  using Change = std::function<void(CaptureDocument&)>;

  void makePanel();
  void connectObjects();
  void connectPairs();
  void connectResults();
  void connectFiles();
  void change(const Change& change);
  void readMesh(const QString& path, const Change& then);
  void goTo(const capture::PointPair& pair);
  void addPair();
  /// Handles undo and redo while the tab has the focus. Returns whether the key was one of them.
  bool hearKey(const QKeyEvent& event);
  /// Shows another document, or another mesh of its object.
  void show();
  /// Shows the document with the meshes read so far.
  void showRead();
  void showMesh();
  void showPairs();
  /// Shows the points that the next pair would use.
  void showNext();
  /// Marks the pairs on center view and mesh while the tab exists.
  void showMarks();
  /// Corner or blob near the cross-hair, if snapping is on.
  [[nodiscard]] std::optional<capture::SnappedPick> snapped();
  /// Place in the view that the next pair would use, as text.
  [[nodiscard]] QString nextText();
  /// Takes lens, mesh and picks from the built-in gantry.
  void followGantry();
  /// Mesh of the current object; null if there is none, or not yet.
  [[nodiscard]] const ReadMesh* mesh() const;

  Workbench bench_;
  QWidget* tab_;
  CaptureDocuments* documents_;
  MeshShelf* shelf_;
  Photographs* photographs_;
  RawPictures* raw_pictures_;
  MeshResults* results_;
  CapturePanel* panel_ = nullptr;
  const void* shown_mesh_ = nullptr;  // to see whether it is another
  std::optional<std::size_t> vertex_;
  PickSnapper snapper_;
};

}  // namespace episcope
