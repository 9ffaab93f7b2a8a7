// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/annotate_controller.h"

#include "annotation/paint/flood_fill.h"
#include "widgets/annotate/annotation_bar.h"
#include "widgets/annotate/brush_panel.h"
#include "widgets/annotate/label_palette.h"
#include "widgets/canvas/view_canvas.h"

#include <QColorDialog>
#include <QMessageBox>
#include <QPushButton>
#include <QTabWidget>

#include <algorithm>
#include <cmath>
#include <utility>

namespace episcope {
namespace {

constexpr double kSizeStep = 1.15;  // of a key or a notch of the wheel

PixelIndex pixel_of(QPointF image) {
  return {static_cast<int>(std::floor(image.y())), static_cast<int>(std::floor(image.x()))};
}

StrokePoint point_of(QPointF image) {
  return {image.y(), image.x()};
}

double stepped(double size_px, double steps) {
  const double next = std::round(size_px * std::pow(kSizeStep, steps));
  // Small sizes would stay where they are.
  return std::clamp(next == size_px ? size_px + (steps > 0 ? 1 : -1) : next, kMinBrush_px,
                    kMaxBrush_px);
}

QColor color_of(const Rgb& rgb) {
  return {rgb[0], rgb[1], rgb[2]};
}

}  // namespace

AnnotateController::AnnotateController(Session& session, DocumentController& document,
                                       const Panels& panels, QObject* parent)
    : QObject(parent),
      session_(session),
      document_(document),
      panels_(panels),
      tool_(new BrushTool(this)) {
  connectTool();
  connectPanel();
  connectPalette();
  connect(panels_.tabs, &QTabWidget::currentChanged, this, [this] { setAnnotating(isTabShown()); });
  connect(panels_.tabs, &QTabWidget::currentChanged, this, &AnnotateController::showScribbles);
  connect(&document_, &DocumentController::replaced, this, [this] {
    label_ = former_label_ = 0;
    showLabels();
    showMode();
  });
  connect(&document_, &DocumentController::changed, this, [this](const DocumentChange& change) {
    if (change.has_new_labels) showLabels();
  });
  connect(&document_, &DocumentController::steppedBack, this, &AnnotateController::goTo);
  session_.on_changed([this](Parts parts) { update(parts); });
  showLabels();
  showMode();
}

// The tool dies with this, the canvas later.
AnnotateController::~AnnotateController() {
  panels_.canvas->setTool(nullptr);
}

void AnnotateController::connectTool() {
  connect(tool_, &BrushTool::strokeStarted, this, [this](const StrokeStart& start) {
    if (!start.erases && !requireLabel()) return;
    document_.beginStroke(session_.view(), styleOf(start), point_of(start.at));
  });
  connect(tool_, &BrushTool::strokeExtended, this,
          [this](QPointF image) { document_.extendStroke(point_of(image)); });
  connect(tool_, &BrushTool::strokeFinished, &document_, &DocumentController::endStroke);
  connect(tool_, &BrushTool::strokeCancelled, &document_, &DocumentController::cancelStroke);
  connect(tool_, &BrushTool::fillRequested, this, &AnnotateController::fill);
  connect(tool_, &BrushTool::pickRequested, this, &AnnotateController::pick);
  connect(tool_, &BrushTool::sizeStepped, this, &AnnotateController::stepSize);
}

void AnnotateController::connectPanel() {
  BrushPanel* panel = panels_.brush;
  panel->setBrushSize(tool_->brushSize());
  panel->setEraserSize(tool_->eraserSize());
  showScribbles();
  connect(panel, &BrushPanel::brushSizeEdited, tool_, &BrushTool::setBrushSize);
  connect(panel, &BrushPanel::eraserSizeEdited, tool_, &BrushTool::setEraserSize);
  connect(panel, &BrushPanel::protectsOthersEdited, this, &AnnotateController::setProtectsOthers);
  connect(panel, &BrushPanel::scribbleOpacityEdited, this, &AnnotateController::showScribbles);
}

void AnnotateController::connectPalette() {
  LabelPalette* palette = panels_.labels;
  connect(palette, &LabelPalette::currentChosen, this, &AnnotateController::chooseLabel);
  connect(palette, &LabelPalette::addRequested, this, &AnnotateController::addLabel);
  connect(palette, &LabelPalette::removeRequested, this, &AnnotateController::removeLabel);
  connect(palette, &LabelPalette::colorRequested, this, &AnnotateController::recolorLabel);
  connect(palette, &LabelPalette::renameRequested, this, [this](int id, const QString& name) {
    const bool is_renamed = document_.edit([&](AnnotationDocument& document) {
      document.rename_label(id, name.trimmed().toStdString());
    });
    if (!is_renamed) showLabels();  // the row holds what was typed
  });
}

void AnnotateController::update(Parts parts) {
  if (parts.has(Part::View)) tool_->end();
  if (parts.has(Part::Scene)) is_suspended_ = false;
  if (parts.has(Part::Scene)) showMode();
}

void AnnotateController::setAnnotating(bool is_annotating) {
  if (is_annotating) showTab();
  if (std::exchange(is_annotating_, is_annotating) == is_annotating) return;
  if (is_annotating) document_.keepJournal();
  showMode();
}

void AnnotateController::setSuspended(bool is_suspended) {
  is_suspended_ = is_suspended;
  showMode();
}

void AnnotateController::showTab() {
  panels_.tabs->setCurrentWidget(panels_.annotate_tab);
}

bool AnnotateController::isTabShown() const {
  return panels_.tabs->currentWidget() == panels_.annotate_tab;
}

void AnnotateController::showScribbles() {
  panels_.canvas->setScribbleOpacity(isTabShown() ? panels_.brush->scribbleOpacity() : 0);
}

QString AnnotateController::labelHint() const {
  if (document_.document()) {
    return tr(
        "No labels yet. Add one for each kind of thing, then paint a few strokes on the view.");
  }
  return is_suspended_ ? tr("The light field is being read.")
                       : tr("Open a light field to label it.");
}

void AnnotateController::showMode() {
  panels_.labels->setHint(labelHint());
  const bool is_painting = is_annotating_ && !is_suspended_ && document_.document();
  if (!is_painting) tool_->end();
  panels_.canvas->setTool(is_painting ? tool_ : nullptr);
  panels_.brush->setEnabled(document_.document() != nullptr);
  panels_.labels->setEnabled(document_.document() != nullptr);
  panels_.annotation->setEnabled(document_.document() != nullptr);
  emit modeChanged();
}

void AnnotateController::setTool(AnnotationTool tool) {
  if (!document_.document()) return;
  tool_->setTool(tool);
  setAnnotating(true);
  emit toolChanged();
}

void AnnotateController::stepSize(double steps) {
  const bool is_eraser = tool_->tool() == AnnotationTool::Eraser;
  if (is_eraser) {
    tool_->setEraserSize(stepped(tool_->eraserSize(), steps));
    panels_.brush->setEraserSize(tool_->eraserSize());
  } else {
    tool_->setBrushSize(stepped(tool_->brushSize(), steps));
    panels_.brush->setBrushSize(tool_->brushSize());
  }
}

void AnnotateController::setProtectsOthers(bool protects) {
  protects_others_ = protects;
  panels_.brush->setProtectsOthers(protects);
  emit toolChanged();
}

void AnnotateController::showLabels() {
  const AnnotationDocument* document = document_.document();
  const auto labels = document ? document->labels().labels() : std::vector<LabelInfo>();
  const auto is_known = [&](int id) { return document && document->labels().contains(id); };
  if (!is_known(label_)) label_ = is_known(former_label_) ? former_label_ : 0;
  if (!is_known(former_label_)) former_label_ = 0;
  if (label_ == 0 && !labels.empty()) label_ = labels.front().id;
  panels_.labels->setLabels(labels);
  panels_.labels->setCurrent(label_);
  const LabelInfo* current = document ? document->labels().find(label_) : nullptr;
  tool_->setColor(current ? color_of(current->color) : QColor());
  emit labelChanged();
}

void AnnotateController::chooseLabel(int id) {
  const AnnotationDocument* document = document_.document();
  if (!document || id == label_) return;
  if (!document->labels().contains(id)) {
    emit hint(tr("There is no label %1.").arg(id));
    return;
  }
  tool_->end();
  former_label_ = std::exchange(label_, id);
  panels_.labels->setCurrent(id);
  tool_->setColor(color_of(document->labels().find(id)->color));
  emit labelChanged();
}

void AnnotateController::chooseNextLabel() {
  if (!document_.document()) return;
  const auto& labels = document_.document()->labels().labels();
  if (labels.empty()) return;
  const auto next = std::ranges::upper_bound(labels, label_, {}, &LabelInfo::id);
  chooseLabel(next == labels.end() ? labels.front().id : next->id);
}

void AnnotateController::swapLabels() {
  if (former_label_ != 0) chooseLabel(former_label_);
}

void AnnotateController::addLabel() {
  int id = 0;
  document_.edit([&](AnnotationDocument& document) { id = document.add_label(); });
  if (id != 0) chooseLabel(id);
}

void AnnotateController::renameLabel() {
  if (label_ == 0) return;
  showTab();
  panels_.labels->editName(label_);
}

bool AnnotateController::isPainted(int id) const {
  const ScribbleLayer& layer = document_.document()->scribbles();
  return std::ranges::any_of(layer.painted_views(), [&](ViewIndex view) {
    const auto image = layer.view(view);
    const std::size_t size = static_cast<std::size_t>(image.height) * image.width;
    return std::find(image.data, image.data + size, id) != image.data + size;
  });
}

void AnnotateController::removeLabel(int id) {
  const AnnotationDocument* document = document_.document();
  const LabelInfo* label = document ? document->labels().find(id) : nullptr;
  if (!label) return;
  if (!isPainted(id)) {
    removeNow(id);
    return;
  }
  auto* box =
      new QMessageBox(QMessageBox::Question, tr("Remove a label"),
                      tr("Remove “%1” and everything that is painted with it, on all views?")
                          .arg(QString::fromStdString(label->name)),
                      QMessageBox::Cancel, panels_.viewer->window());
  box->setObjectName("remove_label");
  box->addButton(tr("Remove"), QMessageBox::AcceptRole)->setObjectName("remove_label.remove");
  box->setAttribute(Qt::WA_DeleteOnClose);
  connect(box, &QDialog::accepted, this, [this, id] { removeNow(id); });
  box->open();
}

void AnnotateController::removeNow(int id) {
  document_.edit([id](AnnotationDocument& document) { document.remove_label(id); });
}

void AnnotateController::recolorLabel(int id) {
  const AnnotationDocument* document = document_.document();
  const LabelInfo* label = document ? document->labels().find(id) : nullptr;
  if (!label) return;
  auto* dialog = new QColorDialog(color_of(label->color), panels_.viewer->window());
  dialog->setObjectName("label_color");
  dialog->setWindowTitle(tr("Colour of “%1”").arg(QString::fromStdString(label->name)));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &QColorDialog::colorSelected, this, [this, id](const QColor& color) {
    const Rgb rgb{static_cast<std::uint8_t>(color.red()), static_cast<std::uint8_t>(color.green()),
                  static_cast<std::uint8_t>(color.blue())};
    document_.edit([&](AnnotationDocument& edited) { edited.recolor_label(id, rgb); });
  });
  dialog->open();
}

