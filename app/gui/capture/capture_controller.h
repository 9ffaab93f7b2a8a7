// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"
#include "app/session/capture_work.h"
#include "engine/capture/snap_pick.h"
#include "engine/core/indices.h"
#include "engine/core/light_field.h"

#include <QObject>
#include <QString>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

class QKeyEvent;

namespace episcope {

class CaptureDocument;
class CaptureDocuments;
class CapturePanel;
class MeshResults;
class MeshShelf;
class Photographs;
struct ReadMesh;

/// Moves picks in the centre view to the corner or blob beside them. Keeps the grey centre view of
/// the last light field.
class PickSnapper {
 public:
  static constexpr double kReach_px = 5;

  [[nodiscard]] std::optional<capture::SnappedPick> snap(const LightFieldPtr& light_field,
                                                         PixelIndex pixel);

 private:
  std::weak_ptr<const LightField> light_field_;
  Image<float> grey_;
};

/// The Capture tab: objects with their meshes, picks on view and mesh, and what follows from them.
class CaptureController : public QObject {
  Q_OBJECT

 public:
  CaptureController(const Workbench& bench, QWidget* tab);

  /// The mesh of the current object; the first one becomes an object.
  void openMesh(const QString& path);
  void addObject(const QString& mesh);
  void importPairs(const QString& path);
  void exportPairs(const QString& path);
  void savePose(const QString& path);
  void writeTruth(const QString& path);
  /// Marks a point of the mesh for the next pair.
  void pickVertex(std::size_t vertex);

  [[nodiscard]] Photographs& photographs() { return *photographs_; }
  /// Of the light field that is shown.
  [[nodiscard]] const CaptureWork& work() const;
  /// Of the current object.
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
  /// Undo and redo are of this tab while it is worked in. Returns whether the key was one of them.
  bool hearKey(const QKeyEvent& event);
  /// The document, or the mesh of its object, is another.
  void show();
  /// The same, with the meshes that are read by now.
  void showRead();
  void showMesh();
  void showPairs();
  /// What the next pair would take.
  void showNext();
  /// The pairs on the centre view and on the mesh, while the tab is there.
  void showMarks();
  /// The mark beside the cross-hair, if picks are to move to one.
  [[nodiscard]] std::optional<capture::SnappedPick> snapped();
  /// The place in the view that the next pair would take.
  [[nodiscard]] QString nextText();
  /// The built-in gantry brings its lens, its mesh and its picks.
  void followGantry();
  /// Of the current object; null = it has none, or it is not read yet.
  [[nodiscard]] const ReadMesh* mesh() const;

  Workbench bench_;
  QWidget* tab_;
  CaptureDocuments* documents_;
  MeshShelf* shelf_;
  Photographs* photographs_;
  MeshResults* results_;
  CapturePanel* panel_ = nullptr;
  const void* shown_mesh_ = nullptr;  // to see whether it is another
  std::optional<std::size_t> vertex_;
  PickSnapper snapper_;
};

}  // namespace episcope
