// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/cloud/cloud_look.h"
#include "widgets/controls/labels.h"

#include <QCheckBox>
#include <QPointF>
#include <QString>
#include <QStringList>
#include <QToolButton>
#include <QWidget>

#include <array>
#include <optional>
#include <vector>

class QAction;
class QComboBox;
class QLabel;
class QPushButton;
class QStackedLayout;
class QTableWidget;

namespace episcope {

class CaptureObjects;
class PhotographSteps;
class PointCloudView;

/// A row of the table of pairs.
struct CaptureRow {
  QString name;
  QPointF pixel;                 ///< In the center view.
  std::array<double, 3> point;   ///< On the mesh.
  std::optional<double> off_px;  ///< From where the pose puts it; nothing without a pose.
  bool is_outlier = false;
  bool is_locked = false;
};

/// Mesh, pairs and pose of the Capture tab. Setters never emit.
class CapturePanel : public QWidget {
  Q_OBJECT

 public:
  explicit CapturePanel(QWidget* parent = nullptr);

  /// Shows the mesh of the current object, or a hint if it has no parts.
  void setMesh(const CloudPartsPtr& mesh);
  void setRows(const std::vector<CaptureRow>& rows);
  /// Next pair: text of its pixel, its mesh point if one is marked, and whether both exist.
  void setNext(const QString& pixel, const std::optional<std::array<double, 3>>& point,
               bool is_complete);
  /// Marks of the mesh: the place of the next pair, and the named pairs.
  void setPicked(const std::optional<std::array<double, 3>>& point);
  void setMarks(const std::vector<CloudMark>& marks);
  /// Row of the pair under the mouse elsewhere; none = none.
  void setHovered(std::optional<int> row) { hover(row); }
  /// What is known of the pose, or what is missing.
  void setPose(const QString& text, bool is_known);
  void setUndoable(bool is_undoable) { undo_->setEnabled(is_undoable); }
  void setRedoable(bool is_redoable) { redo_->setEnabled(is_redoable); }
  /// Whether picks snap to the nearest corner or blob.
  [[nodiscard]] bool snaps() const { return snap_->isChecked(); }
  [[nodiscard]] PhotographSteps* steps() const { return steps_; }
  [[nodiscard]] CaptureObjects* objects() const { return objects_; }
  [[nodiscard]] std::vector<int> selectedRows() const;
  /// Whether the row is selected, or under the mouse.
  [[nodiscard]] bool isEmphasised(int row) const;

 signals:
  void importRequested();
  void exportRequested();
  void snapChanged();
  void addRequested();
  void removeRequested();
  void undoRequested();
  void redoRequested();
  void renamed(int row, const QString& name);
  void lockChanged(int row, bool is_locked);
  /// The selection, or the row under the mouse, changed.
  void emphasisChanged();
  /// The user double-clicked a pair.
  void rowChosen(int row);
  /// The user clicked a vertex of the mesh.
  void vertexPicked(std::size_t vertex);
  void showRequested();
  void savePoseRequested();
  void writeTruthRequested();

 private:
  QWidget* makeView();
  QWidget* makePairs();
  QWidget* makeResults();
  void change(int row, int column);
  void hover(std::optional<int> row);
  void enableRowButtons();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  PhotographSteps* steps_;
  CaptureObjects* objects_;
  QLabel* hint_;
  QLabel* next_;
  QLabel* pose_;
  QCheckBox* snap_;
  QPushButton* add_;
  QToolButton* undo_;
  QToolButton* redo_;
  QTableWidget* table_;
  QStackedLayout* stack_;
  QPushButton* remove_ = nullptr;
  QPushButton* export_ = nullptr;
  std::vector<QPushButton*> of_pose_;  // need one
  PointCloudView* view_ = nullptr;
  std::optional<int> hovered_;  // row
};

/// The objects before the cameras, one of them current, and its mesh. Setters never emit.
class CaptureObjects : public QWidget {
  Q_OBJECT

 public:
  explicit CaptureObjects(QWidget* parent = nullptr);

  /// `current`: index of the current object.
  void setObjects(const QStringList& names, int current);
  /// Describes its mesh; empty = none.
  void setMesh(const QString& text) { mesh_->setFullText(text.isEmpty() ? tr("No mesh") : text); }

 signals:
  void chosen(int object);
  /// The user renamed the current object.
  void renamed(const QString& name);
  void addRequested();
  void removeRequested();
  void openMeshRequested();

 private:
  QComboBox* names_;
  QPushButton* remove_;
  ElidedLabel* mesh_;
};

/// The steps from photographs to a rectified light field: their results and actions. Setters never
/// emit.
class PhotographSteps : public QWidget {
  Q_OBJECT

 public:
  explicit PhotographSteps(QWidget* parent = nullptr);

  /// `text`: state of the lens; `details`: a longer form for the tool tip.
  void setCamera(const QString& text, const QString& details, bool is_known);
  /// `text`: how the shown light field was aligned, or why it cannot be.
  void setAlignment(const QString& text, bool can_rectify);

 signals:
  void calibrateRequested();
  void openCameraRequested();
  void saveCameraRequested();
  void rectifyRequested();
  void demoRequested();

 private:
  ElidedLabel* camera_;
  ElidedLabel* alignment_;
  QPushButton* lens_;
  QPushButton* rectify_;
  QAction* save_ = nullptr;
};

}  // namespace episcope
