// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/browse/browse_controller.h"

#include "app/gui/browse/disparity_at.h"
#include "app/gui/browse/thumbnails.h"
#include "app/gui/document/document_controller.h"
#include "app/gui/frame/cancels.h"
#include "app/gui/frame/commands.h"
#include "app/gui/frame/frame.h"
#include "app/gui/frame/messages.h"
#include "app/gui/stage/overlay.h"
#include "app/gui/stage/stage.h"
#include "engine/core/light_field/epi.h"
#include "engine/render/shade.h"
#include "widgets/browse/epi_pane.h"
#include "widgets/browse/view_grid.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/compare/overlay_bar.h"
#include "widgets/style/picture.h"
#include "widgets/style/theme.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace episcope {
namespace {

constexpr double kUnknownReach = 20;  // px per view, of the focus slider

}  // namespace

BrowseController::BrowseController(const Workbench& bench)
    : QObject(&bench.owner),
      bench_(bench),
      session_(bench.session),
      stage_(bench.stage),
      grid_(new ViewGrid(&bench.frame)),
      epi_job_(this),
      refocus_job_(this),
      thumbnail_job_(this) {
  grid_->setContentsMargins(theme::kSpacing, theme::kSpacing, theme::kSpacing, 0);
  bench.frame.addToColumn(grid_, false);
  connectCanvas();
  connectEpis();
  addCommands();
  bench.commands.addBarWidget(BarSection::Look, stage_.overlayBar());
  bench.cancels.add(CancelRank::Browsing, [this] { return endWhatIsInHand(); });
  connect(grid_, &ViewGrid::viewSelected, this, [this](ViewIndex view) {
    if (!stage_.isPreviewing()) session_.set_view(view);
  });
  connect(stage_.overlayBar(), &OverlayBar::focusChanged, this,
          [this](double focus_px) { session_.set_focus(focus_px); });
  connect(&stage_, &Stage::previewChanged, this, &BrowseController::setPreviewing);
  connect(&bench.overlay, &Overlay::drawn, this, &BrowseController::showSlopes);  // of A or B
  connect(&bench.document, &DocumentController::replaced, this, &BrowseController::markPainted);
  connect(&bench.document, &DocumentController::changed, this, &BrowseController::markPainted);
  session_.on_changed([this](Parts parts) { update(parts); });
}

void BrowseController::connectCanvas() {
  ViewCanvas* canvas = stage_.canvas();
  connect(canvas, &ViewCanvas::crossHairRequested, this, [this](PixelIndex pixel) {
    if (!stage_.isPreviewing()) session_.set_cross_hair(pixel);
  });
  connect(canvas, &ViewCanvas::focusRequested, this, &BrowseController::focusAt);
  connect(canvas, &ViewCanvas::centerRequested, this, &BrowseController::goToCenter);
  connect(canvas, &ViewCanvas::parallaxStarted, this,
          [this] { parallax_start_ = session_.view(); });
  connect(canvas, &ViewCanvas::parallaxDragged, this, [this](QPointF views) {
    if (stage_.isPreviewing()) return;
    session_.set_view({parallax_start_.v + static_cast<int>(std::lround(views.y())),
                       parallax_start_.u + static_cast<int>(std::lround(views.x()))});
  });
  connect(canvas, &ViewCanvas::focusStepped, this, &BrowseController::stepFocus);
  // The canvas hears Space itself, which also pans.
  connect(canvas, &ViewCanvas::spaceTapped, this,
          [this] { bench_.commands.trigger(bench_.commands.userOf(Qt::Key_Space)); });
}

void BrowseController::connectEpis() {
  for (EpiPane* pane : {stage_.horizontalEpi(), stage_.verticalEpi()}) {
    connect(stage_.canvas(), &ViewCanvas::transformChanged, pane, &EpiPane::setCanvasTransform);
    connect(pane, &EpiPane::transformChanged, stage_.canvas(), &ViewCanvas::setCanvasTransform);
  }
  connect(stage_.horizontalEpi(), &EpiPane::positionClicked, this, [this](int x, int u) {
    session_.set_cross_hair({session_.cross_hair().y, x});
    session_.set_view({session_.view().v, u});
  });
  connect(stage_.verticalEpi(), &EpiPane::positionClicked, this, [this](int y, int v) {
    session_.set_cross_hair({y, session_.cross_hair().x});
    session_.set_view({v, session_.view().u});
  });
}

