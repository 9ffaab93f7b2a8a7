// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/annotate_controller.h"

#include "annotation/paint/flood_fill.h"
#include "annotation/paint/polygon.h"
#include "app/gui/document/label_choice.h"
#include "app/gui/frame/cancels.h"
#include "app/gui/frame/commands.h"
#include "app/gui/frame/frame.h"
#include "app/gui/frame/messages.h"
#include "app/gui/frame/panes.h"
#include "app/gui/stage/overlay.h"
#include "app/gui/stage/stage.h"
#include "widgets/annotate/brush_panel.h"
#include "widgets/canvas/tools/fill_tool.h"
#include "widgets/canvas/tools/lasso_tool.h"
#include "widgets/canvas/tools/point_tool.h"
#include "widgets/canvas/tools/polygon_tool.h"
#include "widgets/canvas/view_canvas.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace episcope {
namespace {

constexpr double kSizeStep = 1.15;  // of a key or a notch of the wheel

bool is_of_labels(const QString& tab) {
  return tab == "annotate" || tab == "check";
}

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

}  // namespace

AnnotateController::AnnotateController(const Workbench& bench, BrushPanel* panel)
    : QObject(&bench.owner),
      bench_(bench),
      session_(bench.session),
      document_(bench.document),
      canvas_(bench.stage.canvas()),
      panel_(panel),
      stroke_tool_(new StrokeTool(this)),
      fill_tool_(new FillTool(this)),
      polygon_tool_(new PolygonTool(this)),
      lasso_tool_(new LassoTool(this)),
      pick_tool_(new PointTool(this)) {
  addCommands();
  connectTools();
  connectPanel();
  bench.cancels.add(CancelRank::Stroke, [this] { return canvasTool()->cancel(); });
  connect(&bench.frame, &Frame::tabShown, this, [this](const QString& id) {
    if (!isTabShown()) setAnnotating(false);
    if (is_of_labels(id)) setAnnotating(isTabShown());
  });
  connect(&bench.frame, &Frame::tabShown, this, &AnnotateController::showScribbles);
  connect(&bench.stage, &Stage::previewChanged, this, &AnnotateController::showMode);
  connect(&bench.labels, &LabelChoice::changed, this, &AnnotateController::showColor);
  connect(&document_, &DocumentController::replaced, this, &AnnotateController::showMode);
  connect(&document_, &DocumentController::changed, &bench.commands, &Commands::refresh);
  connect(&document_, &DocumentController::steppedBack, this, &AnnotateController::goTo);
  session_.on_changed([this](Parts parts) {
    if (parts.has(Part::View)) canvasTool()->end();
  });
  showMode();
}

// The tools die with this, the canvas later.
AnnotateController::~AnnotateController() {
  canvas_->setTool(nullptr);
}

void AnnotateController::connectTools() {
  StrokeTool* tool = stroke_tool_;
  connect(tool, &StrokeTool::strokeStarted, this, [this](const StrokeStart& start) {
    if (!start.erases && !requireLabel()) return;
    document_.beginStroke(session_.view(), styleOf(start), point_of(start.at));
  });
  connect(tool, &StrokeTool::strokeExtended, this,
          [this](QPointF image) { document_.extendStroke(point_of(image)); });
  connect(tool, &StrokeTool::strokeFinished, &document_, &DocumentController::endStroke);
  connect(tool, &StrokeTool::strokeCancelled, &document_, &DocumentController::cancelStroke);
  connect(tool, &StrokeTool::sizeStepped, this, &AnnotateController::stepSize);
  connect(fill_tool_, &FillTool::fillRequested, this, &AnnotateController::fill);
  connect(pick_tool_, &PointTool::pointPicked, this, &AnnotateController::pick);
  paintOutlined(*polygon_tool_, EditKind::Polygon);
  paintOutlined(*lasso_tool_, EditKind::Lasso);
  connect(polygon_tool_, &OutlineTool::cornersChanged, &bench_.commands, &Commands::refresh);
}

