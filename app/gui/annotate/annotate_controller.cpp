// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/annotate_controller.h"

#include "app/gui/scene/overlay.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/gui/shell/panes.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/text.h"
#include "widgets/panels/brush_panel.h"

#include <QAction>

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
      canvas_(bench.viewer_area.canvas()),
      panel_(panel),
      stroke_tool_(new StrokeTool(this)),
      fill_tool_(new FillTool(this)),
      polygon_tool_(new PolygonTool(this)),
      lasso_tool_(new LassoTool(this)),
      pick_tool_(new PointTool(this)),
      wand_(bench.session, this) {
  addCommands();
  connectTools();
  connectPanel();
  bench.cancels.add(CancelRank::Stroke, [this] { return canvasTool()->cancel(); });
  connect(&bench.frame, &Frame::tabShown, this, [this](const QString& id) {
    if (!isTabShown()) setAnnotating(false);
    if (is_of_labels(id)) setAnnotating(isTabShown());
  });
  connect(&bench.frame, &Frame::tabShown, this, &AnnotateController::showScribbles);
  connect(&bench.viewer_area, &ViewerArea::previewChanged, this, &AnnotateController::showMode);
  connect(&bench.labels, &LabelChoice::changed, this, &AnnotateController::showColor);
  connect(&document_, &DocumentController::replaced, this, &AnnotateController::showMode);
  connect(&document_, &DocumentController::changed, &bench.commands, &Commands::refresh);
  connect(&document_, &DocumentController::steppedBack, this, &AnnotateController::goTo);
  connect(&wand_, &Wand::ready, this, [this] {
    if (tool_ == AnnotationTool::Wand) bench_.messages.hint(tr("The wand is ready."));
  });
  session_.on_changed([this](Parts parts) {
    if (parts.has_any(Part::Scene | Part::Estimates | Part::Shown)) prepareWand();
    if (!parts.has(Part::View)) return;
    endGesture();
    polygon_tool_->setAway(session_.view() != polygon_view_);
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
  connectFill();
  connect(pick_tool_, &PointTool::pointPicked, this, &AnnotateController::pick);
  paintOutlined(*polygon_tool_, EditKind::Polygon);
  paintOutlined(*lasso_tool_, EditKind::Lasso);
  connect(polygon_tool_, &OutlineTool::cornersChanged, this, [this] {
    const bool is_open = polygon_tool_->isDrawing();
    if (std::exchange(is_polygon_open_, is_open) != is_open) {
      if (is_open) polygon_view_ = session_.view();
      polygon_tool_->setAway(false);
    }
    bench_.commands.refresh();
  });
  connect(polygon_tool_, &PolygonTool::pressedAway, this, [this] {
    bench_.messages.hint(tr("The polygon belongs to view v %1, u %2: go there to continue it. "
                            "Return closes it, Esc ends it.")
                             .arg(polygon_view_.v)
                             .arg(polygon_view_.u));
  });
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
  if (is_annotating) bench_.viewer_area.requestSingleView();
  showMode();
}

bool AnnotateController::isTabShown() const {
  // What is checked is corrected at once.
  const Panes& panes = bench_.frame.panes();
  return panes.isSeen("tab.annotate") || panes.isSeen("tab.check");
}

void AnnotateController::showScribbles() {
  canvas_->setScribbleOpacity(isTabShown() ? panel_->scribbleOpacity() : 0);
}

CanvasTool* AnnotateController::canvasTool() const {
  if (tool_ == AnnotationTool::Fill || tool_ == AnnotationTool::Wand) return fill_tool_;
  if (tool_ == AnnotationTool::Pick) return pick_tool_;
  if (tool_ == AnnotationTool::Polygon) return polygon_tool_;
  if (tool_ == AnnotationTool::Lasso) return lasso_tool_;
  return stroke_tool_;
}

void AnnotateController::endGesture() {
  fill_tool_->cancel();
  canvasTool()->end();
}

void AnnotateController::showMode() {
  const bool is_painting = is_annotating_ && !bench_.viewer_area.isPreviewing() && hasDocument();
  if (!is_painting) endGesture();
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
  endGesture();
  tool_ = tool;
  stroke_tool_->setErasing(tool == AnnotationTool::Eraser);
  setAnnotating(true);
  showMode();
  prepareWand();
}

void AnnotateController::prepareWand() {
  if (tool_ != AnnotationTool::Wand || !hasDocument()) return;
  const Wand::State state = wand_.prepare();
  if (state == Wand::State::Making) {
    bench_.messages.hint(tr("The wand gathers the rays of all views …"));
  } else if (state == Wand::State::Missing) {
    emit disparityWanted();
    bench_.messages.hint(
        bench_.jobs.count(Lane::Estimate) > 0
            ? tr("The wand follows rays by disparity, which is being estimated …")
            : tr("The wand needs the disparity of all views: run a method in the Estimate tab."));
  }
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
    document_.edit([name = bench_.labels.newName()](AnnotationDocument& document) {
      document.add_painted_label(name);
    });
  }
  const LabelInfo* label = bench_.labels.info();
  if (!label) return false;
  LabelMarks marks = session_.place().label_marks;
  if (marks.locked.contains(label->id)) {
    bench_.messages.hint(tr("“%1” is locked: unlock it to paint it, or choose another label.")
                             .arg(label_name(*label)));
    return false;
  }
  if (marks.hidden.erase(label->id) > 0) session_.set_label_marks(marks);
  return true;
}

void AnnotateController::paintOutlined(const OutlineTool& tool, EditKind kind) {
  connect(&tool, &OutlineTool::outlined, this,
          [this, kind](const QPolygonF& corners, const StrokeStart& start) {
            if (!hasDocument() || (!start.erases && !requireLabel())) return;
            if (kind == EditKind::Polygon) session_.set_view(polygon_view_);
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

void AnnotateController::connectFill() {
  FillTool* tool = fill_tool_;
  connect(tool, &FillTool::fillRequested, this, &AnnotateController::fill);
  connect(tool, &FillTool::hovered, this, [this](QPointF at) { previewFill(pixel_of(at)); });
  connect(canvas_, &ViewCanvas::cursorMoved, this, [this](std::optional<PixelIndex> pixel) {
    if (!pixel) fill_tool_->setPreview({}, {});
  });
  connect(tool, &FillTool::pressed, this, [this](QPointF at) {
    tolerance_at_press_ = panel_->fillTolerance();
    previewFill(pixel_of(at));
  });
  connect(tool, &FillTool::dragged, this, [this](double factor) {
    if (tool_ == AnnotationTool::Fill && panel_->fillBound() != FillBound::Likeness) return;
    panel_->setFillTolerance(tolerance_at_press_ * factor);
    previewFill(fill_seed_);
  });
  connect(tool, &FillTool::shapeChanged, this, [this] {
    const bool is_shown = !fill_tool_->preview().isNull();
    if (std::exchange(is_fill_shown_, is_shown) != is_shown) bench_.commands.refresh();
  });
  connect(tool, &FillTool::cancelled, this,
          [this] { panel_->setFillTolerance(tolerance_at_press_); });
}

// Half transparent, in the color of the label.
void AnnotateController::previewFill(PixelIndex seed) {
  constexpr int kAlpha = 120;
  fill_seed_ = seed;
  const PixelRegion region = hasDocument() ? regionAt(seed) : PixelRegion();
  PixelRect bounds;
  for (const PixelSpan& span : region) bounds.include({span.y, span.x0, span.y + 1, span.x1});
  if (region.empty()) return fill_tool_->setPreview({}, {});
  const LabelInfo* label = bench_.labels.info();
  const Rgb color = label ? label->color : label_color(1);
  QImage picture(bounds.x1 - bounds.x0, bounds.y1 - bounds.y0, QImage::Format_ARGB32);
  picture.fill(Qt::transparent);
  for (const PixelSpan& span : region) {
    auto* row = reinterpret_cast<QRgb*>(picture.scanLine(span.y - bounds.y0));
    std::fill(row + span.x0 - bounds.x0, row + span.x1 - bounds.x0,
              qRgba(color[0], color[1], color[2], kAlpha));
  }
  fill_tool_->setPreview(picture, {bounds.x0, bounds.y0});
}

// Made once for a view.
const Likeness& AnnotateController::likeness() {
  const ViewIndex view = session_.view();
  const LightFieldPtr light_field = session_.light_field();
  const auto disparity = session_.known_disparity(view);
  const bool is_known = likeness_ && likeness_key_.view == view &&
                        likeness_key_.light_field.lock() == light_field &&
                        likeness_key_.disparity.lock() == disparity;
  if (!is_known) {
    likeness_ =
        std::make_unique<const Likeness>(light_field->view_as_float(view).view(),
                                         disparity ? disparity->view(view) : DisparityView{});
    likeness_key_ = {light_field, view, disparity};
  }
  return *likeness_;
}

// Smoothed once for a view: the cursor asks for a region at each move.
ImageView<const std::int32_t> AnnotateController::segments(const MapSource& source) {
  const ViewIndex view = session_.view();
  if (segments_key_.labeling.lock() != source.labeling || segments_key_.view != view ||
      !(segments_key_.finish == source.finish)) {
    segments_ = finished_labels(*source.labeling, source.finish, view);
    segments_key_ = {source.labeling, source.finish, view};
  }
  return std::as_const(segments_).view();
}

PixelRegion AnnotateController::regionAt(PixelIndex seed) {
  const ViewIndex view = session_.view();
  if (tool_ == AnnotationTool::Wand) return wand_.region(wandAt(seed), view);
  if (panel_->fillBound() == FillBound::Segmentation) {
    const auto source = bench_.overlay.sourceOf({render::Quantity::Segmentation});
    if (source) {
      return region_of_segment(segments(*source), seed);
    }
  }
  return likeness().region(seed, panel_->fillTolerance());
}

std::vector<std::uint8_t> AnnotateController::wandAt(PixelIndex seed) {
  if (wand_.prepare() != Wand::State::Ready) return {};
  return wand_.select(session_.view(), seed,
                      static_cast<float>(panel_->fillTolerance()) * likeness().noise());
}

void AnnotateController::fill(const StrokeStart& start) {
  if (!hasDocument() || (!start.erases && !requireLabel())) return;
  if (tool_ == AnnotationTool::Wand && wand_.prepare() != Wand::State::Ready) return prepareWand();
  const PixelIndex seed = pixel_of(start.at);
  const auto regions = tool_ == AnnotationTool::Wand
                           ? wand_.regions(wandAt(seed))
                           : std::vector<ViewRegion>{{session_.view(), regionAt(seed)}};
  fill_tool_->setPreview({}, {});
  // A fill reaches far: it goes around strokes unless Shift was held.
  PaintStyle style = styleOf(start);
  style.protects_others = !start.protects_others || protects_others_;
  document_.edit([&](AnnotationDocument& document) { fill_regions(document, regions, style); });
}

// Label of the segment at a pixel; 0 where there is none.
int AnnotateController::segmentAt(PixelIndex pixel) const {
  const auto source = bench_.overlay.sourceOf({render::Quantity::Segmentation});
  if (!source) return 0;
  const auto labels = source->labeling->labels.view(session_.view());
  const bool is_inside =
      pixel.y >= 0 && pixel.y < labels.height && pixel.x >= 0 && pixel.x < labels.width;
  return is_inside ? labels.at(pixel.y, pixel.x) : 0;
}

void AnnotateController::pick(QPointF image) {
  if (!hasDocument()) return;
  const PixelIndex pixel = pixel_of(image);
  int id = document_.document()->scribbles().label_at(session_.view(), pixel);
  if (id == 0) id = segmentAt(pixel);
  if (id == 0) {
    bench_.messages.hint(tr("Nothing is painted or segmented here."));
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

namespace {

QString edit_text(EditKind kind) {
  switch (kind) {
    case EditKind::Paint:
    case EditKind::AddPaintedLabel:
      return AnnotateController::tr("stroke");
    case EditKind::Erase:
      return AnnotateController::tr("erasing");
    case EditKind::Fill:
      return AnnotateController::tr("fill");
    case EditKind::AddLabel:
      return AnnotateController::tr("new label");
    case EditKind::RenameLabel:
      return AnnotateController::tr("label name");
    case EditKind::RecolorLabel:
      return AnnotateController::tr("label color");
    case EditKind::RemoveLabel:
      return AnnotateController::tr("label removal");
    case EditKind::Import:
      return AnnotateController::tr("import");
    case EditKind::SmoothBoundaries:
      return AnnotateController::tr("smooth boundaries");
    case EditKind::Polygon:
      return AnnotateController::tr("polygon");
    case EditKind::Lasso:
      return AnnotateController::tr("lasso");
    case EditKind::MergeLabel:
      return AnnotateController::tr("merging of labels");
    case EditKind::RenumberLabel:
      return AnnotateController::tr("label number");
    case EditKind::MoveLabel:
      return AnnotateController::tr("order of labels");
    case EditKind::ImportSegmentation:
      return AnnotateController::tr("import of a segmentation");
  }
  return {};
}

}  // namespace

void AnnotateController::addModeCommand() {
  bench_.commands.add({.id = "annotate.mode",
                       .menu = Menu::Annotate,
                       .text = tr("Annotate"),
                       .tip = tr("Switches between painting labels and browsing"),
                       .icon = "brush",
                       .keys = {tr("Ctrl+B")},
                       .run = [this] { setAnnotating(!is_annotating_); },
                       .section = annotate_section::kMode,
                       .bar = BarSection::Files,
                       .enabled = [this] { return hasDocument(); },
                       .checked = [this] { return is_annotating_; }});
}

void AnnotateController::addHistoryCommands() {
  const auto undone = [this] { return hasDocument() ? history().next_undo() : nullptr; };
  const auto redone = [this] { return hasDocument() ? history().next_redo() : nullptr; };
  bench_.commands.add(
      {.menu = Menu::Annotate, .section = annotate_section::kHistory},
      {{.id = "annotate.undo",
        .text = tr("Undo"),
        .tip = tr("Undoes the last stroke or change of labels, on whichever view it was made"),
        .icon = "undo",
        .keys = {tr("Ctrl+Z")},
        .run = [this] { document_.undo(); },
        .enabled = [undone] { return undone() != nullptr; },
        .live_text =
            [undone] {
              return undone() ? tr("Undo %1").arg(edit_text(undone()->kind)) : tr("Undo");
            }},
       {.id = "annotate.redo",
        .text = tr("Redo"),
        .tip = tr("Redoes the last undone change"),
        .icon = "redo",
        .keys = {tr("Ctrl+Y"), tr("Ctrl+Shift+Z")},
        .run = [this] { document_.redo(); },
        .enabled = [redone] { return redone() != nullptr; },
        .live_text =
            [redone] {
              return redone() ? tr("Redo %1").arg(edit_text(redone()->kind)) : tr("Redo");
            }}});
}

void AnnotateController::addToolCommands() {
  struct Row {
    AnnotationTool tool;
    QString id;
    QString text;
    QString tip;
    QKeySequence key;
  };
  for (const Row& row : std::initializer_list<Row>{
           {AnnotationTool::Brush, "brush", tr("Brush"),
            tr("Paints the current label; the right button erases"), Qt::Key_B},
           {AnnotationTool::Eraser, "eraser", tr("Eraser"), tr("Erases what is painted"),
            Qt::Key_E},
           {AnnotationTool::Fill, "fill", tr("Fill"),
            tr("Fills a region up to its edges; the right button clears it"), Qt::Key_F},
           {AnnotationTool::Wand, "wand", tr("Wand, all views"),
            tr("Fills a region in all views: like colors on one surface; the right button clears "
               "it"),
            tr("Shift+F")},
           {AnnotationTool::Polygon, "polygon", tr("Polygon"),
            tr("Paints the inside of a polygon: click its corners, then double-click or press "
               "Return; begin with the right button to erase"),
            Qt::Key_O},
           {AnnotationTool::Lasso, "lasso", tr("Lasso"),
            tr("Paints the region that a drag encloses; the right button erases it"), Qt::Key_Q},
           {AnnotationTool::Pick, "pick", tr("Pick label"),
            tr("Selects the label under the cursor"), Qt::Key_I}}) {
    QAction* action =
        bench_.commands.add({.id = "annotate." + row.id,
                             .menu = Menu::Annotate,
                             .text = row.text,
                             .tip = row.tip,
                             .icon = row.id,
                             .keys = {row.key},
                             .run = [this, tool = row.tool] { setTool(tool); },
                             .section = annotate_section::kTools,
                             .enabled = [this] { return hasDocument(); },
                             .checked = [this, tool = row.tool] { return tool_ == tool; },
                             .choice = "annotate.tool"});
    panel_->addAction(action);
  }
}

void AnnotateController::addPolygonCommands() {
  const auto is_drawing = [this] { return polygon_tool_->isDrawing(); };
  bench_.commands.add(
      {.menu = Menu::Annotate, .section = annotate_section::kTools},
      {{.id = "annotate.close_polygon",
        .text = tr("Close the polygon, or accept the region"),
        .tip = tr("Paints the inside of the polygon being drawn; without one, paints the marked "
                  "region in doubt with the label that it has, else what the fill or the wand "
                  "shows under the cursor"),
        .keys = {Qt::Key_Return, Qt::Key_Enter},
        .run =
            [this] {
              if (polygon_tool_->close()) return;
              bench_.labels.hasRegion() ? bench_.labels.acceptRegion() : fillShown();
            },
        .scope = KeyScope::Viewer,
        .enabled =
            [this, is_drawing] {
              return is_drawing() || bench_.labels.hasRegion() || is_fill_shown_;
            }},
       {.id = "annotate.take_corner_back",
        .text = tr("Remove the last corner"),
        .tip = tr("Removes the last corner of the polygon"),
        .keys = {Qt::Key_Backspace},
        .run = [this] { polygon_tool_->removeCorner(); },
        .scope = KeyScope::Viewer,
        .enabled = is_drawing}});
}

void AnnotateController::addSizeCommands() {
  const auto has_document = [this] { return hasDocument(); };
  bench_.commands.add(
      {.menu = Menu::Annotate, .section = annotate_section::kTools, .enabled = has_document},
      {{.id = "annotate.larger",
        .text = tr("Larger brush"),
        .tip = tr("Enlarges the brush, or the eraser while it is in use"),
        .keys = {Qt::Key_BracketRight, Qt::Key_Period},
        .run = [this] { stepSize(1); }},
       {.id = "annotate.smaller",
        .text = tr("Smaller brush"),
        .tip = tr("Shrinks the brush, or the eraser while it is in use"),
        .keys = {Qt::Key_BracketLeft, Qt::Key_Comma},
        .run = [this] { stepSize(-1); }},
       {.id = "annotate.protect",
        .text = tr("Protect other labels"),
        .tip = tr("Paints only unpainted pixels and erases only the current label, as holding "
                  "Shift does"),
        .run = [this] { setProtectsOthers(!protects_others_); },
        .checked = [this] { return protects_others_; }}});
}

const History<Edit>& AnnotateController::history() const {
  return document_.document()->history();
}

void AnnotateController::addCommands() {
  addModeCommand();
  addHistoryCommands();
  addToolCommands();
  addPolygonCommands();
  addSizeCommands();
  panel_->addGap();
  for (const char* id : {"annotate.undo", "annotate.redo"}) {
    panel_->addAction(bench_.commands.find(id));
  }
}

}  // namespace episcope

#include "moc_annotate_controller.cpp"
