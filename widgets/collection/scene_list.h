// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QAbstractListModel>
#include <QHash>
#include <QImage>
#include <QString>
#include <QStringList>

#include <vector>

namespace episcope {

/// One light field as the list shows it.
struct SceneItem {
  QString path;  ///< What opens it; unique.
  QString name;
  QString form;        ///< "archive"
  QString shape;       ///< "9×9 · 512×512 RGB"; empty = unknown.
  QStringList parts;   ///< "disparity of all views", "labels", "2 results": what it comes with.
  QString problem;     ///< Why it cannot be opened; empty = it can.
  qint64 samples = 0;  ///< Pixels of all views, to sort by.
  bool has_truth = false;
};

/// The light fields of a folder, in the order in which they were found. Thumbnails are asked for
/// when they are first to be painted.
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
  /// A light field of the same path is replaced.
  void add(const SceneItem& item);
  /// Replaces all; thumbnails of the same paths stay.
  void setItems(const std::vector<SceneItem>& items);
  void setThumbnail(const QString& path, const QImage& thumbnail);
  /// Marks the light field that is open; none if there is no such path.
  void setOpen(const QString& path);
  [[nodiscard]] const SceneItem& item(int row) const { return rows_[row].item; }

  [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;

 signals:
  /// Emitted once for each path, as long as its row exists.
  void thumbnailWanted(const QString& path) const;

 private:
  struct Row {
    SceneItem item;
    QImage thumbnail;
    mutable bool is_asked = false;
  };

  [[nodiscard]] int rowOf(const QString& path) const;

  std::vector<Row> rows_;
  QHash<QString, int> places_;
  QString open_;
};

}  // namespace episcope
