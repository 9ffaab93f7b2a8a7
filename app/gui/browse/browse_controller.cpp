// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/features.h"

#include "app/gui/browse/value_controller.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/overlay.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/session.h"
#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/disparity/disparity_range.h"
#include "engine/render/shade.h"
#include "widgets/canvas/epi_pane.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/picture.h"
#include "widgets/controls/theme.h"
#include "widgets/panels/overlay_bar.h"
#include "widgets/panels/view_grid.h"

#include <QAction>
#include <QImage>
#include <QKeySequence>
#include <QList>
#include <QMenu>
#include <QObject>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace episcope {
namespace {

constexpr int kRgba = 4;

// Mean of the pixels of `source` that fall into each pixel of the result.
Image<std::uint8_t> shrink(const Image<std::uint8_t>& source, int factor) {
  const int height = std::max(1, source.height() / factor);
  const int width = std::max(1, source.width() / factor);
  Image<std::uint8_t> result(height, width, kRgba);
  const int rows = std::min(factor, source.height());
  const int columns = std::min(factor, source.width());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int sums[kRgba] = {};
      for (int dy = 0; dy < rows; ++dy) {
        const std::uint8_t* pixel = &source.at(y * rows + dy, x * columns);
        for (int i = 0; i < columns * kRgba; ++i) sums[i % kRgba] += pixel[i];
      }
      for (int c = 0; c < kRgba; ++c) {
        result.at(y, x, c) = static_cast<std::uint8_t>(sums[c] / (rows * columns));
      }
    }
  }
  return result;
}

// Small RGBA8 pictures of all views, row by row of the grid, each at most `width` by `height`
// pixels and of the same aspect as the views: box means; brightened if a tone is given. Throws
// Cancelled.
std::vector<Image<std::uint8_t>> make_thumbnails(const LightField& light_field, int width,
                                                 int height, const render::ToneTable* tone,
                                                 const Progress& progress) {
  const auto times_larger = [](int full, int small) {
    return (full + small - 1) / std::max(1, small);
  };
  const int factor = std::max(
      {1, times_larger(light_field.width(), width), times_larger(light_field.height(), height)});
  std::vector<Image<std::uint8_t>> pictures;
  const GridShape grid = light_field.grid();
  for (int v = 0; v < grid.v; ++v) {
    for (int u = 0; u < grid.u; ++u) {
      progress.check();
      pictures.push_back(shrink(render::shade_view(light_field, {v, u}, tone), factor));
    }
  }
  return pictures;
}

constexpr double kUnknownReach = 20;  // px per view, of the focus slider

}  // namespace

/// Walks through the views: current view, cross-hair, EPIs, focus plane, view grid, player,
/// parallax.
class BrowseController : public QObject {
  Q_OBJECT

 public:
  explicit BrowseController(const Workbench& bench)
      : QObject(&bench.owner),
        bench_(bench),
        session_(bench.session),
        viewer_area_(bench.viewer_area),
        grid_(new ViewGrid(&bench.frame)),
        epi_job_(this),
        refocus_job_(this),
        thumbnail_job_(this),
        match_job_(this) {
    grid_->setContentsMargins(theme::kSpacing, theme::kSpacing, theme::kSpacing, 0);
    bench.frame.addToColumn(grid_, false);
    connectCanvas();
    connectEpis();
    addCommands();
    bench.commands.addBarWidget(BarSection::Look, viewer_area_.overlayBar());
    bench.cancels.add(CancelRank::Browsing, [this] { return endWhatIsInHand(); });
    connect(grid_, &ViewGrid::viewSelected, this, [this](ViewIndex view) {
      if (!viewer_area_.isPreviewing()) session_.set_view(view);
    });
    connect(viewer_area_.overlayBar(), &OverlayBar::focusChanged, this,
            [this](double focus_px) { session_.set_focus(focus_px); });
    connect(&viewer_area_, &ViewerArea::previewChanged, this, &BrowseController::setPreviewing);
    connect(&bench.overlay, &Overlay::drawn, this, &BrowseController::showSlopes);  // of A or B
    connect(&viewer_area_, &ViewerArea::previewChanged, this, &BrowseController::showSlopes);
    connect(&bench.document, &DocumentController::replaced, this, &BrowseController::markPainted);
    connect(&bench.document, &DocumentController::changed, this, &BrowseController::markPainted);
    session_.on_changed([this](Parts parts) { update(parts); });
  }

