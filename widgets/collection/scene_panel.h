// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>
#include <QWidget>

class QAction;
class QComboBox;
class QLabel;
class QLineEdit;
class QListView;
class QSortFilterProxyModel;

namespace episcope {

class ElidedLabel;
class SceneList;

/// The light fields of a folder: a list with thumbnails, filtered by a text and sorted. Double
/// click or Return asks to open one.
class ScenePanel : public QWidget {
  Q_OBJECT

 public:
  /// `list` must outlive this.
  ScenePanel(SceneList* list, QWidget* parent);

  /// The button beside the filter, and in the empty panel.
  void setOpenAction(QAction* action);
  /// Which folder is shown; while it is searched, the count goes on. Empty = none.
  void setFolder(const QString& folder, bool is_searching);
  /// Scrolls to a light field and selects it.
  void reveal(const QString& path);
  /// The path `step` rows from that of `path` among those shown that can be opened; of a path that
  /// is not shown, the first or last of them. Empty if there is none.
  [[nodiscard]] QString neighbour(const QString& path, int step) const;

 signals:
  void openRequested(const QString& path);

 private:
  void buildRows();
  void showCount();
  void sort();
  [[nodiscard]] QString countText() const;

  SceneList* list_;
  QSortFilterProxyModel* shown_;
  QLineEdit* filter_;
  QComboBox* order_;
  QListView* view_;
  QLabel* hint_;
  ElidedLabel* folder_label_;
  ElidedLabel* count_;
  QWidget* head_;
  QString folder_;
  bool is_searching_ = false;
};

}  // namespace episcope
