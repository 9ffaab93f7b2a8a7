// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/panes.h"

#include "widgets/controls/layout.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QAccessible>
#include <QApplication>
#include <QCloseEvent>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMenu>
#include <QScrollArea>
#include <QSettings>
#include <QSpinBox>
#include <QSplitter>
#include <QStackedWidget>
#include <QTabBar>
#include <QTextEdit>

#include <algorithm>
#include <utility>

namespace episcope {
/// Window of a detached pane.
class PaneWindow : public QWidget {
  Q_OBJECT

 public:
  /// Takes the widget and stays above `owner`.
  // A tool window, so that the keys of its owner are heard in it.
  PaneWindow(QWidget* widget, const QString& title, QWidget* owner)
      : QWidget(owner, Qt::Tool | Qt::WindowMaximizeButtonHint | Qt::WindowCloseButtonHint) {
    setWindowTitle(title);
    make_column(this, {widget});
    widget->show();
  }

 signals:
  /// The user closed the window, which still holds the pane.
  void closed();

 protected:
  void closeEvent(QCloseEvent* event) override {
    event->accept();
    emit closed();
  }
};

namespace {

constexpr const char* kTorn = "layout/torn";
constexpr const char* kStacked = "layout/stacked";
constexpr const char* kByItself = "isDividedByItself";

QString place_key(const QString& id) {
  return "layout/place/" + id;
}

// Whether no other page is in front of a widget, in any set of tabs around it.
bool is_in_front(const QWidget& widget) {
  if (widget.isHidden()) return false;
  for (const QWidget* each = &widget; !each->isWindow() && each->parentWidget();
       each = each->parentWidget()) {
    const auto* pages = qobject_cast<const QStackedWidget*>(each->parentWidget());
    if (pages && pages->currentWidget() != each) return false;
  }
  return true;
}

// Main window of a widget, also for a widget in a detached pane.
const QWidget* main_window_of(const QWidget& widget) {
  const QWidget* window = widget.window();
  const auto* pane = qobject_cast<const PaneWindow*>(window);
  return pane && pane->parentWidget() ? pane->parentWidget()->window() : window;
}

}  // namespace

Panes::Panes(QWidget& home) : QObject(&home), home_(home) {}

Panes::~Panes() = default;

void Panes::setStack(TabStack* stack) {
  stack_ = stack;
  stack->serve(*this);
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
  auto* window = named("pane." + id, new PaneWindow(pane->widget, pane->title, home_.window()));
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
  return pane && is_in_front(pane->face ? *pane->face : *pane->widget);
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

bool is_divided_by_itself(const QSplitter& splitter) {
  return splitter.property(kByItself).toBool();
}

void set_divided_by_itself(QSplitter& splitter, bool is_by_itself) {
  splitter.setProperty(kByItself, is_by_itself);
}

TabStack::TabStack(QWidget* parent) : QTabWidget(parent) {
  setObjectName("tabs.stack");
  setDocumentMode(true);
  setTabsClosable(true);
  setUsesScrollButtons(false);
  tabBar()->setElideMode(Qt::ElideRight);
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
  menu.addAction(tr("Detach into a window"), panes_, [this, id] { panes_->tear(id); });
  menu.addAction(tr("Dock"), panes_, [this, id] { panes_->putBack(id); });
  menu.exec(tabBar()->mapToGlobal(at));
}

}  // namespace episcope

class QWidget;

namespace episcope {
namespace {

// Names a control for screen readers by the first line of its tool tip, if it has neither text,
// label nor name.
void name_for_readers(QWidget& control) {
  if (control.toolTip().isEmpty()) return;
  QAccessibleInterface* reader = QAccessible::queryAccessibleInterface(&control);
  if (!reader || !reader->text(QAccessible::Name).trimmed().isEmpty()) return;
  control.setAccessibleName(control.toolTip().section('\n', 0, 0));
}

bool is_control(const QWidget& widget) {
  return qobject_cast<const QAbstractButton*>(&widget) ||
         qobject_cast<const QAbstractItemView*>(&widget) ||
         qobject_cast<const QAbstractSlider*>(&widget) || qobject_cast<const QTabBar*>(&widget) ||
         qobject_cast<const QComboBox*>(&widget) ||
         qobject_cast<const QScrollArea*>(&widget);  // hears clicks on controls in it
}

bool is_field(const QWidget& widget) {
  const auto* combo = qobject_cast<const QComboBox*>(&widget);
  return qobject_cast<const QAbstractSpinBox*>(&widget) ||
         qobject_cast<const QLineEdit*>(&widget) || qobject_cast<const QTextEdit*>(&widget) ||
         (combo && combo->isEditable());
}

// A name that is edited in its list, which ends that itself on the same keys.
bool is_in_place(const QWidget& field) {
  for (const QWidget* each = field.parentWidget(); each; each = each->parentWidget()) {
    if (qobject_cast<const QAbstractItemView*>(each)) return true;
  }
  return false;
}

bool moves(const QKeyEvent& key) {
  switch (key.key()) {
    case Qt::Key_Left:
    case Qt::Key_Right:
    case Qt::Key_Up:
    case Qt::Key_Down:
    case Qt::Key_Home:
    case Qt::Key_End:
      return true;
    default:
      return false;
  }
}

bool presses(const QKeyEvent& key) {
  return key.key() == Qt::Key_Space || key.key() == Qt::Key_Return || key.key() == Qt::Key_Enter;
}

// Closes a list that has dropped down, which else would not keep the key from commands.
bool closes_list(QKeyEvent& key) {
  auto* list = QApplication::activePopupWidget();
  if (key.key() != Qt::Key_Escape || !list || qobject_cast<QMenu*>(list)) return false;
  key.accept();
  return list->close();
}

void drop_typed(QWidget& field) {
  if (auto* number = qobject_cast<QDoubleSpinBox*>(&field)) number->setValue(number->value());
  if (auto* number = qobject_cast<QSpinBox*>(&field)) number->setValue(number->value());
}

}  // namespace

KeyboardHome::KeyboardHome(QWidget& window, std::function<QWidget*()> home)
    : QObject(&window), window_(window), home_(std::move(home)) {
  QApplication::instance()->installEventFilter(this);
}

bool KeyboardHome::isOfWindow(const QObject* watched) const {
  return watched->isWidgetType() &&
         main_window_of(*static_cast<const QWidget*>(watched)) == &window_;
}

bool KeyboardHome::eventFilter(QObject* watched, QEvent* event) {
  switch (event->type()) {
    case QEvent::Polish:
    case QEvent::Show:  // some were polished before they came into the window
      if (isOfWindow(watched)) greet(*static_cast<QWidget*>(watched));
      return false;
    case QEvent::MouseButtonPress:
      if (isOfWindow(watched)) endTyping(*static_cast<QWidget*>(watched));
      return false;
    case QEvent::ShortcutOverride:
      if (closes_list(*static_cast<QKeyEvent*>(event))) return true;
      [[fallthrough]];
    case QEvent::KeyPress:
      return watched == QApplication::focusWidget() && isOfWindow(watched) &&
             hear(*static_cast<QWidget*>(watched), *static_cast<QKeyEvent*>(event));
    default:
      return false;
  }
}

void KeyboardHome::greet(QWidget& widget) {
  if (is_control(widget) || is_field(widget)) name_for_readers(widget);
  if (is_control(widget) && !is_field(widget) && widget.focusPolicy() != Qt::NoFocus) {
    widget.setFocusPolicy(Qt::TabFocus);
  }
}

// Applies typed input before any click.
void KeyboardHome::endTyping(const QWidget& clicked) {
  const QWidget* focus = QApplication::focusWidget();
  if (!focus || !is_field(*focus) || focus == &clicked || focus->isAncestorOf(&clicked)) return;
  if (isOfWindow(focus)) goHome();
}

bool KeyboardHome::hear(QWidget& widget, QKeyEvent& key) {
  if (key.type() == QEvent::ShortcutOverride) {
    if (!belongsTo(widget, key)) return false;
    key.accept();
    return true;
  }
  if (is_field(widget)) leave(widget, key.key());
  return false;
}

bool KeyboardHome::belongsTo(const QWidget& widget, const QKeyEvent& key) {
  if (key.modifiers() & (Qt::ControlModifier | Qt::AltModifier)) return false;
  if (is_field(widget)) return moves(key) || key.key() == Qt::Key_Escape;
  return is_control(widget) && (moves(key) || presses(key));
}

// Runs after the field has handled the key.
void KeyboardHome::leave(QWidget& field, int key) {
  const bool drops = key == Qt::Key_Escape;
  if (!drops && key != Qt::Key_Return && key != Qt::Key_Enter) return;
  if (qobject_cast<QTextEdit*>(&field) && !drops) return;
  if (is_in_place(field)) {
    connect(&field, &QObject::destroyed, this, &KeyboardHome::goHome, Qt::QueuedConnection);
    return;
  }
  if (drops) drop_typed(field);
  QMetaObject::invokeMethod(this, &KeyboardHome::goHome, Qt::QueuedConnection);
}

void KeyboardHome::goHome() {
  QWidget* home = home_();
  if (!home) return;
  // From a pane in a window of its own, the keyboard goes back to the main one.
  const QWidget* focus = QApplication::focusWidget();
  if (focus && focus->window() != &window_) window_.activateWindow();
  home->setFocus(Qt::OtherFocusReason);
}

void KeyboardHome::goHomeFromControls() {
  const QWidget* focus = QApplication::focusWidget();
  const bool stays = focus && (is_field(*focus) || qobject_cast<const QTabBar*>(focus));
  if (!stays) goHome();
}

}  // namespace episcope

#include "moc_panes.cpp"

#include "panes.moc"