  void step(int dv, int du) {
    if (!viewer_area_.isPreviewing()) {
      session_.set_view({session_.view().v + dv, session_.view().u + du});
    }
  }

  void jump(int dv, int du) {
    const GridShape grid = grid_->grid();
    step(dv * grid.v, du * grid.u);
  }

  void goToCenter() {
    if (session_.scene() && !viewer_area_.isPreviewing())
      session_.set_view(session_.light_field()->center());
  }

  void stepFocus(double steps) { viewer_area_.overlayBar()->stepFocus(steps); }

  /// Refocuses the view at the focus plane, or only shears the EPIs.
  void setRefocusing(bool refocuses) {
    refocuses_ = refocuses;
    if (!viewer_area_.isPreviewing()) showView();
  }

  /// Stops playing, or removes the line drawn in an EPI; false if there was neither.
  bool endWhatIsInHand() {
    if (grid_->isPlaying()) {
      grid_->setPlaying(false);
      return true;
    }
    const bool had_line = viewer_area_.horizontalEpi()->measuredDisparity() ||
                          viewer_area_.verticalEpi()->measuredDisparity();
    viewer_area_.horizontalEpi()->clearMeasurement();
    viewer_area_.verticalEpi()->clearMeasurement();
    return had_line;
  }

 private:
  void addCommands() {
    addWalkCommands();
    addZoomCommands();
    addFocusCommands();
  }

  void addWalkCommands() {
    addStep("left", tr("View to the left"), tr("Shows the view to the left"), 0, -1, Qt::Key_Left);
    addStep("right", tr("View to the right"), tr("Shows the view to the right"), 0, 1,
            Qt::Key_Right);
    addStep("up", tr("View above"), tr("Shows the view above"), -1, 0, Qt::Key_Up);
    addStep("down", tr("View below"), tr("Shows the view below"), 1, 0, Qt::Key_Down);
    bench_.commands.add({.id = "view.center",
                         .menu = Menu::Views,
                         .text = tr("Center view"),
                         .tip = tr("Shows the view in the middle of the grid"),
                         .keys = {Qt::Key_Home},
                         .run = [this] { goToCenter(); },
                         .section = section::kWalk});
    QAction* play =
        bench_.commands.add({.id = "view.play",
                             .menu = Menu::Views,
                             .text = tr("Play"),
                             .tip = tr("Plays the views one after the other, or pauses"),
                             .icon = "play",
                             .keys = {Qt::Key_Space},
                             .run = [this] { grid_->setPlaying(!grid_->isPlaying()); },
                             .section = section::kWalk,
                             .scope = KeyScope::Viewer});
    grid_->followTip(play);
  }

  void addStep(const QString& id, const QString& text, const QString& tip, int dv, int du,
               Qt::Key key) {
    bench_.commands.add({.menu = Menu::Views, .section = section::kWalk},
                        {{.id = "view." + id,
                          .text = text,
                          .tip = tip,
                          .keys = {QKeySequence(key)},
                          .run = [this, dv, du] { step(dv, du); }},
                         {.id = "view." + id + "_most",
                          .text = tr("%1, to the end").arg(text),
                          .tip = tr("%1, at the end of the grid").arg(tip),
                          .keys = {QKeySequence(Qt::ShiftModifier | key)},
                          .run = [this, dv, du] { jump(dv, du); }}});
  }

  void addZoomCommands() {
    addZoom("zoom_in", tr("Zoom in"), tr("Enlarges the picture"), {},
            {Qt::Key_Plus, Qt::Key_Equal, tr("Ctrl++")}, &ViewCanvas::zoomIn);
    addZoom("zoom_out", tr("Zoom out"), tr("Shrinks the picture"), {},
            {Qt::Key_Minus, tr("Ctrl+-")}, &ViewCanvas::zoomOut);
    addZoom("fit", tr("Fit"), tr("Fits the whole picture into its pane"), "fit", {Qt::Key_K},
            &ViewCanvas::zoomToFit);
    addZoom("actual_size", tr("100 %"), tr("Shows each image pixel as one screen pixel"), {},
            {tr("Ctrl+0")}, &ViewCanvas::zoomToActualSize);
  }

