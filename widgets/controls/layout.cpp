// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/layout.h"

#include <QAction>
#include <QComboBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QStandardItemModel>
#include <QToolButton>
#include <QTreeWidget>
#include <QVBoxLayout>

#include <algorithm>

namespace episcope {

namespace {

template <class Layout>
Layout* fill(Layout* layout, std::initializer_list<LayoutPart> parts, const LayoutLook& look) {
  layout->setContentsMargins(look.margins);
  layout->setSpacing(look.spacing);
  for (const LayoutPart& part : parts) {
    if (part.widget) {
      layout->addWidget(part.widget, part.share);
    } else if (part.layout) {
      layout->addLayout(part.layout, part.share);
    } else {
      layout->addStretch(part.share);
    }
  }
  return layout;
}

}  // namespace

QVBoxLayout* make_column(QWidget* place, std::initializer_list<LayoutPart> parts,
                         const LayoutLook& look) {
  return fill(new QVBoxLayout(place), parts, look);
}

QHBoxLayout* make_row(QWidget* place, std::initializer_list<LayoutPart> parts,
                      const LayoutLook& look) {
  return fill(new QHBoxLayout(place), parts, look);
}

QHBoxLayout* make_row(std::initializer_list<LayoutPart> parts, const LayoutLook& look) {
  return make_row(nullptr, parts, look);
}

QGridLayout* make_grid(QWidget* place, int horizontal_spacing, int vertical_spacing) {
  auto* grid = new QGridLayout(place);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(horizontal_spacing);
  grid->setVerticalSpacing(vertical_spacing);
  return grid;
}

QDialogButtonBox* make_answers(QDialog* dialog, const QString& name, const QString& text) {
  auto* answers = new QDialogButtonBox(QDialogButtonBox::Cancel, dialog);
  named(name, answers->addButton(text, QDialogButtonBox::AcceptRole))->setDefault(true);
  QObject::connect(answers, &QDialogButtonBox::accepted, dialog, &QDialog::accept);
  QObject::connect(answers, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
  return answers;
}

QTreeWidget* make_list(const QString& name, const QString& accessible_name, QWidget* parent) {
  auto* list = named(name, new QTreeWidget(parent));
  list->setAccessibleName(accessible_name);
  list->setRootIsDecorated(false);
  list->setUniformRowHeights(true);
  list->setTextElideMode(Qt::ElideMiddle);
  list->setEditTriggers(QAbstractItemView::NoEditTriggers);
  list->header()->setStretchLastSection(false);
  list->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  return list;
}

QAction* add_delete_action(QWidget* list) {
  auto* action = new QAction(list);
  action->setShortcut(QKeySequence::Delete);
  action->setShortcutContext(Qt::WidgetShortcut);
  list->addAction(action);
  return action;
}

void set_item_enabled(QComboBox* box, int item, bool is_enabled) {
  qobject_cast<QStandardItemModel*>(box->model())->item(item)->setEnabled(is_enabled);
}

void set_up_scrolling(QScrollArea* area) {
  area->setFrameShape(QFrame::NoFrame);
  area->setWidgetResizable(true);
  area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
}

void lay_out_list(QWidget* panel, QLabel* hint, QWidget* list,
                  std::initializer_list<QToolButton*> buttons) {
  hint->setAlignment(Qt::AlignCenter);
  hint->setWordWrap(true);
  auto* row = new QHBoxLayout;
  row->setSpacing(2);
  for (auto* button : buttons) row->addWidget(button);
  row->addStretch(1);
  make_column(panel, {{hint, 1}, {list, 1}, row}, {.spacing = 4});
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

}  // namespace episcope

#include "moc_layout.cpp"
