// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/cloud/cloud_controller.h"

#include "app/gui/cloud/cloud_settings.h"
#include "app/gui/frame/commands.h"
#include "app/gui/frame/dialogs.h"
#include "app/gui/frame/frame.h"
#include "app/gui/stage/overlay.h"
#include "app/session/session.h"
#include "widgets/cloud/point_cloud_panel.h"
#include "widgets/controls/tool_button.h"
#include "widgets/style/number_text.h"

#include <QLocale>
#include <QToolButton>
#include <QVBoxLayout>

#include <utility>

namespace episcope {

CloudController::CloudController(const Workbench& bench, QWidget* tab)
    : QObject(&bench.owner),
      bench_(bench),
      session_(bench.session),
      requests_(bench),
      tab_(tab),
      job_(this) {
  connect(&bench.frame, &Frame::tabShown, this, [this](const QString& id) {
    if (id == "cloud") makePanel();
  });
  connect(&bench.frame, &Frame::started, this, [this] {
    if (read_cloud_settings().is_large) setLarge(true);
  });
  connect(&bench.frame, &Frame::layoutReset, this, [this] { setLarge(false); });
  connect(&bench.stage, &Stage::guestDismissed, this, [this] { setLarge(false); });
  connect(&bench.overlay, &Overlay::drawn, this, [this] {
    // Colour ranges and labels may have changed.
    if (panel_ && panel_->controls().choice().coloring != CloudColoring::Image) refresh();
  });
  session_.on_changed([this](Parts parts) { hear(parts); });
}

void CloudController::hear(Parts parts) {
  if (!panel_) return;
  if (parts.has_any(Part::Scene | Part::Estimates | Part::Shown | Part::View | Part::Evaluations |
                    Part::Tone)) {
    refresh();
  }
  if (parts.has(Part::CrossHair) && isOnScreen() && panel_->isAvailable()) {
    panel_->display().view()->setMarkedPixel(session_.cross_hair());
  }
}

bool CloudController::isOnScreen() const {
  return panel_ && panel_->display().isVisible();
}

void CloudController::makePanel() {
  if (panel_) return;
  panel_ = new PointCloudPanel(tab_);
  const CloudSettings settings = read_cloud_settings();
  panel_->controls().setChoice(settings.choice);
  panel_->controls().setLook(settings.look);
  for (const char* id : {"cloud.large", "cloud.window"}) {
    panel_->addButton(make_action_button(bench_.commands.find(id), id, panel_));
  }
  auto* layout = new QVBoxLayout(tab_);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(panel_);
  connectPanel();
  if (isOnScreen()) update();
}

void CloudController::connectPanel() {
  CloudDisplay& display = panel_->display();
  connect(&display, &CloudDisplay::shown, this, [this] {
    if (is_stale_) update();
  });
  connect(&display, &CloudDisplay::pixelPicked, this,
          [this](PixelIndex pixel) { session_.set_cross_hair(pixel); });
  connect(&panel_->controls(), &CloudControls::choiceChanged, this, [this] {
    remember();
    refresh();
  });
  connect(&panel_->controls(), &CloudControls::lookChanged, this, &CloudController::remember);
  if (panel_->isAvailable()) display.view()->setLook(panel_->controls().look());
}

void CloudController::remember() const {
  if (!panel_) return;
  write_cloud_settings({panel_->controls().choice(), panel_->controls().look(), is_large_});
}

void CloudController::setLarge(bool is_large) {
  if (is_large == is_large_) return;
  makePanel();
  is_large_ = is_large;
  if (is_large) {
    panel_->lendDisplay(tr("The 3D view is in the place of the view."));
    bench_.stage.setGuest(&panel_->display());
  } else {
    bench_.stage.releaseGuest();
    panel_->takeDisplayBack();
  }
  remember();
  bench_.commands.refresh();
}

// What is out of date and not seen takes no memory and no time.
void CloudController::refresh() {
  is_stale_ = true;
  if (isOnScreen()) {
    update();
  } else {
    job_.drop();
    if (hasScene()) showHint({});
  }
}

void CloudController::showHint(const QString& hint) {
  parts_ = std::make_shared<const CloudParts>();
  panel_->display().setParts(parts_, hint);
  panel_->controls().setSummary({});
  if (panel_->isAvailable()) panel_->display().view()->setLegend({});
  bench_.commands.refresh();
}

void CloudController::update() {
  if (!panel_->isAvailable()) return;
  is_stale_ = false;
  if (const QString hint = requests_.obstacle(); !hint.isEmpty()) {
    job_.drop();
    showHint(hint);
    return;
  }
  panel_->controls().setOffers(requests_.offers());
  const auto request = requests_.request(panel_->controls().choice());
  if (request) start(*request);  // else its evaluation tells when it is there
}

void CloudController::start(const SpaceRequest& request) {
  if (request.reference) panel_->controls().setSummary(tr("Measuring distances …"));
  job_.start<std::shared_ptr<const Made>>(
      [request](const Progress& progress) {
        SpaceScene scene = make_space_scene(request, progress);
        return std::make_shared<const Made>(
            Made{std::make_shared<const CloudParts>(std::move(scene.parts)),
                 std::move(scene.distance), std::move(scene.shading)});
      },
      [this](const std::shared_ptr<const Made>& made) { show(*made); });
}

void CloudController::show(const Made& made) {
  const CloudChoice choice = panel_->controls().choice();
  parts_ = made.parts;
  panel_->display().setParts(parts_, tr("This result has no valid pixels in this view."));
  PointCloudView& view = *panel_->display().view();
  if (made.shading) {
    view.setLegend(requests_.legend(choice), *made.shading);
  } else {
    view.setLegend({});
  }
  view.setMarkedPixel(session_.cross_hair());
  panel_->controls().setSummary(summary(made));
  bench_.commands.refresh();
}

QString CloudController::summary(const Made& made) const {
  const CloudChoice choice = panel_->controls().choice();
  std::size_t points = 0;
  for (const CloudPart& part : *made.parts) points += part.all.positions.size();
  QString text =
      tr("%1: %2 points")
          .arg(requests_.title(choice), QLocale::c().toString(static_cast<quint64>(points)));
  if (choice.coloring == CloudColoring::Source && made.parts->size() > 1) {
    text += tr(", in orange and blue");
  }
  if (!made.distance) return text;
  return text + tr(". From its points to the nearest of %1, in units of the scene: mean %2, median "
                   "%3, 95 % below %4")
                    .arg(requests_.referenceName(choice), number_text(made.distance->mean, 4),
                         number_text(made.distance->median, 4),
                         number_text(made.distance->percentile95, 4));
}

void CloudController::askToExport() const {
  const std::string& scene = session_.light_field()->info().name;
  ask_where_to_save(&bench_.window,
                    {.name = "export_cloud",
                     .title = tr("Save what the 3D view shows"),
                     .filter = tr("Point cloud or surface (*.ply)"),
                     .proposal = QString::fromStdString(scene + ".ply")},
                    [this, parts = parts_](const QString& path) {
                      if (!has_suffix(path, {"ply"}, bench_.messages)) return;
                      write_in_background(bench_.jobs, bench_.messages, path,
                                          [parts, file = path.toStdString()](const Progress&) {
                                            save_space_scene(file, *parts);
                                          });
                    });
}

}  // namespace episcope

#include "moc_cloud_controller.cpp"