  void addZoom(const QString& id, const QString& text, const QString& tip, const QString& icon,
               const QList<QKeySequence>& keys, void (ViewCanvas::*zoom)()) {
    bench_.commands.add({.id = "view." + id,
                         .menu = Menu::View,
                         .text = text,
                         .tip = tip,
                         .icon = icon,
                         .keys = keys,
                         .run = [this, zoom] { (viewer_area_.activeCanvas()->*zoom)(); },
                         .section = section::kZoom});
  }

  void addFocusCommands() {
    const auto add = [this](const QString& id, const QString& text, const QString& tip,
                            const QKeySequence& key, std::function<void()> run) {
      bench_.commands.add({.id = id,
                           .menu = Menu::View,
                           .text = text,
                           .tip = tip,
                           .keys = {key},
                           .run = std::move(run),
                           .section = section::kFocus});
    };
    add("view.focus_nearer", tr("Focus nearer"), tr("Moves the focus plane to larger disparities"),
        tr("Ctrl+Alt+Up"), [this] { stepFocus(1); });
    add("view.focus_farther", tr("Focus farther"),
        tr("Moves the focus plane to smaller disparities"), tr("Ctrl+Alt+Down"),
        [this] { stepFocus(-1); });
    add("view.focus_reset", tr("Focus at zero"), tr("Moves the focus plane back to zero disparity"),
        tr("Ctrl+Alt+0"), [this] { session_.set_focus(0); });
    bench_.commands.add({.id = "view.refocus",
                         .menu = Menu::View,
                         .text = tr("Refocus the view"),
                         .tip = tr("Refocuses the view too, as the mean of all views at the focus "
                                   "plane; otherwise only the EPIs are sheared"),
                         .run = [this] { setRefocusing(!refocuses_); },
                         .section = section::kFocus,
                         .checked = [this] { return refocuses_; }});
  }

  void connectCanvas() {
    ViewCanvas* canvas = viewer_area_.canvas();
    connect(canvas, &ViewCanvas::crossHairRequested, this, [this](PixelIndex pixel) {
      if (!viewer_area_.isPreviewing()) session_.set_cross_hair(pixel);
    });
    connect(canvas, &ViewCanvas::focusRequested, this, &BrowseController::focusAt);
    connect(canvas, &ViewCanvas::centerRequested, this, &BrowseController::goToCenter);
    connect(canvas, &ViewCanvas::menuRequested, this, &BrowseController::showMenu);
    connect(canvas, &ViewCanvas::parallaxStarted, this,
            [this] { parallax_start_ = session_.view(); });
    connect(canvas, &ViewCanvas::parallaxDragged, this, [this](QPointF views) {
      if (viewer_area_.isPreviewing()) return;
      session_.set_view({parallax_start_.v + static_cast<int>(std::lround(views.y())),
                         parallax_start_.u + static_cast<int>(std::lround(views.x()))});
    });
    connect(canvas, &ViewCanvas::focusStepped, this, &BrowseController::stepFocus);
    // The canvas hears Space itself, which also pans.
    connect(canvas, &ViewCanvas::spaceTapped, this,
            [this] { bench_.commands.trigger(bench_.commands.userOf(Qt::Key_Space)); });
  }

  void showMenu(PixelIndex pixel, QPoint place) {
    if (viewer_area_.isPreviewing()) return;
    auto* menu = named("view.menu", new QMenu(&bench_.window));
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->addAction(tr("Focus here"), this, [this, pixel] { focusAt(pixel); })
        ->setObjectName("view.menu.focus");
    menu->addAction(tr("Measure here"), this, [this, pixel] { measureAt(pixel); })
        ->setObjectName("view.menu.measure");
    menu->addAction(bench_.commands.find("view.center"));
    menu->addSeparator();
    const auto add_as = [this, menu](const QString& text, const char* id) {
      const QAction* known = bench_.commands.find(id);
      QAction* action =
          menu->addAction(known->icon(), text, this, [this, id] { bench_.commands.trigger(id); });
      action->setObjectName(id);
      action->setShortcut(known->shortcut());
      action->setEnabled(known->isEnabled());
    };
    add_as(tr("Save picture…"), "file.save_picture");
    add_as(tr("Save map…"), "file.save_map");
    menu->addSeparator();
    menu->addAction(bench_.commands.find("view.tone"));
    menu->addAction(bench_.commands.find("view.auto_tone"));
    menu->popup(place);
  }

