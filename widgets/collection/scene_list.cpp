// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/collection/scene_list.h"

#include <utility>

namespace episcope {
namespace {

QString tool_tip(const SceneItem& item) {
  QStringList lines{item.name, item.path};
  if (!item.shape.isEmpty()) lines += QString("%1 · %2").arg(item.form, item.shape);
  lines += item.parts;
  if (!item.problem.isEmpty()) lines += item.problem;
  return lines.join('\n').toHtmlEscaped().replace('\n', "<br>");
}

}  // namespace

void SceneList::clear() {
  beginResetModel();
  rows_.clear();
  places_.clear();
  endResetModel();
}

int SceneList::rowOf(const QString& path) const {
  return places_.value(path, -1);
}

void SceneList::add(const SceneItem& item) {
  const int row = rowOf(item.path);
  if (row >= 0) {
    rows_[row].item = item;
    emit dataChanged(index(row), index(row));
    return;
  }
  const int last = static_cast<int>(rows_.size());
  beginInsertRows({}, last, last);
  places_[item.path] = last;
  rows_.push_back({item, {}});
  endInsertRows();
}

void SceneList::setItems(const std::vector<SceneItem>& items) {
  QHash<QString, int> wanted;
  for (const SceneItem& item : items) wanted[item.path] = 0;
  for (int row = static_cast<int>(rows_.size()) - 1; row >= 0; --row) {
    if (wanted.contains(rows_[row].item.path)) continue;
    beginRemoveRows({}, row, row);
    rows_.erase(rows_.begin() + row);
    endRemoveRows();
  }
  places_.clear();
  for (int row = 0; row < static_cast<int>(rows_.size()); ++row) {
    places_[rows_[row].item.path] = row;
  }
  for (const SceneItem& item : items) add(item);
}

void SceneList::setThumbnail(const QString& path, const QImage& thumbnail) {
  const int row = rowOf(path);
  if (row < 0) return;
  rows_[row].thumbnail = thumbnail;
  emit dataChanged(index(row), index(row), {Qt::DecorationRole});
}

void SceneList::setOpen(const QString& path) {
  const int before = rowOf(std::exchange(open_, path));
  for (const int row : {before, rowOf(path)}) {
    if (row >= 0) emit dataChanged(index(row), index(row), {kIsOpen});
  }
}

int SceneList::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

QVariant SceneList::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const Row& row = rows_[index.row()];
  const SceneItem& item = row.item;
  switch (role) {
    case Qt::DisplayRole:
      return item.name;
    case Qt::DecorationRole:
      if (row.thumbnail.isNull() && !row.is_asked && item.problem.isEmpty()) {
        row.is_asked = true;
        emit thumbnailWanted(item.path);
      }
      return row.thumbnail;
    case Qt::ToolTipRole:
      return tool_tip(item);
    case kPath:
      return item.path;
    case kForm:
      return item.form;
    case kShape:
      return item.shape;
    case kParts:
      return item.parts;
    case kProblem:
      return item.problem;
    case kSamples:
      return item.samples;
    case kHasTruth:
      return item.has_truth;
    case kIsOpen:
      return item.path == open_;
    case kSearchText:
      return QStringList{item.path, item.form, item.shape, item.parts.join(' '), item.problem}.join(
          '\n');
    default:
      return {};
  }
}

}  // namespace episcope

#include "moc_scene_list.cpp"
