// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QAbstractListModel>
#include <QHash>
#include <QImage>
#include <QString>
#include <QStringList>
#include <QWidget>

#include <vector>

class QAction;
class QComboBox;
class QLabel;
class QLineEdit;
class QListView;
class QSlider;
class QSortFilterProxyModel;

namespace episcope {

class ElidedLabel;
class FoldedLabel;
class SceneList;

/// The light fields of a folder: a sortable list with thumbnails and a text filter. Double click or
/// Return asks to open one.
class ScenePanel : public QWidget {
  Q_OBJECT

 public:
  /// `list` must outlive this.
  ScenePanel(SceneList* list, QWidget* parent);

  /// Action of the button beside the filter and in the empty panel.
  void setOpenAction(QAction* action);
  /// Shown folder; the count grows while it is being searched. Empty = none.
  void setFolder(const QString& folder, bool is_searching);
  /// Scrolls to a light field and selects it.
  void reveal(const QString& path);
  /// Path `step` rows from `path` among the shown light fields that can be opened; from a hidden
  /// path, the first or last of them. Empty if there is none.
  [[nodiscard]] QString neighbour(const QString& path, int step) const;

 signals:
  void openRequested(const QString& path);

 private:
  void buildRows();
  void showCount();
  /// Why the selected light field cannot be opened.
  void showProblem();
  void sort();
  [[nodiscard]] QString countText() const;

  SceneList* list_;
  QSortFilterProxyModel* shown_;
  QLineEdit* filter_;
  QComboBox* order_;
  QListView* view_;
  QLabel* hint_;
  FoldedLabel* problem_;
  ElidedLabel* folder_label_;
  ElidedLabel* count_;
  QWidget* head_;
  QString folder_;
  bool is_searching_ = false;
};

/// A slider over the frames of a sequence.
class TimeBar : public QWidget {
  Q_OBJECT

 public:
  explicit TimeBar(QWidget* parent = nullptr);

  /// Action of the play button, which takes its icon, tip and state.
  void setPlayAction(QAction* action);
  /// Shows frame `frame` of `count`; emits nothing.
  void setFrame(int frame, int count);

 signals:
  void frameChosen(int frame);

 private:
  void showNumber();

  QSlider* slider_;
  QLabel* number_;
};

struct SceneItem {
  QString path;  ///< Path to open; unique.
  QString name;
  QString form;        ///< "2013 archive"
  QString shape;       ///< "9×9 · 512×512 RGB"; empty = unknown.
  QStringList parts;   ///< "disparity of all views", "labels", "2 results".
  QString problem;     ///< Why it cannot be opened; empty = it can.
  qint64 samples = 0;  ///< Pixels of all views, to sort by.
  bool has_truth = false;
};

/// The light fields of a folder in the order found. Requests thumbnails when they are first
/// painted.
class SceneList : public QAbstractListModel {
  Q_OBJECT

 public:
  enum Role {
    kPath = Qt::UserRole + 1,
    kForm,
    kShape,
    kParts,
    kProblem,
    kSamples,
    kHasTruth,
    kIsOpen,
    kSearchText
  };

  using QAbstractListModel::QAbstractListModel;

  void clear();
  /// Adds a light field, or replaces the one with this path.
  void add(const SceneItem& item);
  /// Replaces all light fields; keeps thumbnails of remaining paths.
  void setItems(const std::vector<SceneItem>& items);
  void setThumbnail(const QString& path, const QImage& thumbnail);
  /// Marks the open light field; none if the path is unknown.
  void setOpen(const QString& path);
  [[nodiscard]] const SceneItem& item(int row) const { return rows_[row].item; }

  [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;

 signals:
  /// Emitted once per path while its row exists.
  void thumbnailWanted(const QString& path) const;

 private:
  struct Row {
    SceneItem item;
    QImage thumbnail;
    mutable bool is_asked = false;
  };

  [[nodiscard]] int rowOf(const QString& path) const { return places_.value(path, -1); }

  std::vector<Row> rows_;
  QHash<QString, int> places_;
  QString open_;
};

}  // namespace episcope