  // The lines of a pixel are those of the EPIs through it.
  void measureAt(PixelIndex pixel) {
    session_.set_cross_hair(pixel);
    bench_.frame.showTab("measure");
    const QString key = bench_.commands.keyText("measure.keep");
    bench_.messages.hint(
        key.isEmpty()
            ? tr("Drag along a line of an EPI to measure its disparity.")
            : tr("Drag along a line of an EPI to measure its disparity; %1 keeps it.").arg(key));
  }

  void connectEpis() {
    for (EpiPane* pane : {viewer_area_.horizontalEpi(), viewer_area_.verticalEpi()}) {
      connect(viewer_area_.canvas(), &ViewCanvas::transformChanged, pane,
              &EpiPane::setCanvasTransform);
      connect(pane, &EpiPane::transformChanged, viewer_area_.canvas(),
              &ViewCanvas::setCanvasTransform);
    }
    connect(viewer_area_.horizontalEpi(), &EpiPane::positionClicked, this, [this](int x, int u) {
      session_.set_cross_hair({session_.cross_hair().y, x});
      session_.set_view({session_.view().v, u});
    });
    connect(viewer_area_.horizontalEpi(), &EpiPane::menuRequested, this,
            [this](int x, QPoint place) {
              showMenu({session_.cross_hair().y, x}, place);
            });
    connect(viewer_area_.verticalEpi(), &EpiPane::menuRequested, this, [this](int y, QPoint place) {
      showMenu({y, session_.cross_hair().x}, place);
    });
    connect(viewer_area_.verticalEpi(), &EpiPane::positionClicked, this, [this](int y, int v) {
      session_.set_cross_hair({y, session_.cross_hair().x});
      session_.set_view({v, session_.view().u});
    });
  }

  void update(Parts parts) {
    if (parts.has(Part::Tone)) tone_ = render::table_of(session_.place().tone);
    if (parts.has(Part::Scene)) {
      showScene();
    } else if (parts.has(Part::Tone) && session_.scene()) {
      startThumbnails();
    }
    if (parts.has(Part::Focus)) viewer_area_.overlayBar()->setFocus(session_.focus_px());
    if (viewer_area_.isPreviewing()) return;
    if (parts.has(Part::View)) grid_->setCurrent(session_.view());
    const Parts of_view = Part::Scene | Part::View | Part::Focus | Part::Tone;
    if (parts.has_any(of_view)) showView();
    if (parts.has_any(of_view | Part::CrossHair)) showEpis();
    if (parts.has_any(Part::Estimates | Part::FoundRange)) showFocusReach();
    if (parts.has_any(Part::Shown | Part::Estimates | Part::Live)) showSlopes();
  }

  void setPreviewing(bool is_previewing) {
    grid_->setPlaying(false);
    grid_->setOpening(is_previewing);
    refocus_job_.drop();
    if (is_previewing) return;
    showView();
    showEpis();
  }

  void showScene() {
    const LightFieldPtr light_field = session_.light_field();
    grid_->setGrid(light_field ? light_field->grid() : GridShape{});
    markPainted();
    refocus_job_.drop();
    match_job_.drop();
    if (!light_field) {
      thumbnail_job_.drop();
      viewer_area_.canvas()->setOverlay({});
      viewer_area_.canvas()->setCaption({});
      viewer_area_.canvas()->setCrossHair(std::nullopt);
      viewer_area_.canvas()->showEmpty();
      return;
    }
    showFocusReach();
    startThumbnails();
    viewer_area_.canvas()->zoomToFit();
  }

  void showFocusReach() {
    const Interval known_range = session_.known_range();
    const Interval range = known_range.length() > 0 ? known_range : session_.found_range();
    const double known = std::max(std::abs(range.min), std::abs(range.max));
    const double reach = range.length() > 0
                             ? std::ceil(std::clamp(known, 1.0, OverlayBar::kFarthestFocus))
                             : kUnknownReach;
    viewer_area_.overlayBar()->setFocusRange({-reach, reach});
  }

