// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/tool_button.h"

#include "widgets/controls/icon.h"
#include "widgets/controls/theme.h"

#include <QAction>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>

namespace episcope {

QToolButton* make_tool_button(const ToolButtonText& text, QWidget* parent) {
  auto* button = new QToolButton(parent);
  button->setObjectName(text.name);
  button->setIcon(themed_icon(text.icon));
  button->setIconSize({14, 14});
  button->setAutoRaise(true);
  button->setToolTip(text.tip);
  if (text.text.isEmpty()) {
    button->setAccessibleName(text.tip);
  } else {
    button->setText(text.text);
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  }
  return button;
}

QToolButton* make_action_button(QAction* action, const QString& object_name, QWidget* parent) {
  auto* button = new QToolButton(parent);
  button->setObjectName(object_name);
  button->setDefaultAction(action);
  button->setIconSize({16, 16});
  button->setAutoRaise(true);
  button->setFocusPolicy(Qt::NoFocus);
  return button;
}

void follow_tip(QWidget* widget, const QAction* action) {
  const auto follow = [widget, action] { widget->setToolTip(action->toolTip()); };
  QObject::connect(action, &QAction::changed, widget, follow);
  follow();
}

void lay_out_list(QWidget* panel, QLabel* hint, QWidget* list,
                  std::initializer_list<QToolButton*> buttons) {
  hint->setAlignment(Qt::AlignCenter);
  hint->setWordWrap(true);
  auto* row = new QHBoxLayout;
  row->setSpacing(2);
  for (auto* button : buttons) row->addWidget(button);
  row->addStretch(1);
  auto* layout = new QVBoxLayout(panel);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(4);
  layout->addWidget(hint, 1);
  layout->addWidget(list, 1);
  layout->addLayout(row);
}

FittingSplitter::FittingSplitter(int least_rest, QWidget* parent)
    : QSplitter(Qt::Vertical, parent), least_rest_(least_rest) {
  setChildrenCollapsible(false);
  connect(this, &QSplitter::splitterMoved, this, [this] { is_dragged_ = true; });
}

bool FittingSplitter::event(QEvent* event) {
  const bool is_handled = QSplitter::event(event);
  if (event->type() == QEvent::LayoutRequest) fit();
  return is_handled;
}

void FittingSplitter::resizeEvent(QResizeEvent* event) {
  QSplitter::resizeEvent(event);
  fit();
}

void FittingSplitter::fit() {
  if (is_dragged_ || count() != 2) return;
  const int room = height() - handleWidth();
  const int wanted = std::min(widget(0)->sizeHint().height(), room - least_rest_);
  setSizes({wanted, room - wanted});
}

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

QSize AsideDelegate::sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const {
  const QSize size = QStyledItemDelegate::sizeHint(option, index);
  const int aside = option.fontMetrics.horizontalAdvance(index.data(kAsideRole).toString());
  return {begin(option, index) + aside + kAsidePadding, size.height()};
}

}  // namespace episcope

#include "moc_tool_button.cpp"
