// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/frame.h"

#include "app/gui/shell/panes.h"
#include "app/session/session.h"
#include "widgets/canvas/canvas_geometry.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/theme.h"

#include <QEvent>
#include <QMenu>
#include <QPointer>
#include <QSplitter>
#include <QTabBar>
#include <QTabWidget>
#include <QToolButton>
#include <QtMath>

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

constexpr int kWidest = 760;  // longer lines are hard to read

int height_of(const QWidget& widget, int width) {
  return widget.hasHeightForWidth() ? widget.heightForWidth(width) : widget.sizeHint().height();
}

}  // namespace

/// Floats widgets at the top of an area, below its captions and below each other, each as high as
/// it needs to be, so that nothing moves when they come and go.
class Floating : public QObject {
  Q_OBJECT

 public:
  /// `parent` becomes the widgets' parent and outlives this.
  explicit Floating(QWidget& parent) : QObject(&parent), parent_(parent) { setArea(&parent); }

  /// Lets the widgets float over this descendant of the parent; the default is the parent.
  void setArea(QWidget* area) {
    area_ = area;
    area->installEventFilter(this);
    place();
  }

  /// Adds a widget below the others and reparents it.
  void add(QWidget* widget) {
    const bool was_hidden = widget->isHidden();
    widget->setParent(&parent_);
    widget->setVisible(!was_hidden);
    widget->installEventFilter(this);
    widgets_.emplace_back(widget);
    place();
  }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    switch (event->type()) {
      case QEvent::Resize:
      case QEvent::Move:
        if (watched == area_) place();
        break;
      case QEvent::Show:
      case QEvent::Hide:
      case QEvent::LayoutRequest:
        if (watched != area_) place();
        break;
      default:
        break;
    }
    return false;
  }

 private:
  void place() {
    if (!area_) return;
    const int width = std::min(kWidest, area_->width() - 2 * theme::kMargin);
    const int top = qCeil(caption_depth(QFontMetricsF(parent_.font()))) + theme::kSpacing;
    QPoint corner = area_->mapTo(&parent_, QPoint((area_->width() - width) / 2, top));
    for (QWidget* widget : widgets_) {
      if (!widget || widget->isHidden()) continue;
      const int height = height_of(*widget, width);
      widget->setGeometry(QRect(corner, QSize(width, height)));
      widget->raise();
      corner.ry() += height + theme::kSpacing;
    }
  }

  QWidget& parent_;
  QPointer<QWidget> area_;
  std::vector<QPointer<QWidget>> widgets_;
};

namespace {

constexpr int kColumnWidth = 205;
constexpr int kColumnShare = 7;  // of the room that the column shares with the view
constexpr int kStageWidth = 720;
constexpr int kTabsWidth = 384;

QString pane_id(const QString& tab) {
  return "tab." + tab;
}

// Lists all tabs, also those that are scrolled away or hidden.
QToolButton* make_list_of_tabs(Frame& frame, QWidget* parent) {
  auto* button = named("tabs.list", new QToolButton(parent));
  button->setAccessibleName(Frame::tr("All tabs"));
  button->setToolTip(Frame::tr("All tabs"));
  button->setArrowType(Qt::DownArrow);
  button->setAutoRaise(true);
  button->setFocusPolicy(Qt::NoFocus);
  auto* menu = new QMenu(button);
  QObject::connect(menu, &QMenu::aboutToShow, &frame, [&frame, menu] {
    menu->clear();
    for (const Tab& tab : frame.tabs()) {
      menu->addAction(tab.title, &frame, [&frame, id = tab.id] { frame.showTab(id); });
    }
  });
  // No menu of the button's own, whose arrow would stand beside this one.
  QObject::connect(button, &QToolButton::clicked, menu, [button, menu] {
    menu->popup(button->mapToGlobal(QPoint(0, button->height())));
  });
  return button;
}

void set_up(QTabWidget& book) {
  book.setDocumentMode(true);
  // What is not seen whole is in the list of all tabs; nothing scrolls away.
  book.setUsesScrollButtons(false);
  book.tabBar()->setElideMode(Qt::ElideRight);
  // A neighbor nobody asked for might be one that lets the mouse paint.
  book.tabBar()->setSelectionBehaviorOnRemove(QTabBar::SelectPreviousTab);
  book.tabBar()->setContextMenuPolicy(Qt::CustomContextMenu);
}

// The tabs, and below them the stacked panes.
QSplitter* make_books(QTabWidget* tabs, TabStack* stack, QWidget* parent) {
  auto* split = named("split.side", new QSplitter(Qt::Vertical, parent));
  split->setChildrenCollapsible(false);
  for (QTabWidget* book : {tabs, static_cast<QTabWidget*>(stack)}) {
    split->addWidget(book);
    split->setStretchFactor(split->indexOf(book), 1);
  }
  return split;
}

}  // namespace