void BrowseController::setPreviewing(bool is_previewing) {
  grid_->setPlaying(false);
  grid_->setOpening(is_previewing);
  refocus_job_.drop();
  if (is_previewing) return;
  showView();
  showEpis();
}

void BrowseController::update(Parts parts) {
  if (parts.has(Part::Tone)) tone_ = render::table_of(session_.place().tone);
  if (parts.has(Part::Scene)) {
    showScene();
  } else if (parts.has(Part::Tone) && session_.scene()) {
    startThumbnails();
  }
  if (parts.has(Part::Focus)) stage_.overlayBar()->setFocus(session_.focus_px());
  if (stage_.isPreviewing()) return;
  if (parts.has(Part::View)) grid_->setCurrent(session_.view());
  const Parts of_view = Part::Scene | Part::View | Part::Focus | Part::Tone;
  if (parts.has_any(of_view)) showView();
  if (parts.has_any(of_view | Part::CrossHair)) showEpis();
  if (parts.has(Part::Estimates)) showFocusReach();
  if (parts.has_any(Part::Shown | Part::Estimates | Part::Live)) showSlopes();
}

void BrowseController::showScene() {
  const LightFieldPtr light_field = session_.light_field();
  grid_->setGrid(light_field ? light_field->grid() : GridShape{});
  markPainted();
  refocus_job_.drop();
  if (!light_field) {
    thumbnail_job_.drop();
    stage_.canvas()->setOverlay({});
    stage_.canvas()->setCaption({});
    stage_.canvas()->setCrossHair(std::nullopt);
    stage_.canvas()->showEmpty();
    return;
  }
  showFocusReach();
  startThumbnails();
  stage_.canvas()->zoomToFit();
}

void BrowseController::showFocusReach() {
  const Interval range = session_.known_range();
  const double known = std::max(std::abs(range.min), std::abs(range.max));
  const double reach = range.length() > 0
                           ? std::ceil(std::clamp(known, 1.0, OverlayBar::kFarthestFocus))
                           : kUnknownReach;
  stage_.overlayBar()->setFocusRange({-reach, reach});
}

void BrowseController::markPainted() {
  const AnnotationDocument* document = std::as_const(bench_.document).document();
  grid_->setPainted(document ? document->scribbles().painted_views() : std::vector<ViewIndex>());
}