void AnnotateController::connectPanel() {
  panel_->setBrushSize(stroke_tool_->brushSize());
  panel_->setEraserSize(stroke_tool_->eraserSize());
  showScribbles();
  connect(panel_, &BrushPanel::brushSizeEdited, stroke_tool_, &StrokeTool::setBrushSize);
  connect(panel_, &BrushPanel::eraserSizeEdited, stroke_tool_, &StrokeTool::setEraserSize);
  connect(panel_, &BrushPanel::protectsOthersEdited, this, &AnnotateController::setProtectsOthers);
  connect(panel_, &BrushPanel::scribbleOpacityEdited, this, &AnnotateController::showScribbles);
  connect(&bench_.commands, &Commands::keysChanged, this, &AnnotateController::showSizeKeys);
  connect(&bench_.overlay, &Overlay::choiceChanged, this, [this] {
    panel_->setSegmentationAvailable(bench_.overlay.isAvailable(render::Quantity::Segmentation));
  });
  showSizeKeys();
}

void AnnotateController::showSizeKeys() {
  QStringList keys{bench_.commands.keyText("annotate.smaller"),
                   bench_.commands.keyText("annotate.larger")};
  keys.removeAll({});
  panel_->setSizeKeys(keys.join(tr(" and ")));
}

void AnnotateController::setAnnotating(bool is_annotating) {
  if (is_annotating && !isTabShown()) bench_.frame.showTab("annotate");
  if (std::exchange(is_annotating_, is_annotating) == is_annotating) return;
  if (is_annotating) {
    document_.keepJournal();
    bench_.stage.requestSingleView();
  }
  showMode();
}

bool AnnotateController::isTabShown() const {
  // What is checked is corrected at once.
  const Panes& panes = bench_.frame.panes();
  return panes.isSeen("tab.annotate") || panes.isSeen("tab.check");
}

bool AnnotateController::hasDocument() const {
  return document_.document() != nullptr;
}

void AnnotateController::showScribbles() {
  canvas_->setScribbleOpacity(isTabShown() ? panel_->scribbleOpacity() : 0);
}

CanvasTool* AnnotateController::canvasTool() const {
  if (tool_ == AnnotationTool::Fill) return fill_tool_;
  if (tool_ == AnnotationTool::Pick) return pick_tool_;
  if (tool_ == AnnotationTool::Polygon) return polygon_tool_;
  if (tool_ == AnnotationTool::Lasso) return lasso_tool_;
  return stroke_tool_;
}

void AnnotateController::showMode() {
  const bool is_painting = is_annotating_ && !bench_.stage.isPreviewing() && hasDocument();
  if (!is_painting) canvasTool()->end();
  canvas_->setTool(is_painting ? canvasTool() : nullptr);
  panel_->setEnabled(hasDocument());
  bench_.commands.refresh();
}

void AnnotateController::showColor() {
  const LabelInfo* label = bench_.labels.info();
  if (document_.isStroking()) canvasTool()->end();
  const QColor color = label ? QColor(label->color[0], label->color[1], label->color[2]) : QColor();
  stroke_tool_->setColor(color);
  polygon_tool_->setColor(color);
  lasso_tool_->setColor(color);
}

void AnnotateController::setTool(AnnotationTool tool) {
  if (!hasDocument()) return;
  canvasTool()->end();
  tool_ = tool;
  stroke_tool_->setErasing(tool == AnnotationTool::Eraser);
  setAnnotating(true);
  showMode();
}

void AnnotateController::stepSize(double steps) {
  if (tool_ == AnnotationTool::Eraser) {
    stroke_tool_->setEraserSize(stepped(stroke_tool_->eraserSize(), steps));
    panel_->setEraserSize(stroke_tool_->eraserSize());
  } else {
    stroke_tool_->setBrushSize(stepped(stroke_tool_->brushSize(), steps));
    panel_->setBrushSize(stroke_tool_->brushSize());
  }
}

void AnnotateController::setProtectsOthers(bool protects) {
  protects_others_ = protects;
  panel_->setProtectsOthers(protects);
  bench_.commands.refresh();
}

