// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/statistics_controller.h"

#include "app/gui/compare/compare_controller.h"
#include "app/gui/compare/region_controller.h"
#include "app/gui/scene/overlay.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/features.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/panes.h"
#include "app/session/session.h"
#include "engine/disparity/registry.h"
#include "engine/evaluation/metrics.h"
#include "engine/evaluation/region_metrics.h"
#include "engine/evaluation/resolved_errors.h"
#include "widgets/canvas/tile_wall.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/line_plot.h"
#include "widgets/controls/text.h"
#include "widgets/panels/color_bar.h"
#include "widgets/panels/statistics_panel.h"

#include <QLocale>

#include <algorithm>
#include <cmath>
#include <utility>

namespace episcope {
namespace {

using render::Quantity;

constexpr int kBars = 96;

std::optional<double> bad_percent(const EvaluationPtr& evaluation, const PixelRect& region,
                                  double threshold_px) {
  if (!evaluation) return std::nullopt;
  const Image<std::uint8_t>& judged = evaluation->judged;
  Image<std::uint8_t> mask(judged.height(), judged.width());
  for (int y = region.y0; y < std::min(region.y1, mask.height()); ++y) {
    for (int x = region.x0; x < std::min(region.x1, mask.width()); ++x) mask.at(y, x) = 1;
  }
  return bad_percentage(*evaluation, &mask, InvalidEstimates::Bad, [threshold_px](float error) {
    return std::abs(error) > static_cast<float>(threshold_px);
  });
}

// Bad pixels are measured by their errors.
Quantity measured_by(Quantity quantity) {
  return quantity == Quantity::BadPixels ? Quantity::AbsoluteError : quantity;
}

// Zero stays in the middle of colors that tell signs apart.
Interval balanced(Interval range) {
  const double reach = std::max(std::abs(range.min), std::abs(range.max));
  return {-reach, reach};
}

}  // namespace

StatisticsController::StatisticsController(const Workbench& bench, StatisticsPanel* panel)
    : QObject(&bench.owner), bench_(bench), overlay_(bench.overlay), panel_(panel), job_(this) {
  addCommands();
  const ViewerArea& viewer_area = bench.viewer_area;
  connect(&overlay_, &Overlay::drawn, this, &StatisticsController::begin);
  connect(viewer_area.canvas(), &ViewCanvas::transformChanged, this, &StatisticsController::begin);
  connect(viewer_area.wall(), &TileWall::zoomChanged, this, &StatisticsController::begin);
  connect(viewer_area.colorBar(), &ColorBar::automaticRangeRequested, this,
          &StatisticsController::useAutomaticRange);
  connect(panel_, &StatisticsPanel::rangeEdited, &overlay_, [this](Interval range) {
    if (measured_by(choice_.quantity) == choice_.quantity) overlay_.setRange(range);
  });
  panel_->setBadThreshold(bench.session.bad_threshold_px());
  connect(panel_, &StatisticsPanel::badThresholdEdited, this,
          [this](double threshold_px) { bench_.session.set_bad_threshold(threshold_px); });
  bench.session.on_changed([this](Parts parts) {
    if (parts.has(Part::Scene) && !statistics_) panel_->clear(tr("No map is shown"));
  });
  begin();
}

void StatisticsController::addCommands() {
  QAction* automatic =
      bench_.commands.add({.id = "compare.auto_range",
                           .menu = Menu::Compare,
                           .text = tr("Automatic range"),
                           .tip = tr("Stretches the colors over the visible values"),
                           .icon = "auto",
                           .keys = {Qt::Key_A},
                           .run = [this] { useAutomaticRange(); },
                           .section = compare_section::kRange});
  QAction* own = bench_.commands.add({.id = "compare.own_range",
                                      .menu = Menu::Compare,
                                      .text = tr("Default range"),
                                      .tip = tr("Restores the default range of the quantity"),
                                      .icon = "reset",
                                      .keys = {Qt::Key_R},
                                      .run = [this] { overlay_.setRange(std::nullopt); },
                                      .section = compare_section::kRange});
  bench_.viewer_area.colorBar()->followTips(automatic, own);
}

void StatisticsController::begin() {
  if (!overlay_.isUpToDate()) {
    job_.drop();
    statistics_.reset();
    return;
  }
  const QRect seen = bench_.viewer_area.pixelsInSight();
  const PixelRect region{seen.top(), seen.left(), seen.bottom() + 1, seen.right() + 1};
  const bool is_same = map_ == overlay_.map() && region == region_ && statistics_;
  map_ = overlay_.map();
  region_ = region;
  choice_ = overlay_.choice();
  if (!map_ || seen.isEmpty()) {
    job_.drop();
    statistics_.reset();
    wants_range_ = false;
    panel_->clear(areLabelsDrawn() ? tr("Labels have no statistics") : tr("No map is shown"));
    return;
  }
  if (!is_same) statistics_.reset();
  count(region);
}

bool StatisticsController::areLabelsDrawn() const {
  const bool are_labels =
      choice_.quantity == Quantity::TrueLabels || choice_.quantity == Quantity::Segmentation;
  return are_labels && !overlay_.picture().isNull();
}

void StatisticsController::count(const PixelRect& region) {
  Session& session = bench_.session;
  const bool is_result = session.find_estimate(choice_.estimate) &&
                         choice_.quantity != Quantity::Difference &&
                         choice_.quantity != Quantity::Truth;
  const EvaluationPtr evaluation =
      is_result ? session.evaluation({choice_.estimate, session.view(), Protocol::Benchmark2016})
                : nullptr;
  job_.start<Counted>(
      [map = map_, region, evaluation, threshold_px = session.bad_threshold_px(),
       shown = overlay_.shadingOf(measured_by(choice_.quantity)).range](const Progress& progress) {
        progress.check();
        return Counted{render::region_statistics({map->numbers(), map->valid, map->inside}, region,
                                                 shown, kBars),
                       bad_percent(evaluation, region, threshold_px)};
      },
      [this](const Counted& counted) { show(counted); });
}

void StatisticsController::show(const Counted& counted) {
  statistics_ = counted.statistics;
  if (choice_.quantity == Quantity::WrongLabels && statistics_->count > 0) {
    wants_range_ = false;
    // The mean of good and bad ones.
    const double share = (statistics_->mean - kGoodPixel) / (kBadPixel - kGoodPixel);
    return panel_->clear(
        tr("Wrong labels: %1 % of the visible part").arg(number_text(100 * share, 2)));
  }
  MapChoice measured = choice_;
  measured.quantity = measured_by(choice_.quantity);
  panel_->setSummary({overlay_.describe(measured), quantity_unit(measured.quantity),
                      counted.statistics, counted.bad_percent,
                      overlay_.shadingOf(measured.quantity)});
  if (wants_range_) applyAutomaticRange();
}

void StatisticsController::useAutomaticRange() {
  if (!map_ && overlay_.isUpToDate()) return;  // There is none, and none is on its way.
  wants_range_ = true;
  if (statistics_) applyAutomaticRange();
}

void StatisticsController::applyAutomaticRange() {
  wants_range_ = false;
  const bool has_range = measured_by(choice_.quantity) == choice_.quantity &&
                         choice_.quantity != Quantity::WrongLabels;
  if (!has_range) return;
  const bool is_signed = render::info_of(choice_.quantity).is_signed();
  const Interval range = is_signed ? balanced(statistics_->robust) : statistics_->robust;
  if (statistics_->count > 0 && range.length() > 0) overlay_.setRange(range);
}

namespace {

constexpr int kBins = 20;
constexpr const char* kTab = "errors";

using ErrorProfile = std::vector<ErrorBin>;

PlotSeries series_of(const QString& name, const ErrorProfile& profile, double ErrorBin::*number) {
  PlotSeries series{name, {}};
  for (const ErrorBin& bin : profile) {
    series.points.emplace_back((bin.disparity.min + bin.disparity.max) / 2, bin.*number);
  }
  return series;
}

// Of two results of a method, what they differ in; of others, and of renamed ones, the name.
QString legend_of(const EstimateEntry& entry, const EstimateEntry* other) {
  const QString name = QString::fromStdString(entry.name);
  if (!other || other->estimate->method != entry.estimate->method) return name;
  const Estimator* method = known_estimator(entry.estimate->method);
  if (!method || !name.startsWith(QString::fromStdString(method->info.name))) return name;
  const QString own = parameter_text(*entry.estimate, other->estimate->parameters);
  const QString others = parameter_text(*other->estimate, entry.estimate->parameters);
  return own == others ? name : own;
}

}  // namespace

/// The tab of errors over true disparity, for the shown result and the one compared with it, in the
/// evaluated region. Computed in the background, only while the tab is visible.
class ErrorPlotController : public QObject {
  Q_OBJECT

