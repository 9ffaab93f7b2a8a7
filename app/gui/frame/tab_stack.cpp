// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/tab_stack.h"

#include "app/gui/frame/panes.h"

#include <QMenu>
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
  addTab(pane, title);
  setCurrentWidget(pane);
  show();
}

void TabStack::release(QWidget* pane) {
  removeTab(indexOf(pane));
  setVisible(count() > 0);
}

QString TabStack::paneAt(int index) const {
  return panes_ ? panes_->stackedPane(widget(index)) : QString();
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
