// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/cloud/cloud_look.h"

#include <QPointF>
#include <QString>
#include <QStringList>
#include <QWidget>

#include <array>
#include <optional>
#include <vector>

class QAction;
class QCheckBox;
class QComboBox;
class QLabel;
class QPushButton;
class QStackedLayout;
class QTableWidget;
class QToolButton;

namespace episcope {

class CaptureObjects;
class ElidedLabel;
class PhotographSteps;
class PointCloudView;

/// A pair as the table shows it.
struct CaptureRow {
  QString name;
  QPointF pixel;                 ///< Of the centre view.
  std::array<double, 3> point;   ///< Of the mesh.
  std::optional<double> off_px;  ///< From where the pose puts it; nothing without a pose.
  bool is_outlier = false;
  bool is_locked = false;
};

/// Mesh, pairs and pose of the Capture tab. Setters never emit.
class CapturePanel : public QWidget {
  Q_OBJECT

 public:
  explicit CapturePanel(QWidget* parent = nullptr);

  /// The mesh of the current object; without parts a hint is shown.
  void setMesh(const CloudPartsPtr& mesh);
  void setRows(const std::vector<CaptureRow>& rows);
  /// What the next pair would be: the text of its pixel, its point if one is marked, and whether
  /// both are there.
  void setNext(const QString& pixel, const std::optional<std::array<double, 3>>& point,
               bool is_complete);
  /// Marks of the mesh: where the next pair would lie, and the pairs by name.
  void setPicked(const std::optional<std::array<double, 3>>& point);
  void setMarks(const std::vector<CloudMark>& marks);
  /// The row of the pair under the mouse elsewhere; none = none.
  void setHovered(std::optional<int> row);
  /// What is known of the pose, or what is missing.
  void setPose(const QString& text, bool is_known);
  void setUndoable(bool is_undoable);
  void setRedoable(bool is_redoable);
  /// Whether picks are to move to the corner or blob beside them.
  [[nodiscard]] bool snaps() const;
  [[nodiscard]] PhotographSteps* steps() const { return steps_; }
  [[nodiscard]] CaptureObjects* objects() const { return objects_; }
  [[nodiscard]] std::vector<int> selectedRows() const;
  /// It is selected, or under the mouse.
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
  /// Rows were selected, or the mouse is over another one.
  void emphasisChanged();
  /// A double click on a pair.
  void rowChosen(int row);
  /// A click on the mesh.
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

/// The things before the cameras, one of which is worked on, and its mesh. Setters never emit.
class CaptureObjects : public QWidget {
  Q_OBJECT

 public:
  explicit CaptureObjects(QWidget* parent = nullptr);

  /// `current`: place of the one that is worked on.
  void setObjects(const QStringList& names, int current);
  /// What is known of its mesh; empty = there is none.
  void setMesh(const QString& text);

 signals:
  void chosen(int object);
  /// The current one, by typing.
  void renamed(const QString& name);
  void addRequested();
  void removeRequested();
  void openMeshRequested();

 private:
  QComboBox* names_;
  QPushButton* remove_;
  ElidedLabel* mesh_;
};

/// The steps from photographs to a rectified light field: what each has brought, and what can be
/// done. Setters never emit.
class PhotographSteps : public QWidget {
  Q_OBJECT

 public:
  explicit PhotographSteps(QWidget* parent = nullptr);

  /// `text`: what is known of the lens; `details`: the same at length, the tool tip of its button.
  void setCamera(const QString& text, const QString& details, bool is_known);
  /// `text`: how the light field that is shown came to be aligned, or why it cannot be.
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