 public:
  ErrorPlotController(const Workbench& bench, const RegionController& region)
      : QObject(&bench.owner),
        bench_(bench),
        session_(bench.session),
        region_(region),
        panel_(new ErrorPlotPanel(&bench.frame)),
        job_(this) {
    bench.frame.addTab({.id = kTab,
                        .title = tr("Errors"),
                        .task = "compare",
                        .command_text = tr("Errors tab"),
                        .command_tip = tr("Plots errors against the true disparity"),
                        .widget = panel_,
                        .key = tr("Ctrl+Alt+B")});
    connect(&bench.frame, &Frame::tabShown, this, &ErrorPlotController::update);
    connect(&region, &RegionController::changed, this, &ErrorPlotController::update);
    session_.on_changed([this](Parts parts) {
      if (parts.has_any(Part::Scene | Part::Estimates | Part::Shown | Part::Evaluations |
                        Part::Live))
        update();
    });
  }

 private:
  struct Judged {
    QString name;
    EvaluationPtr evaluation;
    DisparityView truth;  ///< Owned by the scene, which outlives the job.
    QString legend{};
  };

  void update() {
    if (!bench_.frame.panes().isSeen(QString("tab.") + kTab)) return job_.drop();
    const QString why = obstacle();
    if (!why.isEmpty()) {
      job_.drop();
      return panel_->clear(why);
    }
    std::vector<Judged> results;
    const EstimateEntry* a = session_.side_a();
    const EstimateEntry* b = session_.side_b();
    for (const auto& [entry, other] : {std::pair(a, b), std::pair(b, a)}) {
      if (!entry) continue;
      auto result = judged(*entry);
      if (!result) continue;
      result->legend = legend_of(*entry, other);
      results.push_back(std::move(*result));
    }
    if (!results.empty()) start(results);  // else they tell when they are there
  }

