// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/annotate/annotation_bar.h"

#include "widgets/controls/elided_label.h"
#include "widgets/controls/tool_button.h"
#include "widgets/style/theme.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QStandardItemModel>
#include <QToolButton>
#include <QVBoxLayout>

namespace episcope {

AnnotationBar::AnnotationBar(QWidget* parent)
    : QWidget(parent),
      carried_(new QCheckBox(tr("Carry to all views by"), this)),
      by_(new QComboBox(this)),
      carry_state_(new ElidedLabel(this)),
      file_state_(new ElidedLabel(this, Qt::ElideMiddle)),
      buttons_(new QHBoxLayout) {
  setObjectName("annotationBar");
  carried_->setObjectName("carry.on");
  carried_->setToolTip(
      tr("Shows the scribbles of every view on all others, as stripes: carried along the rays, "
         "except where they are occluded. They never replace what you painted."));
  by_->setObjectName("carry.by");
  by_->addItem(tr("the shown estimate"), static_cast<int>(CarriedBy::Estimate));
  by_->addItem(tr("the ground truth"), static_cast<int>(CarriedBy::Truth));
  by_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  by_->setToolTip(tr("Disparity along which scribbles are carried"));
  carry_state_->setObjectName("carry.state");
  file_state_->setObjectName("annotation.file");
  auto* carry = new QHBoxLayout;
  carry->setSpacing(theme::kSpacing);
  carry->addWidget(carried_);
  carry->addWidget(by_, 1);
  buttons_->setSpacing(2);
  buttons_->addWidget(file_state_, 1);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, theme::kSpacing);
  layout->setSpacing(4);
  layout->addLayout(carry);
  layout->addWidget(carry_state_);
  layout->addLayout(buttons_);
  connect(carried_, &QCheckBox::toggled, this, &AnnotationBar::carriedEdited);
  connect(by_, &QComboBox::activated, this, [this] {
    is_chosen_ = true;
    emit carriedByEdited();
  });
  setSources(false, false);
  setCarryState({});
}

void AnnotationBar::addAction(QAction* action, const QString& object_name) {
  buttons_->insertWidget(buttons_->count() - 1, make_action_button(action, object_name, this));
}

void AnnotationBar::setSources(bool has_estimate, bool has_truth) {
  auto* model = qobject_cast<QStandardItemModel*>(by_->model());
  const bool has[] = {has_estimate, has_truth};
  for (int i = 0; i < 2; ++i) model->item(i)->setEnabled(has[i]);
  const int wanted = is_chosen_ ? by_->currentIndex() : 0;
  by_->setCurrentIndex(has[wanted] || !has[1 - wanted] ? wanted : 1 - wanted);
  by_->setEnabled(has_estimate || has_truth);
}

void AnnotationBar::setCarried(bool is_carried) {
  const QSignalBlocker blocker(carried_);
  carried_->setChecked(is_carried);
}

void AnnotationBar::setCarryState(const QString& state) {
  carry_state_->setFullText(state);
  carry_state_->setVisible(!state.isEmpty());
}

void AnnotationBar::setFileState(const QString& state) {
  file_state_->setFullText(state);
}

bool AnnotationBar::isCarried() const {
  return carried_->isChecked();
}

AnnotationBar::CarriedBy AnnotationBar::carriedBy() const {
  return static_cast<CarriedBy>(by_->currentData().toInt());
}

}  // namespace episcope

#include "moc_annotation_bar.cpp"
