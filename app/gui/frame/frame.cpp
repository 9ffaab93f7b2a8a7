// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/frame.h"

#include "app/gui/frame/floating.h"
#include "widgets/style/theme.h"

#include <QSplitter>
#include <QTabWidget>
#include <QVBoxLayout>

#include <algorithm>

namespace episcope {
namespace {

constexpr int kColumnWidth = 205;
constexpr int kStageWidth = 720;
constexpr int kTabsWidth = 372;

}  // namespace

Frame::Frame(QWidget* parent)
    : QWidget(parent),
      viewer_(new QWidget(this)),
      column_(new QSplitter(Qt::Vertical, viewer_)),
      browser_(new QSplitter(Qt::Horizontal, viewer_)),
      floating_(new Floating(*viewer_)) {
  viewer_->setObjectName("viewer");
  column_->setChildrenCollapsible(false);
  browser_->addWidget(column_);
  browser_->setStretchFactor(0, 0);
  auto* viewer_layout = new QVBoxLayout(viewer_);
  viewer_layout->setContentsMargins(0, 0, 0, 0);
  viewer_layout->addWidget(browser_);

  side_ = new QWidget(this);
  book_ = new QTabWidget(side_);
  book_->setObjectName("tabs");
  book_->setDocumentMode(true);
  right_ = new QVBoxLayout(side_);
  right_->setContentsMargins(0, 0, theme::kSpacing, 0);
  right_->addWidget(book_, 1);

  auto* split = new QSplitter(Qt::Horizontal, this);
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
}

void Frame::addToColumn(QWidget* widget, bool stretches) {
  const int place = stretches ? column_->count() : fixed_count_++;
  column_->insertWidget(place, widget);
  column_->setStretchFactor(place, stretches ? 1 : 0);
}

void Frame::setStage(QWidget* stage) {
  browser_->addWidget(stage);
  floating_->setArea(stage);
  browser_->setStretchFactor(1, 1);  // what a larger window gives belongs to the view
  browser_->setSizes({kColumnWidth, kStageWidth});
}

void Frame::addTab(const Tab& tab) {
  tabs_.push_back(tab);
  const int place = book_->addTab(tab.widget, tab.title);
  if (tab.waits) book_->setTabVisible(place, false);
}

void Frame::addToTab(const QString& id, QWidget* widget) {
  const auto found = std::ranges::find(tabs_, id, &Tab::id);
  if (found != tabs_.end() && found->room) found->room->addWidget(widget);
}

void Frame::addUnderTabs(QWidget* widget) {
  right_->addWidget(widget);
}

void Frame::addLine(Line line, QWidget* widget) {
  lines_[line] = widget;
  const auto place = std::distance(lines_.begin(), lines_.find(line));
  rows_->insertWidget(1 + static_cast<int>(place), widget);
}

void Frame::addFloating(QWidget* widget) {
  floating_->add(widget);
}

void Frame::setPanelsShown(bool are_shown) {
  column_->setVisible(are_shown);
  side_->setVisible(are_shown);
}

bool Frame::arePanelsShown() const {
  return !side_->isHidden();
}

// Who asks for a tab wants to see it.
void Frame::showTab(const QString& id) {
  setPanelsShown(true);
  const auto found = std::ranges::find(tabs_, id, &Tab::id);
  if (found == tabs_.end()) return;
  book_->setTabVisible(book_->indexOf(found->widget), true);
  book_->setCurrentWidget(found->widget);
}

QString Frame::shownTab() const {
  const int index = book_->currentIndex();
  return index >= 0 && index < static_cast<int>(tabs_.size()) ? tabs_[index].id : QString();
}

}  // namespace episcope

#include "moc_frame.cpp"