void BrowseController::startThumbnails() {
  using Pictures = std::vector<Image<std::uint8_t>>;
  const QSize size = grid_->thumbnailSize();
  thumbnail_job_.start<Pictures>(
      [light_field = session_.light_field(), size, tone = tone_](const Progress& progress) {
        return make_thumbnails(*light_field, size.width(), size.height(), tone.get(), progress);
      },
      [this, grid = session_.light_field()->grid()](Pictures pictures) {
        for (int i = 0; i < grid.count(); ++i) {
          grid_->setThumbnail(grid.view_at(i), to_qimage(std::move(pictures[i])));
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
    showPicture(to_qimage(render::shade_view(*light_field, view, tone_.get())));
    return;
  }
  using Picture = Image<std::uint8_t>;
  refocus_job_.start<std::shared_ptr<Picture>>(
      [light_field, view, focus_px, tone = tone_](const Progress& progress) {
        progress.check();
        return std::make_shared<Picture>(
            render::shade_samples(render::refocus(*light_field, view, focus_px), tone.get()));
      },
      [this](const std::shared_ptr<Picture>& picture) {
        if (!stage_.isPreviewing()) showPicture(to_qimage(std::move(*picture)));
      });
}

void BrowseController::showPicture(const QImage& picture) {
  stage_.canvas()->setPicture(picture);
  stage_.canvas()->setCrossHair(session_.cross_hair());
}

void BrowseController::showEpis() {
  const LightFieldPtr light_field = session_.light_field();
  if (!light_field) {
    epi_job_.drop();
    stage_.horizontalEpi()->setEpi({});
    stage_.verticalEpi()->setEpi({});
    stage_.horizontalEpi()->setCrossHair(std::nullopt, 0);
    stage_.verticalEpi()->setCrossHair(std::nullopt, 0);
    return;
  }
  const ViewIndex view = session_.view();
  const PixelIndex pixel = session_.cross_hair();
  const double focus_px = session_.focus_px();
  stage_.canvas()->setCrossHair(pixel);
  clearLinesOfOtherRows();
  stage_.horizontalEpi()->setFocus(focus_px);
  stage_.verticalEpi()->setFocus(focus_px);
  const auto find = [light_field, view, pixel, focus_px, tone = tone_] {
    return EpiPictures{
        render::shade_samples(horizontal_epi(*light_field, view, pixel.y, focus_px), tone.get()),
        render::shade_samples(vertical_epi(*light_field, view, pixel.x, focus_px), tone.get())};
  };
  epi_job_.drop();
  if (!light_field->is_on_disk()) return showEpis(find(), view, pixel);
  // The disk may take its time, in which others are looked at.
  epi_job_.start<std::shared_ptr<EpiPictures>>(
      [find](const Progress& progress) {
        progress.check();
        return std::make_shared<EpiPictures>(find());
      },
      [this, view, pixel](const std::shared_ptr<EpiPictures>& epis) {
        showEpis(std::move(*epis), view, pixel);
      });
}

void BrowseController::showEpis(EpiPictures epis, ViewIndex view, PixelIndex pixel) {
  stage_.horizontalEpi()->setEpi(to_qimage(std::move(epis.horizontal)));
  stage_.verticalEpi()->setEpi(to_qimage(std::move(epis.vertical)));
  stage_.horizontalEpi()->setCrossHair(pixel.x, view.u);
  stage_.verticalEpi()->setCrossHair(pixel.y, view.v);
  showSlopes();
}

// A line drawn in an EPI belongs to what was seen there.
void BrowseController::clearLinesOfOtherRows() {
  const ViewIndex view = session_.view();
  const PixelIndex pixel = session_.cross_hair();
  const std::pair horizontal(view.v, pixel.y);
  const std::pair vertical(view.u, pixel.x);
  if (std::exchange(horizontal_row_, horizontal) != horizontal) {
    stage_.horizontalEpi()->clearMeasurement();
  }
  if (std::exchange(vertical_row_, vertical) != vertical) stage_.verticalEpi()->clearMeasurement();
}

void BrowseController::showSlopes() {
  DisparityPair estimate;
  DisparityPair truth;
  if (session_.scene()) {
    truth = disparities_at(*session_.scene()->truth, session_.view(), session_.cross_hair());
    const bool is_flipped = bench_.overlay.isFlipped();
    if (const auto* shown = is_flipped ? session_.side_b() : session_.side_a()) {
      estimate = disparities_at(*shown->estimate, session_.view(), session_.cross_hair());
    }
  }
  for (EpiPane* pane : {stage_.horizontalEpi(), stage_.verticalEpi()}) {
    pane->setSlopes(estimate.front, truth.front);
    pane->setBackgroundSlopes(estimate.behind, truth.behind);
  }
}

void BrowseController::focusAt(PixelIndex pixel) {
  if (!session_.scene() || stage_.isPreviewing()) return;
  std::optional<double> disparity;
  if (const EstimateEntry* shown = session_.side_a()) {
    disparity = disparity_at(shown->estimate->field, session_.view(), pixel);
  }
  if (!disparity) {
    disparity = disparity_at(session_.scene()->truth->field, session_.view(), pixel);
  }
  if (disparity) {
    session_.set_focus(*disparity);
  } else {
    bench_.messages.hint(
        tr("The disparity of this pixel is not known: run a method first, or move the slider."));
  }
}

void BrowseController::step(int dv, int du) {
  if (!stage_.isPreviewing()) {
    session_.set_view({session_.view().v + dv, session_.view().u + du});
  }
}

void BrowseController::jump(int dv, int du) {
  const GridShape grid = grid_->grid();
  step(dv * grid.v, du * grid.u);
}

void BrowseController::goToCenter() {
  if (session_.scene() && !stage_.isPreviewing())
    session_.set_view(session_.light_field()->center());
}

void BrowseController::togglePlay() {
  grid_->setPlaying(!grid_->isPlaying());
}

void BrowseController::stepFocus(double steps) {
  stage_.overlayBar()->stepFocus(steps);
}

void BrowseController::resetFocus() {
  session_.set_focus(0);
}

void BrowseController::setRefocusing(bool refocuses) {
  refocuses_ = refocuses;
  if (!stage_.isPreviewing()) showView();
}

bool BrowseController::endWhatIsInHand() {
  if (grid_->isPlaying()) {
    grid_->setPlaying(false);
    return true;
  }
  const bool had_line =
      stage_.horizontalEpi()->measuredDisparity() || stage_.verticalEpi()->measuredDisparity();
  stage_.horizontalEpi()->clearMeasurement();
  stage_.verticalEpi()->clearMeasurement();
  return had_line;
}

}  // namespace episcope

#include "moc_browse_controller.cpp"
