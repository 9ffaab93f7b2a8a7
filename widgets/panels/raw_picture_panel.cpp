// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/raw_picture_panel.h"

#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/labels.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/theme.h"

#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QLineF>
#include <QList>
#include <QMenu>
#include <QPainter>
#include <QPushButton>
#include <QSignalBlocker>

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

constexpr int kStateLines = 3;  // of a state, before it is folded

}  // namespace

/// A canvas that marks the centers of lenses where they stand apart on the screen.
class RawCanvas : public ViewCanvas {
 public:
  using ViewCanvas::ViewCanvas;

  void setCenters(std::vector<QPointF> centers, double pitch_px) {
    centers_ = std::move(centers);
    pitch_px_ = pitch_px;
    update();
  }
  void setMarked(bool is_marked) {
    is_marked_ = is_marked;
    update();
  }
  /// Enlarges the middle so that lenses can be told apart.
  void showLenses() {
    CanvasTransform transform = canvasTransform();
    transform.scale = std::max(transform.scale, kShown / pitch_px_);
    setCanvasTransform(transform);
  }

 protected:
  void paintEvent(QPaintEvent* event) override {
    ViewCanvas::paintEvent(event);
    const CanvasTransform transform = canvasTransform();
    if (state() != State::Picture || !is_marked_ || transform.scale * pitch_px_ < kLeast) return;
    const QRectF seen = QRectF(rect()).adjusted(-kArm, -kArm, kArm, kArm);
    QList<QLineF> lines;
    for (const QPointF& center : centers_) {
      // A canvas counts from the corner of a pixel.
      const QPointF at = transform.to_widget(center + QPointF(0.5, 0.5), size());
      if (!seen.contains(at)) continue;
      lines << QLineF(at.x() - kArm, at.y(), at.x() + kArm, at.y())
            << QLineF(at.x(), at.y() - kArm, at.x(), at.y() + kArm);
    }
    QPainter painter(this);
    painter.setPen(QPen(QColor(0, 0, 0, 110), 3));
    painter.drawLines(lines);
    painter.setPen(QPen(theme::kCrossHair, 1));
    painter.drawLines(lines);
  }

 private:
  static constexpr double kArm = 3;     // logical px
  static constexpr double kLeast = 8;   // between marks
  static constexpr double kShown = 16;  // between marks at first

  std::vector<QPointF> centers_;
  double pitch_px_ = 0;
  bool is_marked_ = true;
};

RawPicturePanel::RawPicturePanel(const QStringList& mosaics, QWidget* parent)
    : QWidget(parent),
      raw_(new FoldedLabel(this, kStateLines)),
      white_(new FoldedLabel(this, kStateLines)),
      lenses_(new FoldedLabel(this, kStateLines)),
      views_(new FoldedLabel(this, kStateLines)),
      raw_button_(new QPushButton(tr("Raw picture"), this)),
      white_button_(new QPushButton(tr("White picture"), this)),
      find_(new QPushButton(tr("Find lenses"), this)),
      decode_(new QPushButton(tr("Decode…"), this)),
      shown_(named("raw.shown", new QComboBox(this))),
      marks_(named("raw.marks", new QCheckBox(tr("Lens centers"), this))),
      canvas_(named("raw.canvas", new RawCanvas(this))) {
  setObjectName("rawPicturePanel");
  shown_->setAccessibleName(tr("Shown picture"));
  marks_->setToolTip(tr("Marks the center of each lens; enlarge the picture with the wheel"));
  marks_->setChecked(true);
  canvas_->setEmptyHint(
      tr("Open a raw picture of a plenoptic camera: .lfp, .lfr, .raw, or the "
         "picture of a sensor behind microlenses."));
  canvas_->setParallaxEnabled(false);
  makeRawMenu(mosaics);
  makeWhiteMenu();
  auto* choice = make_row({{shown_, 1}, marks_});
  make_column(this, {makeSteps(), choice, {canvas_, 1}},
              {.margins = {0, theme::kSpacing, 0, 0}, .spacing = theme::kSpacing});
  connect(find_, &QPushButton::clicked, this, &RawPicturePanel::lensesRequested);
  connect(decode_, &QPushButton::clicked, this, &RawPicturePanel::decodeRequested);
  connect(shown_, &QComboBox::activated, this, &RawPicturePanel::showPicture);
  connect(marks_, &QCheckBox::toggled, canvas_, [this](bool on) { canvas_->setMarked(on); });
  setRaw({});
  setWhite({});
  setLenses({});
  setViews({});
  setPictures({}, {});
}

