// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/browse/browse_controller.h"

#include "app/gui/browse/disparity_at.h"
#include "app/gui/browse/thumbnails.h"
#include "engine/core/light_field/epi.h"
#include "engine/render/shade.h"
#include "widgets/browse/epi_pane.h"
#include "widgets/browse/view_grid.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/compare/overlay_bar.h"
#include "widgets/style/number_text.h"
#include "widgets/style/picture.h"

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

// Truth may hold marks for "nothing" that are no disparity.
constexpr double kFarthestFocus = 100;

}  // namespace

BrowseController::BrowseController(Session& session, const Panels& panels, QObject* parent)
    : QObject(parent),
      session_(session),
      panels_(panels),
      refocus_job_(this),
      thumbnail_job_(this) {
  connectCanvas();
  connectEpis();
  connect(panels_.view_grid, &ViewGrid::viewSelected, this, [this](ViewIndex view) {
    if (!is_previewing_) session_.set_view(view);
  });
  connect(panels_.overlay_bar, &OverlayBar::focusChanged, this,
          [this](double focus_px) { session_.set_focus(focus_px); });
  session_.on_changed([this](Parts parts) { update(parts); });
}

void BrowseController::connectCanvas() {
  ViewCanvas* canvas = panels_.canvas;
  connect(canvas, &ViewCanvas::crossHairRequested, this, [this](PixelIndex pixel) {
    if (!is_previewing_) session_.set_cross_hair(pixel);
  });
  connect(canvas, &ViewCanvas::focusRequested, this, &BrowseController::focusAt);
  connect(canvas, &ViewCanvas::centerRequested, this, &BrowseController::goToCenter);
  connect(canvas, &ViewCanvas::parallaxStarted, this,
          [this] { parallax_start_ = session_.view(); });
  connect(canvas, &ViewCanvas::parallaxDragged, this, [this](QPointF views) {
    if (is_previewing_) return;
    session_.set_view({parallax_start_.v + static_cast<int>(std::lround(views.y())),
                       parallax_start_.u + static_cast<int>(std::lround(views.x()))});
  });
  connect(canvas, &ViewCanvas::focusStepped, this, &BrowseController::stepFocus);
}

void BrowseController::connectEpis() {
  for (EpiPane* pane : {panels_.horizontal_epi, panels_.vertical_epi}) {
    connect(panels_.canvas, &ViewCanvas::transformChanged, pane, &EpiPane::setCanvasTransform);
    connect(pane, &EpiPane::transformChanged, panels_.canvas, &ViewCanvas::setCanvasTransform);
    connect(pane, &EpiPane::disparityMeasured, this, [this](double disparity_px) {
      emit hint(tr("Measured disparity: %1 px per view").arg(number_text(disparity_px)));
    });
  }
  connect(panels_.horizontal_epi, &EpiPane::positionClicked, this, [this](int x, int u) {
    session_.set_cross_hair({session_.cross_hair().y, x});
    session_.set_view({session_.view().v, u});
  });
  connect(panels_.vertical_epi, &EpiPane::positionClicked, this, [this](int y, int v) {
    session_.set_cross_hair({y, session_.cross_hair().x});
    session_.set_view({v, session_.view().u});
  });
}

void BrowseController::showPreview(const QImage& picture, const QString& caption) {
  is_previewing_ = true;
  panels_.view_grid->setPlaying(false);
  refocus_job_.drop();
  panels_.canvas->setOverlay({});
  panels_.canvas->setCrossHair(std::nullopt);
  panels_.horizontal_epi->setEpi({});
  panels_.vertical_epi->setEpi({});
  panels_.canvas->setPicture(picture);
  panels_.canvas->setCaption(caption);
}

void BrowseController::endPreview() {
  if (!std::exchange(is_previewing_, false)) return;
  showView();
  showEpis();
}

void BrowseController::update(Parts parts) {
  if (parts.has(Part::Scene)) {
    is_previewing_ = false;
    showScene();
  }
  if (parts.has(Part::Focus)) panels_.overlay_bar->setFocus(session_.focus_px());
  if (is_previewing_) return;
  if (parts.has(Part::View)) panels_.view_grid->setCurrent(session_.view());
  if (parts.has_any(Part::Scene | Part::View | Part::Focus)) showView();
  if (parts.has_any(Part::Scene | Part::View | Part::Focus | Part::CrossHair)) showEpis();
  if (parts.has_any(Part::Shown | Part::Estimates)) showSlopes();
}

void BrowseController::showScene() {
  const LightFieldPtr light_field = session_.light_field();
  panels_.view_grid->setGrid(light_field ? light_field->grid() : GridShape{});
  refocus_job_.drop();
  if (!light_field) {
    thumbnail_job_.drop();
    panels_.canvas->setOverlay({});
    panels_.canvas->setCaption({});
    panels_.canvas->setCrossHair(std::nullopt);
    panels_.canvas->showEmpty();
    return;
  }
  const Interval range = session_.disparity_range();
  const double reach = std::ceil(
      std::clamp(std::max(std::abs(range.min), std::abs(range.max)), 1.0, kFarthestFocus));
  panels_.overlay_bar->setFocusRange({-reach, reach});
  startThumbnails();
  panels_.canvas->zoomToFit();
}

