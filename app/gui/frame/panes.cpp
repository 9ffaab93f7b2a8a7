// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/panes.h"

#include "app/gui/frame/pane_window.h"
#include "app/gui/frame/tab_stack.h"

#include <QSettings>
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

// Where it was before does not hold it any more.
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

}  // namespace episcope

#include "moc_panes.cpp"
