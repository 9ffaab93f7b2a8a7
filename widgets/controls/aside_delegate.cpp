// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/aside_delegate.h"

#include "widgets/controls/theme.h"

#include <QPainter>

#include <algorithm>

namespace episcope {

namespace {

constexpr int kAsideGap = 14;
constexpr int kAsidePadding = 4;

}  // namespace

AsideDelegate::AsideDelegate(Place place, QObject* parent)
    : QStyledItemDelegate(parent), place_(place) {}

int AsideDelegate::begin(const QStyleOptionViewItem& option, const QModelIndex& index) const {
  if (place_ == Place::End) {
    return QStyledItemDelegate::sizeHint(option, index).width() + kAsideGap;
  }
  int widest = 0;
  for (int row = 0; row < index.model()->rowCount(index.parent()); ++row) {
    const QModelIndex each = index.siblingAtRow(row);
    widest = std::max(widest, QStyledItemDelegate::sizeHint(option, each).width());
  }
  return widest + kAsideGap;
}

void AsideDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option,
                          const QModelIndex& index) const {
  QStyledItemDelegate::paint(painter, option, index);
  const QRect rect = option.rect.adjusted(begin(option, index), 0, -kAsidePadding, 0);
  const bool is_selected = option.state.testFlag(QStyle::State_Selected);
  painter->save();
  painter->setFont(option.font);
  painter->setPen(is_selected ? option.palette.color(QPalette::HighlightedText)
                              : theme::muted_text(option.palette));
  const QString text = option.fontMetrics.elidedText(index.data(kAsideRole).toString(),
                                                     Qt::ElideRight, rect.width());
  const auto side = place_ == Place::End ? Qt::AlignRight : Qt::AlignLeft;
  painter->drawText(rect, Qt::AlignVCenter | side | Qt::TextSingleLine, text);
  painter->restore();
}

void AsideDelegate::initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const {
  QStyledItemDelegate::initStyleOption(option, index);
  if (place_ == Place::Column) return;
  const int aside = option->fontMetrics.horizontalAdvance(index.data(kAsideRole).toString());
  const int room = option->rect.width() - aside - kAsideGap - 4 * kAsidePadding;
  option->text = option->fontMetrics.elidedText(option->text, option->textElideMode, room);
}

QSize AsideDelegate::sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const {
  const QSize size = QStyledItemDelegate::sizeHint(option, index);
  if (place_ == Place::End) return {0, size.height()};  // no wider than the list
  const int aside = option.fontMetrics.horizontalAdvance(index.data(kAsideRole).toString());
  return {begin(option, index) + aside + kAsidePadding, size.height()};
}

}  // namespace episcope

#include "moc_aside_delegate.cpp"
