// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/scribble_controller.h"

#include "annotation/paint/propagate.h"
#include "widgets/annotate/annotation_bar.h"
#include "widgets/browse/view_grid.h"
#include "widgets/canvas/scribble_picture.h"
#include "widgets/canvas/view_canvas.h"

#include <utility>

namespace episcope {

ScribbleController::ScribbleController(Session& session, DocumentController& document,
                                       const Panels& panels, QObject* parent)
    : QObject(parent), session_(session), document_(document), panels_(panels), carry_job_(this) {
  connect(&document_, &DocumentController::painted, this, &ScribbleController::showRect);
  connect(&document_, &DocumentController::changed, this, &ScribbleController::showChange);
  connect(&document_, &DocumentController::replaced, this, [this] {
    dropCarried();
    show();
    markViews();
    carry();
  });
  connect(panels_.annotation, &AnnotationBar::carriedEdited, this, &ScribbleController::setCarried);
  connect(panels_.annotation, &AnnotationBar::carriedByEdited, this, &ScribbleController::carry);
  session_.on_changed([this](Parts parts) { update(parts); });
}

void ScribbleController::update(Parts parts) {
  if (parts.has(Part::Scene)) is_suspended_ = false;
  if (parts.has_any(Part::Scene | Part::Estimates | Part::Shown)) {
    panels_.annotation->setSources(session_.shown() != nullptr,
                                   session_.scene() && session_.scene()->truth->has_disparity());
    if (field() != carried_by_) carry();
  }
  if (parts.has(Part::View)) show();
}

void ScribbleController::setSuspended(bool is_suspended) {
  is_suspended_ = is_suspended;
  show();
}

QImage ScribbleController::picture(const PixelRect& rect) const {
  const AnnotationDocument& document = *std::as_const(document_).document();
  const ViewIndex view = session_.view();
  ScribbleLayers layers{document.scribbles().view(view), {}};
  if (carried_) layers.carried = carried_->view(view);
  return scribble_picture(layers, document.labels(), rect);
}

void ScribbleController::show() {
  const AnnotationDocument* document = std::as_const(document_).document();
  if (!document || is_suspended_) {
    panels_.canvas->setScribbles({});
    return;
  }
  const ScribbleLayer& layer = document->scribbles();
  panels_.canvas->setScribbles(picture({0, 0, layer.height(), layer.width()}));
}

void ScribbleController::showRect(ViewIndex view, const PixelRect& rect) {
  if (view != session_.view() || is_suspended_) return;
  panels_.canvas->patchScribbles({rect.x0, rect.y0}, picture(rect));
}

void ScribbleController::showChange(const DocumentChange& change) {
  if (change.has_new_labels) {
    show();  // colours may be others
  } else {
    for (const auto& part : change.views) showRect(part.view, part.rect);
  }
  markViews();
  if (!change.views.empty()) carry();
}

void ScribbleController::markViews() {
  const AnnotationDocument* document = std::as_const(document_).document();
  panels_.view_grid->setPainted(document ? document->scribbles().painted_views()
                                         : std::vector<ViewIndex>());
}

void ScribbleController::setCarried(bool is_carried) {
  is_carried_ = is_carried;
  panels_.annotation->setCarried(is_carried);
  if (!is_carried) {
    dropCarried();
    show();
  } else if (session_.scene() && !field()) {
    emit hint(tr("No disparity is known to carry scribbles by: run a method in the Estimate tab."));
  }
  carry();
  emit carriedChanged();
}

std::shared_ptr<const DisparityField> ScribbleController::field() const {
  const auto& scene = session_.scene();
  if (!scene) return nullptr;
  const EstimateEntry* shown = session_.shown();
  if (shown && panels_.annotation->carriedBy() == AnnotationBar::CarriedBy::Estimate) {
    return {shown->estimate, &shown->estimate->field};
  }
  return scene->truth->has_disparity()
             ? std::shared_ptr<const DisparityField>(scene->truth, &scene->truth->field)
             : nullptr;
}

void ScribbleController::dropCarried() {
  carry_job_.drop();
  is_carrying_ = false;
  carried_by_ = nullptr;
  panels_.annotation->setCarryState({});
  if (std::exchange(carried_, nullptr)) emit carriedChanged();
}

void ScribbleController::carry() {
  const AnnotationDocument* document = std::as_const(document_).document();
  const auto by = field();
  if (!is_carried_ || !document || !by) {
    dropCarried();
    return;
  }
  using Layer = std::shared_ptr<const ScribbleLayer>;
  is_carrying_ = true;
  carried_by_ = by;
  panels_.annotation->setCarryState(tr("carrying …"));
  carry_job_.start<Layer>(
      [painted = std::make_shared<const ScribbleLayer>(document->scribbles()),
       by](const Progress& progress) -> Layer {
        return std::make_shared<const ScribbleLayer>(propagate(*painted, *by, {}, progress));
      },
      [this](const Layer& carried) {
        is_carrying_ = false;
        carried_ = carried;
        panels_.annotation->setCarryState({});
        show();
        emit carriedChanged();
      });
}

}  // namespace episcope
