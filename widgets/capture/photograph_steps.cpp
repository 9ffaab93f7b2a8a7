// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/capture/photograph_steps.h"

#include "widgets/controls/elided_label.h"
#include "widgets/style/theme.h"

#include <QGridLayout>
#include <QMenu>
#include <QPushButton>

namespace episcope {
namespace {

ElidedLabel* make_state(QWidget* parent, const char* name) {
  auto* label = new ElidedLabel(parent, Qt::ElideRight);
  label->setObjectName(name);
  return label;
}

}  // namespace

PhotographSteps::PhotographSteps(QWidget* parent)
    : QWidget(parent),
      camera_(make_state(this, "capture.camera")),
      alignment_(make_state(this, "capture.alignment")),
      lens_(new QPushButton(tr("Lens"), this)),
      rectify_(new QPushButton(tr("Rectify…"), this)) {
  rectify_->setObjectName("capture.rectify");
  rectify_->setToolTip(
      tr("Makes a light field of the photographs that are open: without distortion, rows and "
         "columns aligned. Pairs picked in them are carried over."));
  lens_->setObjectName("capture.lens");
  auto* menu = new QMenu(lens_);
  connect(menu->addAction(tr("Calibrate from photographs…")), &QAction::triggered, this,
          &PhotographSteps::calibrateRequested);
  connect(menu->addAction(tr("Open a camera…")), &QAction::triggered, this,
          &PhotographSteps::openCameraRequested);
  save_ = menu->addAction(tr("Save the camera…"));
  connect(save_, &QAction::triggered, this, &PhotographSteps::saveCameraRequested);
  menu->addSeparator();
  connect(menu->addAction(tr("Make a demo to try it with…")), &QAction::triggered, this,
          &PhotographSteps::demoRequested);
  lens_->setMenu(menu);
  connect(rectify_, &QPushButton::clicked, this, &PhotographSteps::rectifyRequested);

  auto* layout = new QGridLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setVerticalSpacing(theme::kSpacing / 2);
  layout->setColumnStretch(0, 1);
  layout->addWidget(camera_, 0, 0);
  layout->addWidget(lens_, 0, 1);
  layout->addWidget(alignment_, 1, 0);
  layout->addWidget(rectify_, 1, 1);
  setCamera({}, {}, false);
  setAlignment({}, false);
}

void PhotographSteps::setCamera(const QString& text, const QString& details, bool is_known) {
  camera_->setFullText(text.isEmpty() ? tr("No lens calibrated") : text);
  const QString help = tr("Calibrates the camera from photographs of a flat pattern");
  lens_->setToolTip(details.isEmpty() ? help : details);
  save_->setEnabled(is_known);
}

void PhotographSteps::setAlignment(const QString& text, bool can_rectify) {
  alignment_->setFullText(text);
  rectify_->setEnabled(can_rectify);
}

}  // namespace episcope

#include "moc_photograph_steps.cpp"