  [[nodiscard]] QString obstacle() const {
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

  /// None while the evaluation runs.
  [[nodiscard]] std::optional<Judged> judged(const EstimateEntry& entry) {
    const GroundTruth& truth = *session_.scene()->truth;
    const ViewIndex view = judged_view(*session_.scene());
    auto evaluation = session_.evaluation({entry.id, view, Protocol::Vmv2013});
    if (!evaluation) return std::nullopt;
    const bool is_layered = truth.has_layers() && !entry.estimate->layered.foreground.empty();
    const DisparityField& field = is_layered ? truth.foreground : truth.field;
    return Judged{QString::fromStdString(entry.name), std::move(evaluation), field.view(view)};
  }

  void start(const std::vector<Judged>& results) {
    const double threshold_px = session_.bad_threshold_px();
    job_.start<std::vector<ErrorProfile>>(
        [results, scene = session_.scene(), region = region_.region(),
         threshold_px](const Progress& progress) {
          std::vector<ErrorProfile> profiles;
          for (const Judged& each : results) {
            progress.check();
            profiles.push_back(errors_by_disparity(*each.evaluation, each.truth, region.get(),
                                                   kBins, threshold_px));
          }
          return profiles;
        },
        [this, results, threshold_px,
         part = region_.name()](const std::vector<ErrorProfile>& profiles) {
          const PlotAxis x{tr("True disparity [px]")};
          Plot squares{x, {tr("MSE×100 [px²]")}, {}};
          Plot bad{x,
                   {tr("Bad pixels: off by more than %1 px [%]").arg(number_text(threshold_px, 2))},
                   {}};
          std::size_t pixels = 0;
          for (const ErrorBin& bin : profiles.front()) pixels += bin.pixels;
          if (pixels == 0)
            return panel_->clear(tr("No pixel of the %1 can be evaluated.").arg(part));
          for (std::size_t i = 0; i < results.size(); ++i) {
            const QString& legend = results[i].legend;
            squares.series.push_back(series_of(legend, profiles[i], &ErrorBin::mse_100));
            bad.series.push_back(series_of(legend, profiles[i], &ErrorBin::bad_percent));
          }
          panel_->setPlots(tr("%1 · %2, %3 px")
                               .arg(results.front().name, part,
                                    QLocale::c().toString(static_cast<qulonglong>(pixels))),
                           squares, bad);
        });
  }

  Workbench bench_;
  Session& session_;
  const RegionController& region_;
  ErrorPlotPanel* panel_;
  LatestJob job_;
};

void add_error_plots(const Workbench& bench, const RegionController& region) {
  new ErrorPlotController(bench, region);
}

}  // namespace episcope

#include "moc_statistics_controller.cpp"

#include "statistics_controller.moc"
