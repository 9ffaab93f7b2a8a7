// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QStyledItemDelegate>

namespace episcope {

/// Draws a second, quieter text in an item's row: at its right end, for which the first text is
/// elided, or in a column right of the longest first text.
class AsideDelegate : public QStyledItemDelegate {
  Q_OBJECT

 public:
  /// Role of the second text in the item's data.
  static constexpr int kAsideRole = Qt::UserRole + 100;

  enum class Place { End, Column };
  AsideDelegate(Place place, QObject* parent);

  void paint(QPainter* painter, const QStyleOptionViewItem& option,
             const QModelIndex& index) const override;
  [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& option,
                               const QModelIndex& index) const override;

 protected:
  void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override;

 private:
  /// Distance from the left edge to the second text.
  [[nodiscard]] int begin(const QStyleOptionViewItem& option, const QModelIndex& index) const;

  Place place_;
};

}  // namespace episcope