  void showView() {
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
          if (!viewer_area_.isPreviewing()) showPicture(to_qimage(std::move(*picture)));
        });
  }

  void showPicture(const QImage& picture) {
    viewer_area_.canvas()->setPicture(picture);
    viewer_area_.canvas()->setCrossHair(session_.cross_hair());
  }

  // Both EPIs through the cross-hair, drawn.
  struct EpiPictures {
    Image<std::uint8_t> horizontal, vertical;
  };
  void showEpis() {
    const LightFieldPtr light_field = session_.light_field();
    if (!light_field) {
      epi_job_.drop();
      viewer_area_.horizontalEpi()->setEpi({});
      viewer_area_.verticalEpi()->setEpi({});
      viewer_area_.horizontalEpi()->setCrossHair(std::nullopt, 0);
      viewer_area_.verticalEpi()->setCrossHair(std::nullopt, 0);
      return;
    }
    const ViewIndex view = session_.view();
    const PixelIndex pixel = session_.cross_hair();
    const double focus_px = session_.focus_px();
    viewer_area_.canvas()->setCrossHair(pixel);
    clearLinesOfOtherRows();
    viewer_area_.horizontalEpi()->setFocus(focus_px);
    viewer_area_.verticalEpi()->setFocus(focus_px);
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

  void showEpis(EpiPictures epis, ViewIndex view, PixelIndex pixel) {
    viewer_area_.horizontalEpi()->setEpi(to_qimage(std::move(epis.horizontal)));
    viewer_area_.verticalEpi()->setEpi(to_qimage(std::move(epis.vertical)));
    viewer_area_.horizontalEpi()->setCrossHair(pixel.x, view.u);
    viewer_area_.verticalEpi()->setCrossHair(pixel.y, view.v);
    showSlopes();
  }

  // A line drawn in an EPI belongs to what was seen there.
  void clearLinesOfOtherRows() {
    const ViewIndex view = session_.view();
    const PixelIndex pixel = session_.cross_hair();
    const std::pair horizontal(view.v, pixel.y);
    const std::pair vertical(view.u, pixel.x);
    if (std::exchange(horizontal_row_, horizontal) != horizontal) {
      viewer_area_.horizontalEpi()->clearMeasurement();
    }
    if (std::exchange(vertical_row_, vertical) != vertical)
      viewer_area_.verticalEpi()->clearMeasurement();
  }

  void showSlopes() {
    DisparityPair estimate;
    DisparityPair truth;
    if (session_.scene() && !viewer_area_.isPreviewing()) {
      truth = disparities_at(*session_.scene()->truth, session_.view(), session_.cross_hair());
      const bool is_flipped = bench_.overlay.isFlipped();
      if (const auto* shown = is_flipped ? session_.side_b() : session_.side_a()) {
        estimate = disparities_at(*shown->estimate, session_.view(), session_.cross_hair());
      }
    }
    for (EpiPane* pane : {viewer_area_.horizontalEpi(), viewer_area_.verticalEpi()}) {
      pane->setSlopes(estimate.front, truth.front);
      pane->setBackgroundSlopes(estimate.behind, truth.behind);
    }
  }

  void startThumbnails() {
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

  void markPainted() {
    const AnnotationDocument* document = bench_.document.document();
    grid_->setPainted(document ? document->scribbles().painted_views() : std::vector<ViewIndex>());
  }

  void focusAt(PixelIndex pixel) {
    if (!session_.scene() || viewer_area_.isPreviewing()) return;
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
      matchAt(pixel);
    }
  }

  /// Focuses at a pixel whose disparity nothing tells.
  void matchAt(PixelIndex pixel) {
    const LightFieldPtr light_field = session_.light_field();
    if (light_field->grid().count() < 2) return;
    match_job_.start<std::optional<double>>(
        [light_field, view = session_.view(), pixel,
         known = session_.known_range()](const Progress& progress) {
          const Interval range =
              known.length() > 0 ? known : search_range(*light_field, IntervalOrAuto(), progress);
          return matched_disparity(*light_field, view, pixel, range, progress);
        },
        [this](std::optional<double> disparity) {
          if (disparity) return session_.set_focus(*disparity);
          bench_.messages.hint(tr(
              "The disparity of this pixel cannot be found by itself: run a method first, or move "
              "the slider."));
        });
  }

  Workbench bench_;
  Session& session_;
  ViewerArea& viewer_area_;
  ViewGrid* grid_;
  bool refocuses_ = true;
  ViewIndex parallax_start_;
  std::pair<int, int> horizontal_row_{-1, -1};     // v and y of the EPI that is shown
  std::pair<int, int> vertical_row_{-1, -1};       // u and x
  std::shared_ptr<const render::ToneTable> tone_;  // null = samples as they are
  LatestJob epi_job_;                              // of light fields on disk
  LatestJob refocus_job_;
  LatestJob thumbnail_job_;
  LatestJob match_job_;
};

void add_views(const Workbench& bench) {
  new BrowseController(bench);
}

}  // namespace episcope

#include "browse_controller.moc"