QGridLayout* RawPicturePanel::makeSteps() {
  struct Step {
    FoldedLabel* state;
    QPushButton* button;
    const char* name;
    QString tip;
  };
  const Step all[] = {
      {raw_, raw_button_, "picture", tr("What the sensor of a plenoptic camera saw")},
      {white_, white_button_, "white",
       tr("An evenly lit white area: it shows the lenses and their shading")},
      {lenses_, find_, "lenses", tr("Fits the grid of the lenses again")},
      {views_, decode_, "views", tr("Writes the views as a light field and opens it")}};
  auto* steps = new QGridLayout;
  steps->setVerticalSpacing(theme::kSpacing / 2);
  steps->setColumnStretch(0, 1);
  for (const Step& step : all) {
    step.state->setObjectName(QString("raw.%1.state").arg(step.name));
    step.button->setObjectName(QString("raw.%1").arg(step.name));
    step.button->setToolTip(step.tip);
    const int row = steps->rowCount();
    steps->addWidget(step.state, row, 0);
    steps->addWidget(step.button, row, 1);
  }
  return steps;
}

void RawPicturePanel::makeRawMenu(const QStringList& mosaics) {
  auto* menu = new QMenu(raw_button_);
  menu->addAction(tr("Open a raw picture…"), this, &RawPicturePanel::openRequested);
  mosaic_ = menu->addMenu(tr("Colors of the first pixels"));
  for (const QString& name : mosaics) {
    const QString text = name == "gray" ? tr("Gray") : tr("Bayer %1").arg(name.toUpper());
    mosaic_->addAction(text, this, [this, name] { emit mosaicChosen(name); });
  }
  optics_ = menu->addAction(tr("Optics of the camera…"), this, &RawPicturePanel::opticsRequested);
  menu->addSeparator();
  menu->addAction(tr("A computed one to try"), this, &RawPicturePanel::demoRequested);
  raw_button_->setMenu(menu);
}

void RawPicturePanel::makeWhiteMenu() {
  auto* menu = new QMenu(white_button_);
  menu->addAction(tr("White picture or archive of calibration data…"), this,
                  &RawPicturePanel::whiteRequested);
  menu->addAction(tr("Folder of calibration data…"), this, &RawPicturePanel::calibrationRequested);
  menu->addAction(tr("Dark picture…"), this, &RawPicturePanel::darkRequested);
  white_button_->setMenu(menu);
}

void RawPicturePanel::setRaw(const QString& text) {
  raw_->setFullText(text.isEmpty() ? tr("No raw picture") : text);
  const bool is_open = !text.isEmpty();
  mosaic_->setEnabled(is_open);
  optics_->setEnabled(is_open);
  white_button_->setEnabled(is_open);
  find_->setEnabled(is_open);
}

void RawPicturePanel::setWhite(const QString& text) {
  white_->setFullText(text.isEmpty() ? tr("No white picture") : text);
}

void RawPicturePanel::setLenses(const QString& text) {
  lenses_->setFullText(text.isEmpty() ? tr("Lenses are not found yet") : text);
  decode_->setEnabled(!text.isEmpty());
}

void RawPicturePanel::setViews(const QString& text) {
  views_->setFullText(text.isEmpty() ? tr("No views yet") : text);
}

void RawPicturePanel::setPictures(const QStringList& names, std::vector<QImage> pictures) {
  pictures_ = std::move(pictures);
  const QSignalBlocker blocker(shown_);
  shown_->clear();
  shown_->addItems(names);
  shown_->setEnabled(!names.isEmpty());
  showPicture(0);
}

void RawPicturePanel::showPicture(int index) {
  canvas_->setPicture(pictures_.empty() ? QImage() : pictures_[static_cast<std::size_t>(index)]);
}

void RawPicturePanel::setCenters(std::vector<QPointF> centers, double pitch_px) {
  const bool is_any = !centers.empty();
  canvas_->setCenters(std::move(centers), pitch_px);
  if (is_any && canvas_->isFitted()) canvas_->showLenses();
}

}  // namespace episcope

#include "moc_raw_picture_panel.cpp"