Frame::Frame(QWidget* parent)
    : QWidget(parent),
      viewer_(named("viewer", new QWidget(this))),
      column_(named("split.column", new QSplitter(Qt::Vertical, viewer_))),
      browser_(named("split.browser", new ToldSplitter([this] { fitColumn(); }))),
      floating_(new Floating(*viewer_)),
      panes_(new Panes(*this)) {
  column_->setChildrenCollapsible(false);
  browser_->addWidget(column_);
  browser_->setStretchFactor(0, 0);
  make_column(viewer_, {browser_});

  side_ = new QWidget(this);
  book_ = named("tabs", new QTabWidget(side_));
  set_up(*book_);
  book_->setCornerWidget(make_list_of_tabs(*this, book_), Qt::TopRightCorner);
  auto* stack = new TabStack(side_);
  panes_->setStack(stack);
  right_ = new QVBoxLayout(side_);
  right_->setContentsMargins(theme::kSpacing / 2, 0, theme::kSpacing / 2, 0);
  right_->addWidget(make_books(book_, stack, side_), 1);

  auto* split = named("split.tabs", new QSplitter(Qt::Horizontal, this));
  split->addWidget(viewer_);
  split->addWidget(side_);
  split->setStretchFactor(0, 1);
  split->setStretchFactor(1, 0);
  split->setSizes({kColumnWidth + kStageWidth, kTabsWidth});
  split->setChildrenCollapsible(false);

  rows_ = new QVBoxLayout(this);
  rows_->setContentsMargins(0, 0, 0, 0);
  rows_->setSpacing(2);
  rows_->addWidget(split, 1);
  connect(book_, &QTabWidget::currentChanged, this, [this] { emit tabShown(shownTab()); });
  connect(panes_, &Panes::changed, this, [this](const QString& id) {
    for (const Tab& tab : tabs_) {
      const bool has_moved = pane_id(tab.id) == id || pane_id(tab.task) == id;
      if (has_moved && panes_->isSeen(pane_id(tab.id))) emit tabShown(tab.id);
    }
  });
  follow(*book_);
}

void Frame::follow(QTabWidget& book) {
  connect(book.tabBar(), &QTabBar::customContextMenuRequested, this,
          [this, &book](QPoint at) { askWhereTabGoes(book, at); });
  connect(book.tabBar(), &QTabBar::tabBarDoubleClicked, this, [this, &book](int index) {
    if (const Tab* tab = tabOf(book.widget(index))) panes_->tear(pane_id(tab->id));
  });
}

void Frame::askWhereTabGoes(const QTabWidget& book, const QPoint& at) {
  const Tab* tab = tabOf(book.widget(book.tabBar()->tabAt(at)));
  if (!tab) return;
  QMenu menu(this);
  menu.addAction(tr("Detach into a window"), this,
                 [this, id = pane_id(tab->id)] { panes_->tear(id); });
  menu.addAction(tr("Below the other tabs"), this,
                 [this, id = pane_id(tab->id)] { panes_->stack(id); });
  menu.exec(book.tabBar()->mapToGlobal(at));
}

void Frame::addToColumn(QWidget* widget, bool stretches) {
  const int place = stretches ? column_->count() : fixed_count_++;
  column_->insertWidget(place, widget);
  column_->setStretchFactor(place, stretches ? 1 : 0);
}

void Frame::setViewerArea(QWidget* viewer_area) {
  browser_->addWidget(viewer_area);
  floating_->setArea(viewer_area);
  browser_->setStretchFactor(1, 1);  // what a larger window gives belongs to the view
  browser_->setSizes({kColumnWidth, kStageWidth});
  set_divided_by_itself(*browser_, true);
  connect(browser_, &QSplitter::splitterMoved, this,
          [this] { set_divided_by_itself(*browser_, false); });
}

// On a large screen, the column has room for its texts, until the user drags its edge.
void Frame::fitColumn() {
  if (!is_divided_by_itself(*browser_)) return;
  const int width = std::max(kColumnWidth, browser_->width() / kColumnShare);
  browser_->setSizes({width, browser_->width() - browser_->handleWidth() - width});
}

void Frame::addTab(const Tab& tab) {
  tabs_.push_back(tab);
  if (!tab.task.isEmpty()) {
    panes_->add({pane_id(tab.id), tab.title, tab.widget, [this, id = tab.id] { showTab(id); }});
    if (tab.waits) return keepAside(tab.widget);
    pagesOf(*findTab(tab.task))->addTab(tab.widget, tab.title);
    return;
  }
  QWidget* pane = tab.page.isEmpty() ? tab.widget : makePages(tab);
  panes_->add({pane_id(tab.id), tab.title, pane, [this, id = tab.id] { putInBook(*findTab(id)); },
               tab.widget});
  if (tab.waits) return keepAside(pane);
  book_->addTab(pane, tab.title);
}

// Not among the others, invisible: behind an invisible last one, Qt scrolls too far.
void Frame::keepAside(QWidget* pane) {
  pane->setParent(side_);
  pane->hide();
}