void BrowseController::startThumbnails() {
  using Pictures = std::vector<Image<std::uint8_t>>;
  const QSize size = panels_.view_grid->thumbnailSize();
  thumbnail_job_.start<Pictures>(
      [light_field = session_.light_field(), size](const Progress& progress) {
        return make_thumbnails(*light_field, size.width(), size.height(), progress);
      },
      [this, grid = session_.light_field()->grid()](Pictures pictures) {
        for (int i = 0; i < grid.count(); ++i) {
          panels_.view_grid->setThumbnail(grid.view_at(i), to_qimage(std::move(pictures[i])));
        }
      });
}

void BrowseController::showView() {
  const LightFieldPtr light_field = session_.light_field();
  if (!light_field) return;
  const ViewIndex view = session_.view();
  const double focus_px = session_.focus_px();
  if (focus_px == 0 || !refocuses_) {
    refocus_job_.drop();
    showPicture(to_qimage(render::shade_view(*light_field, view)));
    return;
  }
  using Picture = Image<std::uint8_t>;
  refocus_job_.start<std::shared_ptr<Picture>>(
      [light_field, view, focus_px](const Progress& progress) {
        progress.check();
        return std::make_shared<Picture>(
            render::shade_samples(render::refocus(*light_field, view, focus_px)));
      },
      [this](const std::shared_ptr<Picture>& picture) {
        if (!is_previewing_) showPicture(to_qimage(std::move(*picture)));
      });
}

void BrowseController::showPicture(const QImage& picture) {
  panels_.canvas->setPicture(picture);
  panels_.canvas->setCrossHair(session_.cross_hair());
}

void BrowseController::showEpis() {
  const LightFieldPtr light_field = session_.light_field();
  if (!light_field) {
    panels_.horizontal_epi->setEpi({});
    panels_.vertical_epi->setEpi({});
    panels_.horizontal_epi->setCrossHair(std::nullopt, 0);
    panels_.vertical_epi->setCrossHair(std::nullopt, 0);
    return;
  }
  const ViewIndex view = session_.view();
  const PixelIndex pixel = session_.cross_hair();
  const double focus_px = session_.focus_px();
  panels_.canvas->setCrossHair(pixel);
  panels_.horizontal_epi->setFocus(focus_px);
  panels_.vertical_epi->setFocus(focus_px);
  panels_.horizontal_epi->setEpi(
      to_qimage(render::shade_samples(horizontal_epi(*light_field, view, pixel.y, focus_px))));
  panels_.vertical_epi->setEpi(
      to_qimage(render::shade_samples(vertical_epi(*light_field, view, pixel.x, focus_px))));
  panels_.horizontal_epi->setCrossHair(pixel.x, view.u);
  panels_.vertical_epi->setCrossHair(pixel.y, view.v);
  showSlopes();
}

void BrowseController::showSlopes() {
  DisparityPair estimate;
  DisparityPair truth;
  if (session_.scene()) {
    truth = disparities_at(*session_.scene()->truth, session_.view(), session_.cross_hair());
    if (const EstimateEntry* shown = session_.shown()) {
      estimate = disparities_at(*shown->estimate, session_.view(), session_.cross_hair());
    }
  }
  for (EpiPane* pane : {panels_.horizontal_epi, panels_.vertical_epi}) {
    pane->setSlopes(estimate.front, truth.front);
    pane->setBackgroundSlopes(estimate.behind, truth.behind);
  }
}

void BrowseController::focusAt(PixelIndex pixel) {
  if (!session_.scene() || is_previewing_) return;
  std::optional<double> disparity;
  if (const EstimateEntry* shown = session_.shown()) {
    disparity = disparity_at(shown->estimate->field, session_.view(), pixel);
  }
  if (!disparity) {
    disparity = disparity_at(session_.scene()->truth->field, session_.view(), pixel);
  }
  if (disparity) {
    session_.set_focus(*disparity);
  } else {
    emit hint(tr("No disparity is known at this pixel: run a method first, or move the slider."));
  }
}

void BrowseController::step(int dv, int du) {
  if (!is_previewing_) {
    session_.set_view({session_.view().v + dv, session_.view().u + du});
  }
}

void BrowseController::jump(int dv, int du) {
  const GridShape grid = panels_.view_grid->grid();
  step(dv * grid.v, du * grid.u);
}

void BrowseController::goToCenter() {
  if (session_.scene() && !is_previewing_) session_.set_view(session_.light_field()->center());
}

void BrowseController::togglePlay() {
  panels_.view_grid->setPlaying(!panels_.view_grid->isPlaying());
}

void BrowseController::stepFocus(double steps) {
  panels_.overlay_bar->stepFocus(steps);
}

void BrowseController::resetFocus() {
  session_.set_focus(0);
}

void BrowseController::setRefocusing(bool refocuses) {
  refocuses_ = refocuses;
  if (!is_previewing_) showView();
}

bool BrowseController::endWhatIsInHand() {
  if (panels_.view_grid->isPlaying()) {
    panels_.view_grid->setPlaying(false);
    return true;
  }
  const bool had_line =
      panels_.horizontal_epi->measuredDisparity() || panels_.vertical_epi->measuredDisparity();
  panels_.horizontal_epi->clearMeasurement();
  panels_.vertical_epi->clearMeasurement();
  return had_line;
}

}  // namespace episcope
