// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"
#include "app/session/open_scene.h"
#include "engine/io/formats/collection.h"
#include "widgets/canvas/canvas_geometry.h"

#include <QHash>
#include <QObject>
#include <QString>
#include <QTimer>

#include <optional>

namespace episcope {

class SceneList;
class ScenePanel;
class ThumbnailQueue;
class TimeBar;

/// Lists the light fields below a folder, in the background, and opens them.
class CollectionController : public QObject {
  Q_OBJECT

 public:
  explicit CollectionController(const Workbench& bench);

  /// Shows the tab and searches a folder, beginning with the entries remembered from last time.
  void openCollection(const QString& folder);

 private:
  void addCommands();
  void addStep(const QString& id, const QString& text, const QString& tip, Qt::Key key, int step);
  void add(const io::CollectionEntry& entry);
  void finish(const std::vector<io::CollectionEntry>& entries);
  void step(int step);
  void open(const QString& path);
  /// Whether the user has worked on the scene; untouched scenes are closed when another is opened.
  [[nodiscard]] bool isTouched(const OpenScene& scene) const;
  void closeIfUntouched(std::uint64_t id);
  [[nodiscard]] QString openPath() const;
  void markOpen();

  Workbench bench_;
  SceneList* list_;
  ScenePanel* panel_;
  ThumbnailQueue* thumbnails_;
  QHash<QString, io::CollectionEntry> entries_;  // by path
  QString folder_;
  QString wanted_;  // by the last step, maybe still loading
  quint64 job_ = 0;
  quint64 search_ = 0;  // number of the newest one
};

/// The time slider: opens frames of a sequence, keeping view, cross-hair and zoom.
class FrameController : public QObject {
  Q_OBJECT

 public:
  explicit FrameController(const Workbench& bench);

 private:
  void addCommands();
  void show();
  void open(int frame);
  void step(int step);
  void setPlaying(bool is_playing);
  [[nodiscard]] bool isSequence() const;

  Workbench bench_;
  TimeBar* bar_;
  QTimer timer_;
  int wanted_ = -1;  // the frame that is loading; -1 = none
  bool is_playing_ = false;
  std::optional<CanvasTransform> kept_zoom_;  // For the frame that comes.
};

}  // namespace episcope