QTabWidget* Frame::makePages(const Tab& task) {
  auto* pages = named("pages." + task.id, new QTabWidget(side_));
  set_up(*pages);
  pages->setTabBarAutoHide(true);
  pages->addTab(task.widget, task.page);
  pages_[task.id] = pages;
  follow(*pages);
  connect(pages, &QTabWidget::currentChanged, this, [this, pages] {
    const Tab* page = tabOf(pages->currentWidget());
    if (page && panes_->isSeen(pane_id(page->id))) emit tabShown(page->id);
  });
  return pages;
}

QTabWidget* Frame::pagesOf(const Tab& task) const {
  const auto found = pages_.find(task.id);
  return found == pages_.end() ? nullptr : found->second;
}

int Frame::placeIn(const QTabWidget& book, const Tab& tab) const {
  int place = 0;
  for (const Tab& each : tabs_) {
    if (each.id == tab.id) break;
    const QWidget* pages = pagesOf(each);
    if (book.indexOf(each.widget) >= 0 || (pages && book.indexOf(pages) >= 0)) ++place;
  }
  return place;
}

void Frame::putInBook(const Tab& tab) {
  QTabWidget* pages = pagesOf(tab);
  QWidget* pane = pages ? pages : tab.widget;
  book_->setCurrentIndex(book_->insertTab(placeIn(*book_, tab), pane, tab.title));
}

const Tab* Frame::findTab(const QString& id) const {
  const auto found = std::ranges::find(tabs_, id, &Tab::id);
  return found == tabs_.end() ? nullptr : &*found;
}

// A tab with pages is known by them and by its own one.
const Tab* Frame::tabOf(const QWidget* widget) const {
  const auto found = std::ranges::find_if(tabs_, [this, widget](const Tab& tab) {
    return widget && (widget == tab.widget || widget == pagesOf(tab));
  });
  return found == tabs_.end() ? nullptr : &*found;
}

void Frame::addToTab(const QString& id, QWidget* widget) {
  const Tab* tab = findTab(id);
  if (tab && tab->room) tab->room->addWidget(widget);
}

void Frame::addLine(Line line, QWidget* widget) {
  lines_[line] = widget;
  const auto after = std::distance(lines_.find(line), lines_.end()) - 1;
  rows_->insertWidget(rows_->count() - static_cast<int>(after), widget);
}

void Frame::addFloating(QWidget* widget) {
  floating_->add(widget);
}

void Frame::setPanelsShown(bool are_shown) {
  column_->setVisible(are_shown);
  side_->setVisible(are_shown);
}

// Brings a detached or stacked pane to the front; false if it is at its place.
bool Frame::raisePane(const QString& id) {
  if (panes_->isTorn(id)) {
    panes_->tear(id);  // raises its window
    return true;
  }
  setPanelsShown(true);
  if (panes_->isStacked(id)) panes_->stack(id);
  return panes_->isStacked(id);
}

// Who asks for a tab wants to see it.
void Frame::showTab(const QString& id) {
  const Tab* tab = findTab(id);
  if (!tab) return setPanelsShown(true);
  const Tab* task = tab->task.isEmpty() ? tab : findTab(tab->task);
  QTabWidget* pages = pagesOf(*task);
  const bool is_alone = tab != task && pages->indexOf(tab->widget) < 0;
  if (is_alone && raisePane(pane_id(id))) return;
  if (is_alone) pages->insertTab(placeIn(*pages, *tab), tab->widget, tab->title);
  if (pages) pages->setCurrentWidget(tab->widget);
  if (raisePane(pane_id(task->id))) return;
  QWidget* pane = pages ? pages : task->widget;
  book_->indexOf(pane) < 0 ? putInBook(*task) : book_->setCurrentWidget(pane);
}

QString Frame::shownTab() const {
  const QWidget* shown = book_->currentWidget();
  const Tab* task = tabOf(shown);
  const Tab* tab = task && pagesOf(*task) ? tabOf(pagesOf(*task)->currentWidget()) : task;
  return tab ? tab->id : QString();
}

Messages::Messages(Frame& frame, Session& session) : bar_(new MessageBar(&frame)) {
  frame.addFloating(bar_);
  session.on_changed([this](Parts parts) {
    if (parts.has(Part::Scene)) retract(std::exchange(of_light_field_, {}));
  });
}

void Messages::warn(const QString& sentence) {
  bar_->showMessage(Severity::Warning, sentence);
}

void Messages::warn(const QString& sentence, const QString& button, std::function<void()> run) {
  bar_->showMessage(Severity::Warning, sentence, {button, std::move(run)});
}

void Messages::offer(const QString& sentence, const QString& button, std::function<void()> run) {
  bar_->showMessage(Severity::Info, sentence, {button, std::move(run)});
}

bool Messages::isShown(const QString& sentence) const {
  return !bar_->isHidden() && bar_->text() == sentence;
}

}  // namespace episcope

#include "moc_frame.cpp"

#include "frame.moc"
