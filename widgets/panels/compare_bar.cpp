// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/compare_bar.h"

#include "widgets/controls/labels.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QAction>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>

namespace episcope {
namespace {

QComboBox* make_combo(const char* name, const QString& tip, QWidget* parent) {
  auto* combo = new QComboBox(parent);
  combo->setObjectName(name);
  combo->setToolTip(tip);
  combo->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  combo->setMinimumWidth(90);
  combo->setMaxVisibleItems(20);
  return combo;
}

QLabel* make_badge(Side side, QWidget* parent) {
  auto* badge = new QLabel(parent);
  badge->setPixmap(side_icon(side).pixmap(18, 18));
  badge->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
  return badge;
}

void fill(QComboBox* combo, const std::vector<CompareBar::Choice>& choices, quint64 current,
          const QString& placeholder) {
  const QSignalBlocker blocker(combo);
  combo->clear();
  for (const auto& choice : choices) {
    combo->addItem(choice.name, choice.id);
    combo->setItemData(combo->count() - 1, choice.name, Qt::ToolTipRole);
  }
  combo->setPlaceholderText(placeholder);
  combo->setCurrentIndex(combo->findData(current));
}

}  // namespace

CompareBar::CompareBar(QWidget* parent)
    : QWidget(parent),
      a_(make_combo("compare.a", tr("A: the result shown"), this)),
      b_(make_combo("compare.b", tr("B: the result it is compared with"), this)),
      buttons_(new QHBoxLayout) {
  setObjectName("compareBar");
  buttons_->setSpacing(2);
  auto* row = new QHBoxLayout;
  row->setSpacing(theme::kSpacing);
  row->addWidget(make_badge(Side::A, this));
  row->addWidget(a_, 1);
  row->addSpacing(theme::kSpacing);
  row->addWidget(make_badge(Side::B, this));
  row->addWidget(b_, 1);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, theme::kSpacing, 0, 0);
  layout->setSpacing(theme::kSpacing);
  layout->addLayout(row);
  layout->addLayout(buttons_);
  buttons_->addStretch(1);
  connect(a_, &QComboBox::activated, this,
          [this] { emit aChosen(a_->currentData().toULongLong()); });
  connect(b_, &QComboBox::activated, this,
          [this] { emit bChosen(b_->currentData().toULongLong()); });
}

void CompareBar::addAction(QAction* action, const QString& object_name) {
  buttons_->insertWidget(buttons_->count() - 1, make_action_button(action, object_name, this));
}

void CompareBar::setChoices(const std::vector<Choice>& choices, quint64 a, quint64 b,
                            const QString& other) {
  fill(a_, choices, a, tr("no result"));
  fill(b_, choices, b, other);
  a_->setEnabled(choices.size() > 1);
  b_->setEnabled(choices.size() > 1);
}

RegionBar::RegionBar(QWidget* parent)
    : QWidget(parent),
      part_(new QComboBox(this)),
      summary_(new ElidedLabel(this)),
      layout_(new QHBoxLayout(this)) {
  setObjectName("regionBar");
  part_->setObjectName("region.part");
  part_->setToolTip(tr("Pixels that the table and the plot evaluate"));
  part_->setAccessibleName(tr("Judged part of the view"));
  summary_->setObjectName("region.summary");
  auto* label = new QLabel(tr("Judged:"), this);
  label->setBuddy(part_);
  layout_->setContentsMargins(0, theme::kSpacing, 0, 0);
  layout_->setSpacing(theme::kSpacing);
  layout_->addWidget(label);
  layout_->addWidget(part_);
  layout_->addWidget(summary_, 1);
  connect(part_, &QComboBox::activated, this, &RegionBar::partChosen);
}

void RegionBar::addAction(QAction* action, const QString& object_name) {
  layout_->addWidget(make_action_button(action, object_name, this));
}

void RegionBar::setParts(const QStringList& names) {
  const int current = part_->currentIndex();
  part_->clear();
  part_->addItems(names);
  part_->setCurrentIndex(current);
}

void RegionBar::setCurrent(int part) {
  part_->setCurrentIndex(part);
}

void RegionBar::setSummary(const QString& text) {
  summary_->setFullText(text);
}

QString RegionBar::summary() const {
  return summary_->fullText();
}

}  // namespace episcope

#include "moc_compare_bar.cpp"
