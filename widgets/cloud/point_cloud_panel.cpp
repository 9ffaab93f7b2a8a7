// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/cloud/point_cloud_panel.h"

#include "widgets/controls/layout.h"
#include "widgets/controls/number_spin.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QSignalBlocker>
#include <QSlider>
#include <QStackedLayout>
#include <QToolButton>
#include <QVBoxLayout>

#include <cmath>
#include <tuple>
#include <utility>

namespace episcope {

PointCloudPanel::PointCloudPanel(QWidget* parent)
    : QWidget(parent),
      display_(new CloudDisplay(this)),
      controls_(new CloudControls(this)),
      elsewhere_(named("cloud.elsewhere", new QLabel(this))),
      buttons_(new QHBoxLayout),
      rows_(new QVBoxLayout(this)) {
  setObjectName("pointCloudPanel");
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
    auto* button = named(name, new QToolButton(this));
    button->setText(text);
    button->setEnabled(isAvailable());
    buttons_->addWidget(button);
    connect(button, &QToolButton::clicked, this, [this, preset = preset] {
      if (isAvailable()) display_->view()->showPreset(preset);
    });
  }
  buttons_->addStretch(1);
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

CloudDisplay::CloudDisplay(QWidget* parent)
    : QWidget(parent),
      hint_(named("cloud.hint", new QLabel(this))),
      stack_(new QStackedLayout(this)) {
  setObjectName("cloud.display");
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

namespace {

constexpr int kStretchSteps = 50;  // Of the slider, for a factor of 10 either way.
constexpr int kSizeSteps = 4;      // Of the slider, for a logical pixel.
constexpr int kMostPixels = 10;    // Of a point.
constexpr int kClipSteps = 200;

double stretch_factor(int position) {
  return std::pow(10.0, 1.0 * position / kStretchSteps);
}

int stretch_position(double factor) {
  return static_cast<int>(std::lround(kStretchSteps * std::log10(factor)));
}

template <class Value>
void choose(QComboBox& combo, Value value) {
  combo.setCurrentIndex(combo.findData(static_cast<int>(value)));
}

template <class Value>
Value chosen(const QComboBox& combo) {
  return static_cast<Value>(combo.currentData().toInt());
}

template <class Value>
void offer(QComboBox& combo, Value value, bool is_offered) {
  set_item_enabled(&combo, combo.findData(static_cast<int>(value)), is_offered);
}

}  // namespace

CloudControls::CloudControls(QWidget* parent)
    : QWidget(parent),
      coloring_(named("cloud.coloring", new QComboBox(this))),
      companion_(named("cloud.companion", new QComboBox(this))),
      arrangement_(named("cloud.arrangement", new QComboBox(this))),
      surface_(named("cloud.surface", new QCheckBox(tr("Surface"), this))),
      shaded_(named("cloud.shaded", new QCheckBox(tr("Lit"), this))),
      jump_(named("cloud.jump", new NumberSpin(this))),
      summary_(named("cloud.summary", new QLabel(this))) {
  setObjectName("cloud.controls");
  auto* grid = make_grid(this, theme::kSpacing, 3);
  addColoring(*grid);
  addCompanion(*grid);
  addSurface(*grid);
  addLook(*grid);
  summary_->setWordWrap(true);
  summary_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  grid->addWidget(summary_, grid->rowCount(), 0, 1, 4);
  grid->setColumnStretch(1, 1);
  grid->setColumnStretch(3, 1);
}

void CloudControls::addColoring(QGridLayout& grid) {
  coloring_->setToolTip(tr("Color of the points"));
  coloring_->setAccessibleName(tr("Color"));
  const std::pair<CloudColoring, QString> rows[] = {
      {CloudColoring::Image, tr("view")},        {CloudColoring::Disparity, tr("disparity")},
      {CloudColoring::Error, tr("error")},       {CloudColoring::Labels, tr("labels")},
      {CloudColoring::Distance, tr("distance")}, {CloudColoring::Source, tr("one each")}};
  for (const auto& [value, text] : rows) coloring_->addItem(text, static_cast<int>(value));
  coloring_->setItemData(static_cast<int>(CloudColoring::Distance),
                         tr("Distance of each point to the nearest point of the ground truth or of "
                            "the other result, in units of the scene"),
                         Qt::ToolTipRole);
  connect(coloring_, &QComboBox::currentIndexChanged, this, &CloudControls::choiceChanged);
  grid.addWidget(new QLabel(tr("Color"), this), 0, 0);
  grid.addWidget(coloring_, 0, 1);
}

void CloudControls::addCompanion(QGridLayout& grid) {
  companion_->setToolTip(tr("Shown together with the result"));
  companion_->setAccessibleName(tr("Shown with the result"));
  companion_->addItem(tr("nothing else"), static_cast<int>(CloudCompanion::None));
  companion_->addItem(tr("the ground truth"), static_cast<int>(CloudCompanion::Truth));
  companion_->addItem(tr("B"), static_cast<int>(CloudCompanion::Other));
  companion_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  companion_->setMinimumContentsLength(8);
  arrangement_->setToolTip(tr("Where the two stand"));
  arrangement_->setAccessibleName(tr("Arrangement"));
  arrangement_->addItem(tr("in one place"), 0);
  arrangement_->addItem(tr("side by side"), 1);
  for (auto* combo : {companion_, arrangement_}) {
    connect(combo, &QComboBox::currentIndexChanged, this, [this] {
      arrangement_->setEnabled(choice().companion != CloudCompanion::None);
      emit choiceChanged();
    });
  }
  arrangement_->setEnabled(false);
  grid.addWidget(new QLabel(tr("With"), this), 0, 2);
  grid.addWidget(companion_, 0, 3);
  grid.addWidget(arrangement_, 1, 3);
}

void CloudControls::addSurface(QGridLayout& grid) {
  surface_->setToolTip(tr("Joins neighboring points to a surface, which is cut at jumps"));
  shaded_->setToolTip(tr("Lights the surface from where you look"));
  jump_->setAccessibleName(tr("Jump at which the surface is cut"));
  jump_->setToolTip(
      tr("Points are not joined if their disparities differ by more than this, in px per pixel "
         "between them"));
  jump_->setRange(0.01, 5);
  jump_->setDecimals(2);
  jump_->setSingleStep(0.05);
  jump_->setValue(CloudChoice().jump_px);
  jump_->setPrefix(tr("cut over "));
  jump_->setSuffix(tr(" px"));
  jump_->setKeyboardTracking(false);
  connect(surface_, &QCheckBox::toggled, this, [this](bool is_surface) {
    jump_->setEnabled(is_surface);
    shaded_->setEnabled(is_surface);
    emit choiceChanged();
  });
  connect(shaded_, &QCheckBox::toggled, this, &CloudControls::lookChanged);
  connect(jump_, &NumberSpin::valueChanged, this, &CloudControls::choiceChanged);
  jump_->setEnabled(false);
  shaded_->setEnabled(false);
  auto* row = make_row({surface_, shaded_, kRoom});
  grid.addLayout(row, 1, 0, 1, 2);
  grid.addWidget(jump_, 2, 0, 1, 2);
}

QSlider* CloudControls::makeSlider(const QString& name, const QString& text, const QString& tip) {
  auto* slider = named(name, new QSlider(Qt::Horizontal, this));
  slider->setToolTip(tip);
  slider->setAccessibleName(text);
  slider->setMinimumWidth(50);
  connect(slider, &QSlider::valueChanged, this, &CloudControls::lookChanged);
  return slider;
}

void CloudControls::addLook(QGridLayout& grid) {
  size_ = makeSlider("cloud.size", tr("Point size"), tr("Size of the points, in pixels"));
  size_->setRange(kSizeSteps, kSizeSteps * kMostPixels);
  stretch_ = makeSlider("cloud.stretch", tr("Stretch z"), tr("Stretch along the line of sight"));
  stretch_->setRange(-kStretchSteps, kStretchSteps);
  near_ = makeSlider("cloud.near", tr("Cut nearer than"), tr("Hides everything nearer"));
  far_ = makeSlider("cloud.far", tr("Cut farther than"), tr("Hides everything farther away"));
  for (auto* slider : {near_, far_}) {
    slider->setRange(0, kClipSteps);
    connect(slider, &QSlider::valueChanged, this, [this, slider] { keepClipOpen(slider); });
  }
  auto* reset = make_tool_button({"cloud.lookReset", "reset", tr("No stretch and no cut")}, this);
  connect(reset, &QToolButton::clicked, this, [this] {
    CloudLook plain = look();
    plain.z_stretch = CloudLook().z_stretch;
    plain.clip_near = CloudLook().clip_near;
    plain.clip_far = CloudLook().clip_far;
    setLook(plain);
    emit lookChanged();
  });
  const std::tuple<QSlider*, QString, int, int> places[] = {{size_, tr("Points"), 2, 2},
                                                            {stretch_, tr("Stretch z"), 3, 0},
                                                            {near_, tr("Near"), 4, 0},
                                                            {far_, tr("Far"), 4, 2}};
  for (const auto& [slider, text, row, column] : places) {
    grid.addWidget(new QLabel(text, this), row, column);
    grid.addWidget(slider, row, column + 1);
  }
  grid.addWidget(reset, 3, 2);
  setLook({});
}

// Keeps something visible between near and far.
void CloudControls::keepClipOpen(const QSlider* moved) {
  if (near_->value() < far_->value()) return;
  if (moved == near_) {
    far_->setValue(near_->value() + 1);
    near_->setValue(far_->value() - 1);
  } else {
    near_->setValue(far_->value() - 1);
    far_->setValue(near_->value() + 1);
  }
}

void CloudControls::setChoice(const CloudChoice& choice) {
  const QSignalBlocker blocker(this);
  choose(*coloring_, choice.coloring);
  choose(*companion_, choice.companion);
  arrangement_->setCurrentIndex(choice.is_beside ? 1 : 0);
  surface_->setChecked(choice.is_surface);
  jump_->setValue(choice.jump_px);
}

CloudChoice CloudControls::choice() const {
  return {.coloring = chosen<CloudColoring>(*coloring_),
          .companion = chosen<CloudCompanion>(*companion_),
          .is_beside = arrangement_->currentIndex() == 1,
          .is_surface = surface_->isChecked(),
          .jump_px = jump_->value()};
}

void CloudControls::setLook(const CloudLook& look) {
  const QSignalBlocker blocker(this);
  size_->setValue(static_cast<int>(std::lround(kSizeSteps * look.point_size)));
  stretch_->setValue(stretch_position(look.z_stretch));
  near_->setValue(0);
  far_->setValue(static_cast<int>(std::lround(kClipSteps * look.clip_far)));
  near_->setValue(static_cast<int>(std::lround(kClipSteps * look.clip_near)));
  shaded_->setChecked(look.is_shaded);
}

CloudLook CloudControls::look() const {
  return {.z_stretch = stretch_factor(stretch_->value()),
          .point_size = 1.0 * size_->value() / kSizeSteps,
          .is_shaded = shaded_->isChecked(),
          .clip_near = 1.0 * near_->value() / kClipSteps,
          .clip_far = 1.0 * far_->value() / kClipSteps};
}

void CloudControls::setOffers(const CloudOffers& offers) {
  offer(*coloring_, CloudColoring::Error, offers.has_error);
  offer(*coloring_, CloudColoring::Labels, offers.has_labels);
  offer(*coloring_, CloudColoring::Distance, offers.has_distance);
  offer(*companion_, CloudCompanion::Truth, offers.has_truth);
  offer(*companion_, CloudCompanion::Other, !offers.other.isEmpty());
  companion_->setItemText(companion_->findData(static_cast<int>(CloudCompanion::Other)),
                          offers.other.isEmpty() ? tr("B") : offers.other);
}

}  // namespace episcope

#include "moc_point_cloud_panel.cpp"
