// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/space/point_cloud.h"

#include <QPointF>
#include <QString>
#include <QWidget>

#include <array>
#include <optional>
#include <vector>

class QCheckBox;
class QLabel;
class QPushButton;
class QStackedLayout;
class QTableWidget;

namespace episcope {

class PhotographSteps;
class PointCloudView;

/// A pair as the table shows it.
struct CaptureRow {
  QString name;
  QPointF pixel;                 ///< Of the centre view.
  std::array<double, 3> point;   ///< Of the mesh.
  std::optional<double> off_px;  ///< From where the pose puts it; nothing without a pose.
  bool is_outlier = false;
};

/// Mesh, pairs and pose of the Capture tab. Setters never emit.
class CapturePanel : public QWidget {
  Q_OBJECT

 public:
  explicit CapturePanel(QWidget* parent = nullptr);

  /// `title`: what is known of the mesh, or why there is none.
  void setMesh(const QString& title, const PointCloud& cloud);
  void setRows(const std::vector<CaptureRow>& rows);
  /// What the next pair would be: the text of its pixel, its point if one is marked, and whether
  /// both are there.
  void setNext(const QString& pixel, const std::optional<std::array<double, 3>>& point,
               bool is_complete);
  /// What is known of the pose, or what is missing.
  void setPose(const QString& text, bool is_known);
  void setUndoable(bool is_undoable);
  /// Whether picks are to move to the corner or blob beside them.
  [[nodiscard]] bool snaps() const;
  [[nodiscard]] PhotographSteps* steps() const { return steps_; }
  [[nodiscard]] std::vector<int> selectedRows() const;

 signals:
  void openRequested();
  void importRequested();
  void exportRequested();
  void snapChanged();
  void addRequested();
  void removeRequested();
  void undoRequested();
  void renamed(int row, const QString& name);
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
  void rename(int row, int column);

  PhotographSteps* steps_;
  QLabel* mesh_;
  QLabel* hint_;
  QLabel* next_;
  QLabel* pose_;
  QCheckBox* snap_;
  QPushButton* add_;
  QPushButton* undo_;
  QTableWidget* table_;
  QStackedLayout* stack_;
  std::vector<QPushButton*> of_pose_;  // need one
  PointCloudView* view_ = nullptr;
};

}  // namespace episcope
