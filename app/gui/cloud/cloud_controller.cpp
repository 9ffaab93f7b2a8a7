// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/cloud/cloud_controller.h"

#include "widgets/cloud/point_cloud_panel.h"

#include <QTabWidget>
#include <QVBoxLayout>

namespace episcope {
namespace {

// A software renderer draws this many points fluently.
constexpr std::size_t kMostPoints = 400'000;

using CloudPtr = std::shared_ptr<const PointCloud>;

int step_for(std::size_t pixels) {
  int step = 1;
  while (pixels / (step * step) > kMostPoints) ++step;
  return step;
}

}  // namespace

CloudController::CloudController(Session& session, const OverlayController& overlay,
                                 const Panels& panels, QObject* parent)
    : QObject(parent), session_(session), overlay_(overlay), panels_(panels), job_(this) {
  connect(panels_.tabs, &QTabWidget::currentChanged, this, [this] {
    if (!isOnScreen()) return;
    makePanel();
    if (is_stale_) update();
  });
  session_.on_changed([this](Parts parts) {
    if (parts.has_any(Part::Scene | Part::Shown | Part::View | Part::Evaluations)) {
      is_stale_ = true;
      if (isOnScreen()) update();
    }
  });
}

bool CloudController::isOnScreen() const {
  return panels_.tabs->currentWidget() == panels_.cloud_tab;
}

void CloudController::makePanel() {
  if (panel_) return;
  // The first OpenGL widget has the window made anew, and placed by the desktop unless it says
  // where it is.
  QWidget* window = panels_.tabs->window();
  window->move(window->pos());
  panel_ = new PointCloudPanel(panels_.cloud_tab);
  auto* layout = new QVBoxLayout(panels_.cloud_tab);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(panel_);
  connect(panel_, &PointCloudPanel::coloringSelected, this, [this] { update(); });
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

void CloudController::update() {
  if (!panel_ || !panel_->isAvailable()) return;
  is_stale_ = false;
  const QString hint = obstacle();
  panel_->setErrorAvailable(session_.has_truth(session_.view()));
  if (!hint.isEmpty()) {
    job_.drop();
    panel_->setCloud({}, hint);
    return;
  }
  const ViewIndex view = session_.view();
  const EstimateEntry& shown = *session_.shown();
  const CloudColoring coloring = panel_->coloring();
  QuantityMapPtr colors;
  render::Shading shading;
  if (coloring != CloudColoring::Image) {
    const auto quantity = coloring == CloudColoring::Error ? render::Quantity::SignedError
                                                           : render::Quantity::Disparity;
    shading = overlay_.shadingOf(quantity);
    const auto source = map_source(session_, {quantity, shown.id, 0}, view);
    if (!source) return;  // its evaluation tells when it is there
    colors = make_map(*source);
  }
  job_.start<CloudPtr>(
      [light_field = session_.light_field(), estimate = shown.estimate, view, colors,
       shading](const Progress& progress) {
        progress.check();
        const Image<std::uint8_t> rgba = colors ? render::shade(colors->map, colors->valid, shading)
                                                : render::shade_view(*light_field, view);
        return std::make_shared<const PointCloud>(
            make_point_cloud(estimate->field.view(view), light_field->info().camera, rgba,
                             step_for(estimate->field.view(view).disparity.size())));
      },
      [this](const CloudPtr& cloud) {
        panel_->setCloud(*cloud, tr("This result has no valid pixel in this view."));
      });
}

}  // namespace episcope
