// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/panes.h"

#include <QCloseEvent>
#include <QMenu>
#include <QScrollArea>
#include <QSettings>
#include <QSplitter>
#include <QTabBar>
#include <QVBoxLayout>
#include <QWidget>

#include <algorithm>

namespace episcope {
namespace {

constexpr const char* kTorn = "layout/torn";
constexpr const char* kStacked = "layout/stacked";

QString place_key(const QString& id) {
  return "layout/place/" + id;
}

}  // namespace

Panes::Panes(QWidget& home) : QObject(&home), home_(home) {}

Panes::~Panes() = default;

void Panes::setStack(TabStack* stack) {
  stack_ = stack;
  stack->serve(*this);
}

void Panes::add(Pane pane) {
  panes_.push_back(std::move(pane));
}

const Pane* Panes::find(const QString& id) const {
  const auto found = std::ranges::find(panes_, id, &Pane::id);
  return found == panes_.end() ? nullptr : &*found;
}

void Panes::tear(const QString& id) {
  if (const auto open = windows_.constFind(id); open != windows_.constEnd()) {
    (*open)->raise();
    (*open)->activateWindow();
    return;
  }
  const Pane* pane = find(id);
  if (!pane) return;
  const QSize size = pane->widget->size();
  const QPoint corner = pane->widget->mapToGlobal(QPoint());
  leave(id);
  auto* window = new PaneWindow(pane->widget, pane->title, home_.window());
  window->setObjectName("pane." + id);
  if (!window->restoreGeometry(QSettings().value(place_key(id)).toByteArray())) {
    window->resize(size);
    window->move(corner);
  }
  windows_[id] = window;
  connect(window, &PaneWindow::closed, this, [this, id] { putBack(id); });
  window->show();
  emit opened(window);
  emit changed(id);
}

void Panes::stack(const QString& id) {
  const Pane* pane = find(id);
  if (!pane || !stack_) return;
  if (isStacked(id)) return stack_->bringToFront(pane->widget);
  leave(id);
  stacked_ << id;
  stack_->take(pane->widget, pane->title);
  emit changed(id);
}

bool Panes::isSeen(const QString& id) const {
  const Pane* pane = find(id);
  if (!pane) return false;
  return isStacked(id) ? stack_->isInFront(pane->widget) : !pane->widget->isHidden();
}

QString Panes::stackedPane(const QWidget* widget) const {
  for (const Pane& pane : panes_) {
    if (widget && pane.widget == widget && isStacked(pane.id)) return pane.id;
  }
  return {};
}

// Removes a pane from its present place.
void Panes::leave(const QString& id) {
  if (isTorn(id)) {
    remember(id);
    PaneWindow* window = windows_.take(id);
    find(id)->widget->setParent(&home_);
    window->hide();
    window->deleteLater();
  } else if (isStacked(id)) {
    stacked_.removeAll(id);
    stack_->release(find(id)->widget);
  }
}

void Panes::putBack(const QString& id) {
  const Pane* pane = find(id);
  if (!pane || (!isTorn(id) && !isStacked(id))) return;
  leave(id);
  pane->put_back();
  emit changed(id);
}

void Panes::toggle(const QString& id) {
  isTorn(id) ? putBack(id) : tear(id);
}

void Panes::toggleStacked(const QString& id) {
  isStacked(id) ? putBack(id) : stack(id);
}

void Panes::remember(const QString& id) const {
  QSettings().setValue(place_key(id), windows_[id]->saveGeometry());
}

void Panes::save() const {
  for (const QString& id : windows_.keys()) remember(id);
  QSettings().setValue(kTorn, QStringList(windows_.keys()));
  QSettings().setValue(kStacked, stacked_);
}

void Panes::restore() {
  for (const QString& id : QSettings().value(kStacked).toStringList()) stack(id);
  for (const QString& id : QSettings().value(kTorn).toStringList()) tear(id);
}

void Panes::reset() {
  for (const QString& id : windows_.keys() + stacked_) putBack(id);
  QSettings().remove(kTorn);
  QSettings().remove(kStacked);
  QSettings().remove("layout/place");
}

// A tool window, so that the keys of its owner are heard in it.
PaneWindow::PaneWindow(QWidget* widget, const QString& title, QWidget* owner)
    : QWidget(owner, Qt::Tool | Qt::WindowMaximizeButtonHint | Qt::WindowCloseButtonHint) {
  setWindowTitle(title);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(widget);
  widget->show();
}

void PaneWindow::closeEvent(QCloseEvent* event) {
  event->accept();
  emit closed();
}

const QWidget* main_window_of(const QWidget& widget) {
  const QWidget* window = widget.window();
  const auto* pane = qobject_cast<const PaneWindow*>(window);
  return pane && pane->parentWidget() ? pane->parentWidget()->window() : window;
}

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

// Shares the height with the tabs evenly, since an empty scroll area has no useful size hint.
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

#include "moc_panes.cpp"
