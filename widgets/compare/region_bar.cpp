// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/compare/region_bar.h"

#include "widgets/controls/elided_label.h"
#include "widgets/controls/tool_button.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

namespace episcope {

RegionBar::RegionBar(QWidget* parent)
    : QWidget(parent),
      part_(new QComboBox(this)),
      summary_(new ElidedLabel(this)),
      layout_(new QHBoxLayout(this)) {
  setObjectName("regionBar");
  part_->setObjectName("region.part");
  part_->setToolTip(tr("The pixels that the table and the plot are of"));
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

#include "moc_region_bar.cpp"