PaintStyle AnnotateController::styleOf(const StrokeStart& start) const {
  PaintStyle style;
  style.tool = start.erases ? PaintTool::Eraser : PaintTool::Brush;
  style.label = std::max(1, label_);
  style.diameter_px = start.erases ? tool_->eraserSize() : tool_->brushSize();
  style.protects_others = start.protects_others || protects_others_;
  return style;
}

// Who begins to paint without a label gets one.
bool AnnotateController::requireLabel() {
  if (label_ == 0) addLabel();
  return label_ != 0;
}

void AnnotateController::fill(const StrokeStart& start) {
  if (!document_.document() || (!start.erases && !requireLabel())) return;
  const ViewIndex view = session_.view();
  const PixelIndex seed = pixel_of(start.at);
  PixelRegion region;
  if (segmentation_ && panels_.brush->fillBound() == FillBound::Segmentation) {
    region = region_of_segment(segmentation_(view), seed);
  } else {
    constexpr double kGreyLevels = 255;
    region = region_within_edges(session_.light_field()->view_as_float(view).view(), seed,
                                 panels_.brush->fillGradient() / kGreyLevels);
  }
  if (region.empty()) {
    emit hint(tr("There is an edge here: click beside it, or let the fill pass stronger edges."));
    return;
  }
  document_.edit(
      [&](AnnotationDocument& document) { fill_region(document, view, region, styleOf(start)); });
}

void AnnotateController::pick(QPointF image) {
  const AnnotationDocument* document = document_.document();
  if (!document) return;
  const int id = document->scribbles().label_at(session_.view(), pixel_of(image));
  if (id == 0) {
    emit hint(tr("Nothing is painted here."));
    return;
  }
  chooseLabel(id);
  setTool(AnnotationTool::Brush);
}

void AnnotateController::setSegmentation(Segmentation segmentation) {
  segmentation_ = std::move(segmentation);
  panels_.brush->setSegmentationAvailable(static_cast<bool>(segmentation_));
}

bool AnnotateController::cancelStroke() {
  return tool_->cancel();
}

void AnnotateController::goTo(const DocumentChange& change) {
  if (change.views.empty()) return;
  const auto here = std::ranges::find(change.views, session_.view(), &DocumentChange::Part::view);
  const auto& part = here == change.views.end() ? change.views.front() : *here;
  session_.set_view(part.view);
  panels_.canvas->ensureVisible(
      {(part.rect.y0 + part.rect.y1) / 2, (part.rect.x0 + part.rect.x1) / 2});
}

}  // namespace episcope
