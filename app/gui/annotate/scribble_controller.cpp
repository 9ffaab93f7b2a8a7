// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/scribble_controller.h"

#include "annotation/propagate.h"
#include "app/gui/annotate/annotate_controller.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/frame.h"
#include "widgets/canvas/canvas_geometry.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/panels/brush_panel.h"

#include <algorithm>

namespace episcope {

ScribbleController::ScribbleController(const Workbench& bench, AnnotationBar* bar)
    : QObject(&bench.owner),
      bench_(bench),
      session_(bench.session),
      document_(bench.document),
      canvas_(bench.viewer_area.canvas()),
      bar_(bar),
      carry_job_(this) {
  addCommand();
  connect(&document_, &DocumentController::painted, this, &ScribbleController::showRect);
  connect(&document_, &DocumentController::changed, this, &ScribbleController::showChange);
  connect(&document_, &DocumentController::replaced, this, [this] {
    bar_->setEnabled(document_.document() != nullptr);
    dropCarried();
    show();
    carry();
  });
  connect(&bench.viewer_area, &ViewerArea::previewChanged, this, &ScribbleController::show);
  connect(bar_, &AnnotationBar::carriedEdited, this, &ScribbleController::setCarried);
  connect(bar_, &AnnotationBar::carriedByEdited, this, &ScribbleController::carry);
  session_.on_changed([this](Parts parts) { update(parts); });
  bar_->setEnabled(false);
}

void ScribbleController::addCommand() {
  bench_.commands.add({.id = "annotate.carry",
                       .menu = Menu::Annotate,
                       .text = tr("Propagate to all views"),
                       .tip = tr("Shows the scribbles of every view on all others"),
                       .icon = "carry",
                       .keys = {Qt::Key_C},
                       .run = [this] { setCarried(!is_carried_); },
                       .section = annotate_section::kCarry,
                       .enabled = [this] { return document_.document() != nullptr; },
                       .checked = [this] { return is_carried_; }});
}

void ScribbleController::update(Parts parts) {
  if (parts.has_any(Part::Scene | Part::Estimates | Part::Shown)) {
    bar_->setSources(session_.shown() || session_.label_disparity(),
                     session_.scene() && session_.scene()->truth->has_disparity());
    if (field() != carried_by_) carry();
  }
  if (parts.has_any(Part::View | Part::LabelLook)) show();
}

QImage ScribbleController::picture(const PixelRect& rect) const {
  const AnnotationDocument& document = *document_.document();
  const ViewIndex view = session_.view();
  ScribbleLayers layers{document.scribbles().view(view), {}};
  if (carried_) layers.carried = carried_->view(view);
  return scribble_picture(layers, document.labels(), rect, session_.label_style());
}

void ScribbleController::show() {
  const AnnotationDocument* document = document_.document();
  if (!document || bench_.viewer_area.isPreviewing()) {
    canvas_->setScribbles({});
    return;
  }
  const ScribbleLayer& layer = document->scribbles();
  canvas_->setScribbles(picture({0, 0, layer.height(), layer.width()}));
}

void ScribbleController::showRect(ViewIndex view, const PixelRect& rect) {
  if (view != session_.view() || bench_.viewer_area.isPreviewing()) return;
  // What is painted beside a pixel decides whether that is on a contour.
  const ScribbleLayer& layer = document_.document()->scribbles();
  const PixelRect wider{std::max(rect.y0 - 1, 0), std::max(rect.x0 - 1, 0),
                        std::min(rect.y1 + 1, layer.height()),
                        std::min(rect.x1 + 1, layer.width())};
  canvas_->patchScribbles({wider.x0, wider.y0}, picture(wider));
}

void ScribbleController::showChange(const DocumentChange& change) {
  if (change.has_new_labels) {
    show();  // colors may be others
  } else {
    for (const auto& part : change.views) showRect(part.view, part.rect);
  }
  if (!change.views.empty()) carry();
}

void ScribbleController::setCarried(bool is_carried) {
  is_carried_ = is_carried;
  bar_->setCarried(is_carried);
  if (!is_carried) {
    dropCarried();
    show();
  } else if (session_.scene() && !field()) {
    bench_.messages.hint(
        tr("Propagating scribbles needs a disparity: run a method in the Estimate tab."));
  }
  carry();
  bench_.commands.refresh();
}

std::shared_ptr<const DisparityField> ScribbleController::field() const {
  const auto& scene = session_.scene();
  if (!scene) return nullptr;
  const EstimateEntry* shown = session_.shown();
  if (shown && bar_->carriedBy() == AnnotationBar::CarriedBy::Estimate) {
    return {shown->estimate, &shown->estimate->field};
  }
  const bool wants_truth = bar_->carriedBy() == AnnotationBar::CarriedBy::Truth;
  if (session_.label_disparity() && !(wants_truth && scene->truth->has_disparity())) {
    return session_.label_disparity();
  }
  return scene->truth->has_disparity()
             ? std::shared_ptr<const DisparityField>(scene->truth, &scene->truth->field)
             : nullptr;
}

void ScribbleController::dropCarried() {
  carry_job_.drop();
  is_carrying_ = false;
  carried_by_ = nullptr;
  bar_->setCarryState({});
  carried_ = nullptr;
}

void ScribbleController::carry() {
  const AnnotationDocument* document = document_.document();
  const auto by = field();
  if (!is_carried_ || !document || !by) {
    dropCarried();
    return;
  }
  using Layer = std::shared_ptr<const ScribbleLayer>;
  is_carrying_ = true;
  carried_by_ = by;
  bar_->setCarryState(tr("propagating …"));
  carry_job_.start<Layer>(
      [painted = std::make_shared<const ScribbleLayer>(document->scribbles()),
       by](const Progress& progress) -> Layer {
        return std::make_shared<const ScribbleLayer>(propagate(*painted, *by, {}, progress));
      },
      [this](const Layer& carried) {
        is_carrying_ = false;
        carried_ = carried;
        bar_->setCarryState({});
        show();
      });
}

}  // namespace episcope

#include "moc_scribble_controller.cpp"
