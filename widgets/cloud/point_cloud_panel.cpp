// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/cloud/point_cloud_panel.h"

#include "widgets/style/theme.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>

namespace episcope {

PointCloudPanel::PointCloudPanel(QWidget* parent)
    : QWidget(parent),
      display_(new CloudDisplay(this)),
      controls_(new CloudControls(this)),
      elsewhere_(new QLabel(this)),
      buttons_(new QHBoxLayout),
      rows_(new QVBoxLayout(this)) {
  setObjectName("pointCloudPanel");
  elsewhere_->setObjectName("cloud.elsewhere");
  elsewhere_->setAlignment(Qt::AlignCenter);
  elsewhere_->setWordWrap(true);
  elsewhere_->hide();
  addPresets();
  rows_->setContentsMargins(theme::kMargin, theme::kMargin, theme::kMargin, theme::kMargin);
  rows_->setSpacing(theme::kSpacing);
  rows_->addWidget(display_, 1);
  rows_->addWidget(elsewhere_, 1);
  rows_->addLayout(buttons_);
  rows_->addWidget(controls_);
  controls_->setEnabled(isAvailable());
  if (!isAvailable()) return;
  display_->view()->setLook(controls_->look());
  connect(controls_, &CloudControls::lookChanged, this,
          [this] { display_->view()->setLook(controls_->look()); });
}

void PointCloudPanel::addPresets() {
  struct Row {
    CloudPreset preset;
    const char* name;
    QString text;
  };
  const Row rows[] = {{CloudPreset::Front, "cloud.front", tr("Front")},
                      {CloudPreset::Tilted, "cloud.tilted", tr("Tilted")},
                      {CloudPreset::Side, "cloud.side", tr("Side")}};
  buttons_->setSpacing(theme::kSpacing);
  for (const auto& [preset, name, text] : rows) {
    auto* button = new QToolButton(this);
    button->setObjectName(name);
    button->setText(text);
    button->setEnabled(isAvailable());
    buttons_->addWidget(button);
    connect(button, &QToolButton::clicked, this, [this, preset = preset] {
      if (isAvailable()) display_->view()->showPreset(preset);
    });
  }
  buttons_->addStretch(1);
}

void PointCloudPanel::addButton(QWidget* button) {
  buttons_->addWidget(button);
}

void PointCloudPanel::lendDisplay(const QString& where) {
  elsewhere_->setText(where);
  elsewhere_->show();
}

void PointCloudPanel::takeDisplayBack() {
  elsewhere_->hide();
  rows_->insertWidget(0, display_, 1);
  display_->show();
}

}  // namespace episcope

#include "moc_point_cloud_panel.cpp"
