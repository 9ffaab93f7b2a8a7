// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QStyledItemDelegate>

namespace episcope {

/// Draws a second, quieter text in the row of an item: at its right end, or in a column right of
/// the longest first text.
class AsideDelegate : public QStyledItemDelegate {
  Q_OBJECT

 public:
  /// Of the item's data: the second text.
  static constexpr int kAsideRole = Qt::UserRole + 100;

  enum class Place { End, Column };
  AsideDelegate(Place place, QObject* parent);

  void paint(QPainter* painter, const QStyleOptionViewItem& option,
             const QModelIndex& index) const override;
  [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& option,
                               const QModelIndex& index) const override;

 private:
  /// From the left edge to where the second text may begin.
  [[nodiscard]] int begin(const QStyleOptionViewItem& option, const QModelIndex& index) const;

  Place place_;
};

}  // namespace episcope
