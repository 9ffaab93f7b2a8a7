// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/cloud/point_cloud_panel.h"

#include "widgets/controls/color_ramp.h"
#include "widgets/controls/tool_button.h"
#include "widgets/style/number_text.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QSignalBlocker>
#include <QSlider>
#include <QStackedLayout>
#include <QStandardItemModel>
#include <QToolButton>
#include <QVBoxLayout>

#include <cmath>

namespace episcope {
namespace {

constexpr int kStretchSteps = 50;  // Of the slider, for a factor of 10 either way.

double stretch_factor(int position) {
  return std::pow(10.0, 1.0 * position / kStretchSteps);
}

}  // namespace

PointCloudPanel::PointCloudPanel(QWidget* parent)
    : QWidget(parent),
      coloring_(new QComboBox(this)),
      stretch_(new QSlider(Qt::Horizontal, this)),
      count_(new QLabel(this)),
      hint_(new QLabel(this)),
      stack_(new QStackedLayout) {
  setObjectName("pointCloudPanel");
  coloring_->setObjectName("cloud.coloring");
  coloring_->setToolTip(tr("Colour of the points"));
  coloring_->addItem(tr("image"), static_cast<int>(CloudColoring::Image));
  coloring_->addItem(tr("disparity"), static_cast<int>(CloudColoring::Disparity));
  coloring_->addItem(tr("error"), static_cast<int>(CloudColoring::Error));
  stretch_->setObjectName("cloud.stretch");
  stretch_->setRange(-kStretchSteps, kStretchSteps);
  stretch_->setToolTip(tr("Stretch along the line of sight"));
  count_->setObjectName("cloud.count");
  hint_->setObjectName("cloud.hint");
  hint_->setAlignment(Qt::AlignCenter);
  hint_->setWordWrap(true);

  QWidget* made = make_point_cloud_view(this);
  view_ = qobject_cast<PointCloudView*>(made);
  if (view_) {
    connect(view_, &PointCloudView::pointPicked, this, [this](std::size_t point) {
      if (point < pixels_.size()) emit pixelPicked(pixels_[point]);
    });
  }
  stack_->addWidget(hint_);
  stack_->addWidget(made);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(theme::kSpacing);
  layout->addLayout(makePresets());
  layout->addLayout(stack_, 1);
  layout->addWidget(makeLegend());
  layout->addLayout(makeStretch());
  connect(coloring_, &QComboBox::activated, this, [this] { emit coloringSelected(coloring()); });
  connect(stretch_, &QSlider::valueChanged, this, [this](int position) {
    if (view_) view_->setZStretch(stretch_factor(position));
  });
  setErrorAvailable(false);
  setCloud({}, {});
}

QHBoxLayout* PointCloudPanel::makePresets() {
  auto* row = new QHBoxLayout;
  row->setSpacing(theme::kSpacing);
  row->addWidget(new QLabel(tr("Colour"), this));
  row->addWidget(coloring_, 1);
  struct Button {
    CloudPreset preset;
    const char* name;
    QString text;
  };
  const Button buttons[] = {{CloudPreset::Front, "cloud.front", tr("Front")},
                            {CloudPreset::Tilted, "cloud.tilted", tr("Tilted")},
                            {CloudPreset::Side, "cloud.side", tr("Side")}};
  for (const auto& button : buttons) {
    auto* tool = new QToolButton(this);
    tool->setObjectName(button.name);
    tool->setText(button.text);
    tool->setEnabled(view_ != nullptr);
    row->addWidget(tool);
    connect(tool, &QToolButton::clicked, this, [this, preset = button.preset] {
      if (view_) view_->showPreset(preset);
    });
  }
  return row;
}

QHBoxLayout* PointCloudPanel::makeStretch() {
  auto* reset = make_tool_button({"cloud.stretchReset", "reset", tr("No stretch")}, this);
  connect(reset, &QToolButton::clicked, this, [this] { stretch_->setValue(0); });
  stretch_->setEnabled(view_ != nullptr);
  reset->setEnabled(view_ != nullptr);
  auto* row = new QHBoxLayout;
  row->setSpacing(theme::kSpacing);
  row->addWidget(new QLabel(tr("Stretch z"), this));
  row->addWidget(stretch_, 1);
  row->addWidget(reset);
  row->addWidget(count_);
  return row;
}

QWidget* PointCloudPanel::makeLegend() {
  legend_ = new QWidget(this);
  legend_->setObjectName("cloud.legend");
  legend_title_ = new QLabel(legend_);
  legend_min_ = new QLabel(legend_);
  legend_max_ = new QLabel(legend_);
  ramp_ = new ColorRamp(legend_);
  auto* row = new QHBoxLayout(legend_);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(theme::kSpacing);
  row->addWidget(legend_title_);
  row->addWidget(legend_min_);
  row->addWidget(ramp_, 1);
  row->addWidget(legend_max_);
  legend_->hide();
  return legend_;
}

void PointCloudPanel::setLegend(const QString& title, const render::Shading& shading) {
  legend_title_->setText(title);
  legend_min_->setText(number_text(shading.range.min, 2));
  legend_max_->setText(number_text(shading.range.max, 2));
  ramp_->setShading(shading);
  legend_->setVisible(!title.isEmpty());
}

void PointCloudPanel::setCloud(const PointCloud& cloud, const QString& hint) {
  hint_->setText(hint.isEmpty() ? tr("Run a method to see its result in 3D.") : hint);
  count_->setText(cloud.positions.empty()
                      ? QString()
                      : tr("%1 points").arg(QLocale().toString(quint64(cloud.positions.size()))));
  pixels_ = cloud.pixels;
  if (view_) view_->setCloud(cloud);
  stack_->setCurrentIndex(view_ && cloud.positions.empty() ? 0 : 1);
}

void PointCloudPanel::setColoring(CloudColoring coloring) {
  const QSignalBlocker blocker(coloring_);
  coloring_->setCurrentIndex(coloring_->findData(static_cast<int>(coloring)));
}

void PointCloudPanel::setErrorAvailable(bool available) {
  auto* model = qobject_cast<QStandardItemModel*>(coloring_->model());
  model->item(coloring_->findData(static_cast<int>(CloudColoring::Error)))->setEnabled(available);
}

CloudColoring PointCloudPanel::coloring() const {
  return static_cast<CloudColoring>(coloring_->currentData().toInt());
}

}  // namespace episcope

#include "moc_point_cloud_panel.cpp"
