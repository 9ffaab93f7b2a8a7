// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/cloud/cloud_display.h"

#include <QLabel>
#include <QStackedLayout>

#include <algorithm>

namespace episcope {

CloudDisplay::CloudDisplay(QWidget* parent)
    : QWidget(parent), hint_(new QLabel(this)), stack_(new QStackedLayout(this)) {
  setObjectName("cloud.display");
  hint_->setObjectName("cloud.hint");
  hint_->setAlignment(Qt::AlignCenter);
  hint_->setWordWrap(true);
  QWidget* made = make_point_cloud_view(this);
  view_ = qobject_cast<PointCloudView*>(made);
  stack_->addWidget(hint_);
  stack_->addWidget(made);
  stack_->setCurrentWidget(view_ ? static_cast<QWidget*>(hint_) : made);
  if (!view_) return;
  connect(view_, &PointCloudView::pointPicked, this, [this](std::size_t point, std::size_t part) {
    const auto& pixels = (*parts_)[part].all.pixels;
    if (point < pixels.size()) emit pixelPicked(pixels[point]);
  });
}

void CloudDisplay::setParts(const CloudPartsPtr& parts, const QString& hint) {
  parts_ = parts;
  hint_->setText(hint);
  if (!view_) return;
  view_->setParts(parts);
  stack_->setCurrentIndex(view_->pointCount() == 0 ? 0 : 1);
}

void CloudDisplay::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  emit shown();
}

void CloudDisplay::hideEvent(QHideEvent* event) {
  QWidget::hideEvent(event);
  emit hidden();
}

}  // namespace episcope

#include "moc_cloud_display.cpp"
