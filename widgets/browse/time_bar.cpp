// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/browse/time_bar.h"

#include "widgets/controls/tool_button.h"
#include "widgets/style/theme.h"

#include <QAction>
#include <QHBoxLayout>
#include <QLabel>
#include <QMouseEvent>
#include <QSignalBlocker>
#include <QSlider>
#include <QStyle>
#include <QStyleOptionSlider>
#include <QToolButton>

#include <algorithm>

namespace episcope {
namespace {

constexpr int kFramesPerPage = 10;

/// A click beside the handle goes to that frame, not a page nearer to it.
class TimeSlider : public QSlider {
 public:
  using QSlider::QSlider;

 protected:
  void mousePressEvent(QMouseEvent* event) override {
    QStyleOptionSlider option;
    initStyleOption(&option);
    const QPoint at = event->position().toPoint();
    const auto part = style()->hitTestComplexControl(QStyle::CC_Slider, &option, at, this);
    if (event->button() != Qt::LeftButton || part == QStyle::SC_SliderHandle) {
      QSlider::mousePressEvent(event);
      return;
    }
    const int handle = style()->pixelMetric(QStyle::PM_SliderLength, &option, this);
    setValue(QStyle::sliderValueFromPosition(minimum(), maximum(), at.x() - handle / 2,
                                             width() - handle, option.upsideDown));
  }
};

}  // namespace

TimeBar::TimeBar(QWidget* parent)
    : QWidget(parent), slider_(new TimeSlider(Qt::Horizontal, this)), number_(new QLabel(this)) {
  setObjectName("timeBar");
  slider_->setObjectName("time.slider");
  slider_->setAccessibleName(tr("Frame"));
  slider_->setToolTip(tr("Frame of the sequence"));
  number_->setObjectName("time.number");
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(theme::kMargin, 0, theme::kMargin, 0);
  row->setSpacing(theme::kSpacing);
  row->addWidget(slider_, 1);
  row->addWidget(number_);
  connect(slider_, &QSlider::valueChanged, this, [this](int frame) {
    showNumber();
    emit frameChosen(frame);
  });
}

void TimeBar::setPlayAction(QAction* action) {
  auto* button = make_action_button(action, "time.play", this);
  static_cast<QHBoxLayout*>(layout())->insertWidget(0, button);
}

void TimeBar::setFrame(int frame, int count) {
  const QSignalBlocker blocker(slider_);
  slider_->setRange(0, count - 1);
  slider_->setPageStep(std::clamp(count / kFramesPerPage, 1, kFramesPerPage));
  slider_->setValue(frame);
  const QString widest = tr("frame %1 of 0…%2").arg(count - 1).arg(count - 1);
  number_->setMinimumWidth(number_->fontMetrics().horizontalAdvance(widest));
  showNumber();
}

void TimeBar::showNumber() {
  number_->setText(tr("frame %1 of 0…%2").arg(slider_->value()).arg(slider_->maximum()));
}

}  // namespace episcope

#include "moc_time_bar.cpp"
