// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/tab_stack.h"

#include "app/gui/frame/panes.h"

#include <QMenu>
#include <QScrollArea>
#include <QSplitter>
#include <QTabBar>

namespace episcope {

TabStack::TabStack(QWidget* parent) : QTabWidget(parent) {
  setObjectName("tabs.stack");
  setDocumentMode(true);
  setTabsClosable(true);
  setUsesScrollButtons(true);
  tabBar()->setElideMode(Qt::ElideNone);
  tabBar()->setContextMenuPolicy(Qt::CustomContextMenu);
  connect(tabBar(), &QTabBar::customContextMenuRequested, this, &TabStack::askWhereTabGoes);
  hide();
}

void TabStack::serve(Panes& panes) {
  panes_ = &panes;
  connect(this, &QTabWidget::tabCloseRequested, &panes,
          [this](int index) { panes_->putBack(paneAt(index)); });
  connect(tabBar(), &QTabBar::tabBarDoubleClicked, &panes,
          [this](int index) { panes_->tear(paneAt(index)); });
  connect(this, &QTabWidget::currentChanged, &panes, [this](int index) {
    const QString id = paneAt(index);
    if (!id.isEmpty()) emit panes_->changed(id);
  });
}

void TabStack::take(QWidget* pane, const QString& title) {
  auto* area = new QScrollArea;
  area->setFrameShape(QFrame::NoFrame);
  area->setWidgetResizable(true);
  area->setWidget(pane);
  pane->show();
  setCurrentIndex(addTab(area, title));
  const bool was_hidden = isHidden();
  show();
  if (was_hidden) takeHalf();
}

// Of what it shares with the tabs: its own size hint is that of an empty scroll area.
void TabStack::takeHalf() {
  auto* split = qobject_cast<QSplitter*>(parentWidget());
  if (!split) return;
  const int half = split->height() / 2;
  split->setSizes({half, half});
}

int TabStack::placeOf(const QWidget* pane) const {
  for (int i = 0; i < count(); ++i) {
    if (static_cast<const QScrollArea*>(widget(i))->widget() == pane) return i;
  }
  return -1;
}

void TabStack::bringToFront(QWidget* pane) {
  setCurrentIndex(placeOf(pane));
}

bool TabStack::isInFront(const QWidget* pane) const {
  return currentIndex() >= 0 && placeOf(pane) == currentIndex();
}

void TabStack::release(QWidget* pane) {
  auto* area = static_cast<QScrollArea*>(widget(placeOf(pane)));
  area->takeWidget()->setParent(parentWidget());
  removeTab(indexOf(area));
  area->deleteLater();
  setVisible(count() > 0);
}

QString TabStack::paneAt(int index) const {
  const auto* area = static_cast<const QScrollArea*>(widget(index));
  return panes_ && area ? panes_->stackedPane(area->widget()) : QString();
}

void TabStack::askWhereTabGoes(const QPoint& at) {
  const QString id = paneAt(tabBar()->tabAt(at));
  if (id.isEmpty()) return;
  QMenu menu(this);
  menu.addAction(tr("In a window of its own"), panes_, [this, id] { panes_->tear(id); });
  menu.addAction(tr("Back to its place"), panes_, [this, id] { panes_->putBack(id); });
  menu.exec(tabBar()->mapToGlobal(at));
}

}  // namespace episcope

#include "moc_tab_stack.cpp"
