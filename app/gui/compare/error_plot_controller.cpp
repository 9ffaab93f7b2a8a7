// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/error_plot_controller.h"

#include "app/gui/compare/region_controller.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/panes.h"
#include "app/session/session.h"
#include "engine/evaluation/resolved_errors.h"
#include "widgets/controls/line_plot.h"
#include "widgets/controls/text.h"
#include "widgets/panels/statistics_panel.h"

#include <QLocale>

namespace episcope {
namespace {

constexpr int kBins = 20;
constexpr const char* kTab = "errors";

using ErrorProfile = std::vector<ErrorBin>;

PlotSeries series_of(const std::string& name, const ErrorProfile& profile, double ErrorBin::*number) {
  PlotSeries series{QString::fromStdString(name), {}};
  for (const ErrorBin& bin : profile) {
    series.points.emplace_back((bin.disparity.min + bin.disparity.max) / 2, bin.*number);
  }
  return series;
}

}  // namespace

ErrorPlotController::ErrorPlotController(const Workbench& bench, const RegionController& region)
    : QObject(&bench.owner),
      bench_(bench),
      session_(bench.session),
      region_(region),
      panel_(new ErrorPlotPanel(&bench.frame)),
      job_(this) {
  bench.frame.addTab({.id = kTab,
                      .title = tr("Errors"),
                      .command_text = tr("Errors tab"),
                      .command_tip = tr("Plots errors against the true disparity"),
                      .widget = panel_,
                      .waits = true,
                      .key = tr("Ctrl+Alt+B")});
  connect(&bench.frame, &Frame::tabShown, this, &ErrorPlotController::update);
  connect(&region, &RegionController::changed, this, &ErrorPlotController::update);
  session_.on_changed([this](Parts parts) {
    if (parts.has_any(Part::Scene | Part::Estimates | Part::Shown | Part::Evaluations | Part::Live))
      update();
  });
}

QString ErrorPlotController::obstacle() const {
  const auto& scene = session_.scene();
  if (!scene) return tr("Open a light field with ground truth and run a method.");
  if (!scene->truth->has_disparity() && !scene->truth->has_layers()) {
    return tr("This light field has no ground truth to compare results with.");
  }
  if (!session_.side_a()) return tr("Run a method: its errors by true disparity appear here.");
  if (!can_judge(*session_.side_a()->estimate, *scene, judged_view(*scene))) {
    return tr("%1 has no map of the view with the ground truth.")
        .arg(QString::fromStdString(session_.side_a()->name));
  }
  return {};
}

std::optional<ErrorPlotController::Judged> ErrorPlotController::judged(const EstimateEntry& entry) {
  const GroundTruth& truth = *session_.scene()->truth;
  const ViewIndex view = judged_view(*session_.scene());
  auto evaluation = session_.evaluation({entry.id, view, Protocol::Vmv2013});
  if (!evaluation) return std::nullopt;
  const bool is_layered = truth.has_layers() && !entry.estimate->layered.foreground.empty();
  const DisparityField& field = is_layered ? truth.foreground : truth.field;
  return Judged{entry.name, std::move(evaluation), field.view(view)};
}

void ErrorPlotController::update() {
  if (!bench_.frame.panes().isSeen(QString("tab.") + kTab)) return job_.drop();
  const QString why = obstacle();
  if (!why.isEmpty()) {
    job_.drop();
    return panel_->clear(why);
  }
  std::vector<Judged> results;
  for (const EstimateEntry* entry : {session_.side_a(), session_.side_b()}) {
    if (!entry) continue;
    if (auto result = judged(*entry)) results.push_back(std::move(*result));
  }
  if (!results.empty()) start(results);  // else they tell when they are there
}

void ErrorPlotController::start(const std::vector<Judged>& results) {
  const double threshold_px = session_.bad_threshold_px();
  job_.start<std::vector<ErrorProfile>>(
      [results, scene = session_.scene(), region = region_.region(),
       threshold_px](const Progress& progress) {
        std::vector<ErrorProfile> profiles;
        for (const Judged& each : results) {
          progress.check();
          profiles.push_back(
              errors_by_disparity(*each.evaluation, each.truth, region.get(), kBins, threshold_px));
        }
        return profiles;
      },
      [this, results, threshold_px, part = region_.name()](const std::vector<ErrorProfile>& profiles) {
        const PlotAxis x{tr("True disparity [px]")};
        Plot squares{x, {tr("MSE×100 [px²]")}, {}};
        Plot bad{x, {tr("Off by more than %1 px [%]").arg(number_text(threshold_px, 2))}, {}};
        std::size_t pixels = 0;
        for (const ErrorBin& bin : profiles.front()) pixels += bin.pixels;
        if (pixels == 0) return panel_->clear(tr("No pixel of the %1 is judged.").arg(part));
        for (std::size_t i = 0; i < results.size(); ++i) {
          squares.series.push_back(series_of(results[i].name, profiles[i], &ErrorBin::mse_100));
          bad.series.push_back(series_of(results[i].name, profiles[i], &ErrorBin::bad_percent));
        }
        panel_->setPlots(tr("%1 · %2, %3 px")
                             .arg(QString::fromStdString(results.front().name), part,
                                  QLocale::c().toString(static_cast<qulonglong>(pixels))),
                         squares, bad);
      });
}

}  // namespace episcope

#include "moc_error_plot_controller.cpp"
