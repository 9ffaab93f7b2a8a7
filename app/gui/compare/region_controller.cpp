// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/region_controller.h"

#include "app/gui/compare/compare_controller.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "engine/io/models/sidecar_maps/map_file.h"
#include "widgets/canvas/canvas_geometry.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/panels/overlay_bar.h"

#include <QFileInfo>
#include <QLocale>

#include <algorithm>

namespace episcope {
namespace {

QString rectangle_hint() {
  return RegionController::tr("Drag a rectangle on the view. Esc leaves it.");
}

PixelEdges edges_of(const PixelRect& rectangle) {
  const QPoint a(rectangle.x0, rectangle.y0), b(rectangle.x1, rectangle.y0),
      c(rectangle.x1, rectangle.y1), d(rectangle.x0, rectangle.y1);
  return {{a, b}, {b, c}, {d, c}, {a, d}};
}

template <class IsInside>
RegionPtr mask_where(const LightField& light_field, IsInside is_inside) {
  auto mask = std::make_shared<Image<std::uint8_t>>(light_field.height(), light_field.width());
  for (int y = 0; y < mask->height(); ++y) {
    for (int x = 0; x < mask->width(); ++x) mask->at(y, x) = is_inside(y, x) ? 1 : 0;
  }
  return mask;
}

}  // namespace

RegionController::RegionController(const Workbench& bench, RegionBar* bar)
    : QObject(&bench.owner), bench_(bench), bar_(bar), tool_(new RectangleTool(this)) {
  listParts();
  addCommands(*bar);
  connectTool();
  connect(bar_, &RegionBar::partChosen, this, &RegionController::choosePart);
  connect(&bench.labels, &LabelChoice::changed, this, [this] {
    if (now().pixels == JudgedPixels::Label) refresh();
  });
  connect(&bench.document, &DocumentController::changed, this, [this] {
    if (now().pixels == JudgedPixels::Label) refresh();
  });
  bench.cancels.add(CancelRank::Stroke, [this] {
    if (bench_.viewer_area.canvas()->tool() != tool_) return false;
    endRectangle();
    refresh();
    return true;
  });
  bench.session.on_changed([this](Parts parts) { update(parts); });
  refresh();
}

RegionController::~RegionController() {
  if (bench_.viewer_area.canvas()->tool() == tool_) bench_.viewer_area.canvas()->setTool(nullptr);
}

void RegionController::addCommands(RegionBar& bar) {
  QAction* draw = bench_.commands.add(
      {.id = "compare.rectangle",
       .menu = Menu::Compare,
       .text = tr("Evaluate a rectangle"),
       .tip = tr("The next drag on the view draws a rectangle in which metrics are computed"),
       .icon = "rectangle",
       .keys = {tr("Ctrl+Alt+R")},
       .run = [this] { beginRectangle(); },
       .section = compare_section::kRange,
       .enabled = [this] { return bench_.session.scene() != nullptr; }});
  bench_.commands.add({.id = "compare.whole",
                       .menu = Menu::Compare,
                       .text = tr("Evaluate the whole view"),
                       .tip = tr("Computes metrics over the whole view again"),
                       .keys = {tr("Ctrl+Alt+W")},
                       .run = [this] { choose(JudgedPixels::Whole); },
                       .section = compare_section::kRange,
                       .enabled = [this] { return now().pixels != JudgedPixels::Whole; }});
  bar.addAction(draw);
}

void RegionController::connectTool() {
  connect(tool_, &RectangleTool::rectangleDragged, this, [this](const PixelRect& rectangle) {
    bench_.viewer_area.canvas()->setRegion(edges_of(clipped(rectangle)));
  });
  connect(tool_, &RectangleTool::rectangleCancelled, this, &RegionController::showOutline);
  connect(
      tool_, &RectangleTool::rectangleDrawn, this,
      [this](const PixelRect& rectangle) {
        endRectangle();
        if (clipped(rectangle).empty()) return refresh();
        JudgedPart part = now();
        part.rectangle = clipped(rectangle);
        set(part);
        choose(JudgedPixels::Rectangle);
      },
      Qt::QueuedConnection);  // the canvas is still busy with the release
}

PixelRect RegionController::clipped(PixelRect rectangle) const {
  const LightFieldPtr light_field = bench_.session.light_field();
  if (!light_field) return {};
  return episcope::clipped(rectangle, light_field->height(), light_field->width());
}

void RegionController::beginRectangle() {
  if (const LightFieldPtr light_field = bench_.session.light_field()) {
    bench_.session.set_view(light_field->center());  // which is judged
  }
  bench_.viewer_area.requestSingleView();
  ViewCanvas* canvas = bench_.viewer_area.canvas();
  if (canvas->tool() != tool_) former_tool_ = canvas->tool();
  canvas->setTool(tool_);
  bench_.messages.hint(rectangle_hint());
}

void RegionController::endRectangle() {
  tool_->cancel();  // before it is taken away, which would end the gesture as a release does
  ViewCanvas* canvas = bench_.viewer_area.canvas();
  if (canvas->tool() == tool_) canvas->setTool(former_tool_);
  former_tool_ = nullptr;
  bench_.messages.retract(rectangle_hint());
}

// Rows before those of region masks are in the order of JudgedPixels.
void RegionController::listParts() {
  regions_.clear();
  QStringList names{tr("Whole center view"), tr("Rectangle"), tr("Current label"),
                    tr("Where all results have values"), tr("Mask from a file…")};
  if (const auto& scene = bench_.session.scene()) {
    for (const auto& [name, mask] : scene->truth->regions) {
      regions_.push_back(name);
      names << tr("Region: %1").arg(QString::fromStdString(name).replace('_', ' '));
    }
  }
  bar_->setParts(names);
}

void RegionController::choosePart(int row) {
  const int region = row - static_cast<int>(JudgedPixels::Region);
  if (region < 0) return choose(static_cast<JudgedPixels>(row));
  JudgedPart part = now();
  part.pixels = JudgedPixels::Region;
  part.region = regions_[static_cast<std::size_t>(region)];
  set(part);
  refresh();
}

int RegionController::rowOfPart() const {
  const auto first = static_cast<int>(JudgedPixels::Region);
  if (now().pixels != JudgedPixels::Region) return static_cast<int>(now().pixels);
  const auto found = std::ranges::find(regions_, now().region);
  return found == regions_.end() ? 0 : first + static_cast<int>(found - regions_.begin());
}

void RegionController::choose(JudgedPixels pixels) {
  if (pixels == JudgedPixels::Mask) {
    askForMask();
  } else if (pixels == JudgedPixels::Rectangle && now().rectangle.empty()) {
    beginRectangle();
  } else {
    JudgedPart part = now();
    part.pixels = pixels;
    set(part);
  }
  refresh();
}

void RegionController::askForMask() {
  ask_for_file(&bench_.window,
               {.name = "open_mask",
                .title = tr("Mask of the evaluated pixels: all that are not black"),
                .filter = tr("Images (*.png *.tif *.tiff *.pgm *.bmp)")},
               [this](const QString& path) { useMask(path); });
}

void RegionController::useMask(const QString& path) {
  const std::uint64_t scene = bench_.session.generation();
  masks_.erase(scene);  // it may have changed
  readMask(scene, QFileInfo(path).absoluteFilePath().toStdString());
}

void RegionController::readMask(std::uint64_t scene, const std::string& path) {
  if (masks_[scene].path == path) return;
  masks_[scene] = {path, nullptr};
  bench_.jobs.start<RegionPtr>(
      Lane::Load, tr("Mask %1").arg(QFileInfo(QString::fromStdString(path)).fileName()),
      [path](const Progress&) {
        return std::make_shared<const Image<std::uint8_t>>(io::read_mask(path));
      },
      [this, path, scene](const RegionPtr& mask) { takeMask(scene, path, mask); },
      [this, path, scene] {
        const auto read = masks_.find(scene);
        if (read != masks_.end() && read->second.path == path && !read->second.pixels) {
          dropMask(scene, path);
        }
      });
}

void RegionController::takeMask(std::uint64_t scene, const std::string& path,
                                const RegionPtr& mask) {
  const OpenScene* open = bench_.session.find_scene(scene);
  if (!open || !open->scene || masks_[scene].path != path) return;
  const LightField& light_field = *open->scene->light_field;
  if (mask->height() != light_field.height() || mask->width() != light_field.width()) {
    bench_.messages.warn(tr("The mask has %1×%2 px, but the views have %3×%4 px: choose a mask of "
                            "the size of the views.")
                             .arg(mask->width())
                             .arg(mask->height())
                             .arg(light_field.width())
                             .arg(light_field.height()));
    if (scene == bench_.session.generation()) bench_.messages.endWithLightField();
    return;
  }
  masks_[scene].pixels = mask;
  JudgedPart part = open->place.judged;
  part.pixels = JudgedPixels::Mask;
  part.mask = path;
  bench_.session.set_judged(scene, part);
  refresh();
}

// Keeps the previous region, or the whole view if a project named the mask.
void RegionController::dropMask(std::uint64_t scene, const std::string& path) {
  masks_.erase(scene);
  const OpenScene* open = bench_.session.find_scene(scene);
  if (!open || open->place.judged.pixels != JudgedPixels::Mask) return;
  JudgedPart part = open->place.judged;
  if (part.mask == path) {
    part.pixels = JudgedPixels::Whole;
    part.mask.clear();
    bench_.session.set_judged(scene, part);
  }
  refresh();
}

void RegionController::update(Parts parts) {
  if (parts.has(Part::Scenes)) {
    std::erase_if(masks_,
                  [this](const auto& each) { return !bench_.session.find_scene(each.first); });
  }
  const JudgedPixels pixels = now().pixels;
  const bool is_new = parts.has(Part::Scene) ||
                      (pixels == JudgedPixels::Common && parts.has(Part::Estimates)) ||
                      (pixels == JudgedPixels::Label && parts.has(Part::Labels));
  if (parts.has(Part::Scene)) {
    endRectangle();
    listParts();
  }
  if (is_new) {
    refresh();
  } else if (parts.has(Part::View)) {
    showOutline();
  }
}

RegionPtr RegionController::makeRegion() {
  const LightFieldPtr light_field = bench_.session.light_field();
  if (!light_field) return nullptr;
  switch (now().pixels) {
    case JudgedPixels::Whole:
      break;
    case JudgedPixels::Label:
      return labelRegion();
    case JudgedPixels::Common:
      return commonRegion();
    case JudgedPixels::Mask:
      return maskRegion();
    case JudgedPixels::Region:
      return truthRegion();
    case JudgedPixels::Rectangle:
      return mask_where(*light_field, [r = clipped(now().rectangle)](int y, int x) {
        return y >= r.y0 && y < r.y1 && x >= r.x0 && x < r.x1;
      });
  }
  return nullptr;
}

// The mask of a project is read when its scene is first shown.
RegionPtr RegionController::maskRegion() {
  const std::uint64_t scene = bench_.session.generation();
  readMask(scene, now().mask);
  return masks_[scene].pixels;
}

// A light field that lost its masks is evaluated everywhere.
RegionPtr RegionController::truthRegion() const {
  const auto& regions = bench_.session.scene()->truth->regions;
  const auto found = regions.find(now().region);
  const LightField& light_field = *bench_.session.light_field();
  if (found == regions.end() || found->second.height() != light_field.height() ||
      found->second.width() != light_field.width()) {
    return nullptr;
  }
  return mask_where(light_field,
                    [&mask = found->second](int y, int x) { return mask.at(y, x) != 0; });
}

// Pixels of the segmentation of the evaluated view, or of its strokes without a segmentation.
RegionPtr RegionController::labelRegion() const {
  const Session& session = bench_.session;
  const LightField& light_field = *session.light_field();
  const ViewIndex view = judged_view(*session.scene());
  const int label = bench_.labels.current();
  const LabelingPtr& labeling = session.labels().labeling;
  if (labeling && labeling->labels.contains(view)) {
    const auto labels = labeling->labels.view(view);
    return mask_where(light_field, [&](int y, int x) { return labels.at(y, x) == label; });
  }
  const AnnotationDocument* document = bench_.document.document();
  const auto painted =
      document ? document->scribbles().view(view) : ImageView<const std::uint8_t>();
  return mask_where(light_field, [&](int y, int x) {
    return !painted.empty() && label != 0 && painted.at(y, x) == label;
  });
}

RegionPtr RegionController::commonRegion() const {
  const Session& session = bench_.session;
  const ViewIndex view = judged_view(*session.scene());
  std::vector<DisparityView> maps;
  for (const EstimateEntry& entry : session.estimates()) {
    if (entry.estimate->contains(view)) maps.push_back(entry.estimate->field.view(view));
  }
  return mask_where(*session.light_field(), [&](int y, int x) {
    return std::ranges::all_of(maps, [&](const DisparityView& map) { return map.is_valid(y, x); });
  });
}

void RegionController::refresh() {
  region_ = makeRegion();
  bar_->setCurrent(rowOfPart());
  const auto count = region_ ? std::count_if(region_->data(), region_->data() + region_->size(),
                                             [](std::uint8_t inside) { return inside != 0; })
                             : 0;
  bar_->setSummary(region_ ? tr("%1 px").arg(QLocale::c().toString(static_cast<qlonglong>(count)))
                           : QString());
  showOutline();
  bench_.commands.refresh();
  emit changed();
}

void RegionController::showOutline() {
  const Session& session = bench_.session;
  const bool is_seen = region_ && session.view() == judged_view(*session.scene());
  bench_.viewer_area.canvas()->setRegion(is_seen ? outline_of(region_->view(), {}) : PixelEdges());
}

QString RegionController::name() const {
  const PixelRect rectangle = clipped(now().rectangle);
  const LabelInfo* label = bench_.labels.info();
  switch (now().pixels) {
    case JudgedPixels::Rectangle:
      return tr("rectangle x %1–%2, y %3–%4")
          .arg(rectangle.x0)
          .arg(rectangle.x1 - 1)
          .arg(rectangle.y0)
          .arg(rectangle.y1 - 1);
    case JudgedPixels::Label:
      return tr("label %1").arg(label ? QString::fromStdString(label->name) : QString());
    case JudgedPixels::Common:
      return tr("where all results have values");
    case JudgedPixels::Mask:
      return tr("mask %1").arg(QFileInfo(QString::fromStdString(now().mask)).fileName());
    case JudgedPixels::Region:
      if (region_) return tr("region %1").arg(QString::fromStdString(now().region));
      break;
    case JudgedPixels::Whole:
      break;
  }
  return tr("whole view");
}

}  // namespace episcope

#include "moc_region_controller.cpp"
