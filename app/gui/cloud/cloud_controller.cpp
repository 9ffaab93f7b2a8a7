// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/cloud/cloud_controller.h"

#include "app/gui/frame/frame.h"
#include "app/gui/stage/overlay.h"
#include "app/session/picture/picture.h"
#include "app/session/session.h"
#include "engine/core/light_field/shown_disparity.h"
#include "widgets/cloud/point_cloud_panel.h"
#include "widgets/style/quantity_text.h"

#include <QVBoxLayout>

namespace episcope {
namespace {

using render::Quantity;

// A software renderer draws this many points fluently.
constexpr std::size_t kMostPoints = 400'000;

using CloudPtr = std::shared_ptr<const PointCloud>;

int step_for(std::size_t pixels) {
  int step = 1;
  while (pixels / (step * step) > kMostPoints) ++step;
  return step;
}

}  // namespace

CloudController::CloudController(const Workbench& bench, QWidget* tab)
    : QObject(&bench.owner), bench_(bench), session_(bench.session), tab_(tab), job_(this) {
  connect(&bench.frame, &Frame::tabShown, this, [this] {
    if (!isOnScreen()) return;
    makePanel();
    if (is_stale_) update();
  });
  connect(&bench.overlay, &Overlay::drawn, this, [this] {
    if (panel_ && isOnScreen() && panel_->coloring() != CloudColoring::Image) update();
  });
  session_.on_changed([this](Parts parts) {
    if (parts.has_any(Part::Scene | Part::Shown | Part::View | Part::Evaluations)) {
      is_stale_ = true;
      if (isOnScreen()) update();
    }
  });
}

bool CloudController::isOnScreen() const {
  return bench_.frame.shownTab() == "cloud";
}

void CloudController::makePanel() {
  if (panel_) return;
  // The first OpenGL widget has the native window recreated; the desktop would place it anew unless
  // the window fixes its position.
  bench_.window.move(bench_.window.pos());
  panel_ = new PointCloudPanel(tab_);
  auto* layout = new QVBoxLayout(tab_);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(panel_);
  connect(panel_, &PointCloudPanel::coloringSelected, this, [this] { update(); });
  connect(panel_, &PointCloudPanel::pixelPicked, this,
          [this](PixelIndex pixel) { session_.set_cross_hair(pixel); });
}

QString CloudController::obstacle() const {
  if (!session_.scene()) return tr("Open a light field first.");
  const EstimateEntry* shown = session_.shown();
  if (!shown) return tr("Run a method: its disparity appears here in 3D.");
  if (!shown->estimate->contains(session_.view())) {
    return tr("%1 has no map of this view. Go to the centre view (Home).")
        .arg(QString::fromStdString(shown->name));
  }
  return {};
}

std::optional<CloudController::Coloring> CloudController::coloring() const {
  const Quantity quantity =
      panel_->coloring() == CloudColoring::Error ? Quantity::SignedError : Quantity::Disparity;
  auto source = map_source(session_, {quantity, session_.shown()->id, 0}, session_.view());
  if (!source) return std::nullopt;
  return Coloring{std::move(*source), bench_.overlay.shadingOf(quantity)};
}

void CloudController::update() {
  if (!panel_ || !panel_->isAvailable()) return;
  is_stale_ = false;
  const QString hint = obstacle();
  panel_->setErrorAvailable(session_.has_truth(session_.view()));
  if (!hint.isEmpty()) {
    job_.drop();
    panel_->setLegend({});
    panel_->setCloud({}, hint);
    return;
  }
  if (panel_->coloring() == CloudColoring::Image) {
    startCloud(std::nullopt);
  } else if (const auto colors = coloring()) {
    startCloud(colors);
  }  // else its evaluation tells when it is there
}

void CloudController::startCloud(const std::optional<Coloring>& coloring) {
  job_.start<CloudPtr>(
      [light_field = session_.light_field(), estimate = session_.shown()->estimate,
       view = session_.view(), coloring](const Progress& progress) {
        progress.check();
        const RgbaImage colors = coloring
                                     ? map_picture(*make_map(coloring->source), coloring->shading)
                                     : render::shade_view(*light_field, view);
        progress.check();
        const ShownDisparity map(estimate->field.view(view), light_field->valid_of(view));
        return std::make_shared<const PointCloud>(make_point_cloud(
            map.view(), light_field->info().camera, colors, step_for(map.view().disparity.size())));
      },
      [this, coloring](const CloudPtr& cloud) {
        if (coloring) {
          const Quantity quantity = coloring->source.quantity;
          panel_->setLegend(quantity_label(quantity), coloring->shading);
        } else {
          panel_->setLegend({});
        }
        panel_->setCloud(*cloud, tr("This result has no valid pixels in this view."));
      });
}

}  // namespace episcope

#include "moc_cloud_controller.cpp"