PaintStyle AnnotateController::styleOf(const StrokeStart& start) const {
  PaintStyle style;
  style.tool = start.erases ? PaintTool::Eraser : PaintTool::Brush;
  style.label = std::max(1, bench_.labels.current());
  style.diameter_px = start.erases ? stroke_tool_->eraserSize() : stroke_tool_->brushSize();
  style.protects_others = start.protects_others || protects_others_;
  // What is not seen is not changed.
  const LabelMarks& marks = session_.place().label_marks;
  for (const auto* kept : {&marks.hidden, &marks.locked}) {
    for (const std::int32_t id : *kept) style.locked.set(static_cast<std::size_t>(id));
  }
  return style;
}

bool AnnotateController::requireLabel() {
  if (bench_.labels.current() == 0) {
    document_.edit([](AnnotationDocument& document) { document.add_label(); });
  }
  const LabelInfo* label = bench_.labels.info();
  if (!label) return false;
  LabelMarks marks = session_.place().label_marks;
  if (marks.locked.contains(label->id)) {
    bench_.messages.hint(tr("“%1” is locked: unlock it to paint it, or choose another label.")
                             .arg(QString::fromStdString(label->name)));
    return false;
  }
  if (marks.hidden.erase(label->id) > 0) session_.set_label_marks(marks);
  return true;
}

void AnnotateController::paintOutlined(const OutlineTool& tool, EditKind kind) {
  connect(&tool, &OutlineTool::outlined, this,
          [this, kind](const QPolygonF& corners, const StrokeStart& start) {
            if (!hasDocument() || (!start.erases && !requireLabel())) return;
            std::vector<StrokePoint> points;
            for (const QPointF& each : corners) points.push_back(point_of(each));
            document_.edit([&](AnnotationDocument& document) {
              const ScribbleLayer& layer = document.scribbles();
              fill_region(document, session_.view(),
                          pixels_in_polygon(points, layer.height(), layer.width()), styleOf(start),
                          kind);
            });
          });
}

PixelRegion AnnotateController::regionAt(PixelIndex seed) const {
  const ViewIndex view = session_.view();
  if (panel_->fillBound() == FillBound::Segmentation) {
    const auto source = bench_.overlay.sourceOf({render::Quantity::Segmentation});
    if (source) {
      return region_of_segment(finished_labels(*source->labeling, source->finish, view), seed);
    }
  }
  constexpr double kGreyLevels = 255;
  return region_within_edges(session_.light_field()->view_as_float(view).view(), seed,
                             panel_->fillGradient() / kGreyLevels);
}

void AnnotateController::fill(const StrokeStart& start) {
  if (!hasDocument() || (!start.erases && !requireLabel())) return;
  const PixelRegion region = regionAt(pixel_of(start.at));
  if (region.empty()) {
    bench_.messages.hint(
        tr("There is an edge here. Click beside it, or raise the edge threshold of the fill."));
    return;
  }
  document_.edit([&](AnnotationDocument& document) {
    fill_region(document, session_.view(), region, styleOf(start));
  });
}

void AnnotateController::pick(QPointF image) {
  if (!hasDocument()) return;
  const int id = document_.document()->scribbles().label_at(session_.view(), pixel_of(image));
  if (id == 0) {
    bench_.messages.hint(tr("Nothing is painted here."));
    return;
  }
  bench_.labels.choose(id);
  setTool(AnnotationTool::Brush);
}

void AnnotateController::goTo(const DocumentChange& change) {
  if (change.views.empty()) return;
  const auto here = std::ranges::find(change.views, session_.view(), &DocumentChange::Part::view);
  const auto& part = here == change.views.end() ? change.views.front() : *here;
  session_.set_view(part.view);
  canvas_->ensureVisible({(part.rect.y0 + part.rect.y1) / 2, (part.rect.x0 + part.rect.x1) / 2});
}

}  // namespace episcope

#include "moc_annotate_controller.cpp"
