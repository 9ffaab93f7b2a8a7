// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/estimate/live_controller.h"

#include "app/gui/scene/overlay.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/gui/shell/panes.h"
#include "app/session/load_scene.h"
#include "app/session/session.h"
#include "engine/disparity/registry.h"
#include "widgets/canvas/tile_wall.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/message_bar.h"
#include "widgets/controls/text.h"
#include "widgets/panels/method_panel.h"

#include <QAction>

#include <algorithm>
#include <cmath>
#include <utility>

namespace episcope {
namespace {

using render::Quantity;

constexpr int kRunSection = 0;  // of the menu Estimate

QString time_text(double seconds) {
  return seconds < 1 ? LiveController::tr("%1 ms").arg(std::lround(1000 * seconds))
                     : LiveController::tr("%1 s").arg(number_text(seconds, 1));
}

QString live_name(const std::string& method) {
  return LiveController::tr("Live %1").arg(
      QString::fromStdString(find_estimator(method).info.name));
}

}  // namespace

LiveController::LiveController(const Workbench& bench, MethodPanel& method)
    : QObject(&bench.owner),
      bench_(bench),
      method_(method),
      estimator_(queued_post(this), [this] { show(); }) {
  addCommand();
  connect(&method_, &MethodPanel::liveToggled, this, &LiveController::setOn);
  connect(&method_, &MethodPanel::requestChanged, this, &LiveController::follow);
  connect(bench.viewer_area.canvas(), &ViewCanvas::transformChanged, this, &LiveController::follow);
  connect(bench.viewer_area.wall(), &TileWall::zoomChanged, this, &LiveController::follow);
  connect(&bench.viewer_area, &ViewerArea::previewChanged, this, &LiveController::follow);
  bench.session.on_changed([this](Parts parts) { update(parts); });
}

void LiveController::addCommand() {
  QAction* action = bench_.commands.add(
      {.id = "estimate.live",
       .menu = Menu::Estimate,
       .text = tr("Live estimate"),
       .tip = tr("Estimates the visible part after every change of parameters or view; Run keeps "
                 "the result"),
       .icon = "live",
       .keys = {tr("Ctrl+L")},
       .run = [this] { setOn(!is_on_); },
       .section = kRunSection,
       .enabled =
           [this] {
             return is_on_ || why_nothing_runs(bench_.session, bench_.viewer_area).isEmpty();
           },
       .checked = [this] { return is_on_; }});
  method_.followLiveTip(action);
}

void LiveController::setOn(bool is_on) {
  if (std::exchange(is_on_, is_on) != is_on) {
    if (is_on) {
      follow();
    } else {
      estimator_.clear();
      show();
      giveBack();
    }
  }
  method_.setLive(is_on);
  bench_.commands.refresh();
}

void LiveController::update(Parts parts) {
  if (parts.has(Part::Scene)) {
    // What was drawn before belongs to the other scene.
    before_.reset();
    is_up_ = false;
    estimator_.clear();
    show();
  }
  if (parts.has_any(Part::Scene | Part::View)) follow();
}

std::optional<LiveRequest> LiveController::request() const {
  const RunRequest form = method_.request();
  const Session& session = bench_.session;
  if (!session.scene() || form.method.empty() || bench_.viewer_area.isPreviewing()) return {};
  const QRect seen = bench_.viewer_area.pixelsInSight();
  const PixelRect in_sight{seen.top(), seen.left(), seen.bottom() + 1, seen.right() + 1};
  const LightFieldPtr light_field = session.light_field();
  const PixelRect all{0, 0, light_field->height(), light_field->width()};
  return LiveRequest{light_field,
                     form.method,
                     form.values,
                     session.view(),
                     seen.isEmpty() || in_sight == all ? PixelRect{} : in_sight,
                     session.scene()->even};
}

void LiveController::follow() {
  if (!is_on_) return;
  if (const auto wanted = request()) estimator_.request(*wanted);
  showStatus();
}

void LiveController::show() {
  const auto& map = estimator_.map();
  if (!map) {
    if (std::exchange(map_, nullptr)) bench_.session.clear_live();
    is_up_ = false;
  } else if (std::exchange(map_, map->estimate) != map->estimate) {
    EstimateEntry entry;
    entry.name = live_name(map->estimate->method).toStdString();
    entry.estimate = map->estimate;
    entry.display_range = map->display_range;
    entry.part = map->part;
    bench_.session.set_live(std::move(entry), bench_.session.generation());
    bringUp();
  }
  showStatus();
}

void LiveController::bringUp() {
  if (std::exchange(is_up_, true) || is_of_result(bench_.overlay.quantity())) return;
  if (!before_) before_ = bench_.overlay.quantity();
  bench_.overlay.setQuantity(Quantity::Disparity);
}

void LiveController::giveBack() {
  const auto before = std::exchange(before_, std::nullopt);
  // Unless the user chose something else since.
  if (before && bench_.overlay.quantity() == Quantity::Disparity) {
    bench_.overlay.setQuantity(*before);
  }
}

void LiveController::showJob() {
  Jobs& jobs = bench_.jobs;
  if (!estimator_.is_running()) return jobs.release(std::exchange(job_, 0));
  const QString title = job_title(live_name(method_.request().method), bench_.session);
  const auto shown = jobs.find(job_);
  if (!shown || shown->title != title) {
    jobs.release(job_);
    job_ = jobs.adopt(title, [this] { setOn(false); });
    jobs.setScene(job_, bench_.session.generation());
  }
  jobs.tell(job_, {estimator_.fraction(), {}});
}

void LiveController::showStatus() {
  showJob();
  method_.setLiveStatus(is_on_ ? status() : QString());
}

QString LiveController::status() const {
  if (!bench_.session.scene()) return tr("Live");
  if (estimator_.stage() == LiveStage::Failed) {
    return tr("Live: %1").arg(with_minus(QString::fromStdString(estimator_.sentence())));
  }
  const auto coarse = estimator_.coarse_seconds();
  const QString begun = coarse ? tr("Live: coarse %1 / ").arg(time_text(*coarse)) : tr("Live: ");
  if (estimator_.is_running()) {
    return begun + tr("%1 %").arg(percent_done(estimator_.fraction()));
  }
  if (!estimator_.full_seconds() || !estimator_.map()) return tr("Live");
  const QString done = begun + tr("full %1").arg(time_text(*estimator_.full_seconds()));
  const bool has_view = estimator_.map()->estimate->contains(bench_.session.view());
  return has_view ? done : tr("Live: this method has no map of this view");
}

ViewSelection views_of(bool all_views) {
  return all_views ? ViewSelection::All : ViewSelection::Center;
}

EstimateRequest request_of(const RunRequest& request) {
  return {request.method, request.values, {.views = views_of(request.all_views)}};
}

MethodRuns::MethodRuns(const Workbench& bench) : bench_(bench) {
  bench.session.on_changed([this](Parts parts) {
    if (parts.has(Part::Scenes)) cancelClosed();
    if (parts.has_any(Part::Scene | Part::Estimates)) endOffer();
  });
  connect(&bench.jobs, &Jobs::removed, this, [this](quint64 job) {
    if (runs_.erase(job) > 0) emit changed();
  });
}

void MethodRuns::run(const EstimateRequest& request, const OpenScene& scene, bool was_asked_for) {
  const EstimatorInfo info = find_estimator(request.method).info;
  const QString method = QString::fromStdString(info.name);
  const quint64 job = bench_.jobs.start<FinishedEstimate>(
      Lane::Estimate, job_title(method, scene),
      [request,
       source = scene_source(scene, bench_.opener.cacheFolder(), false)](const Progress& progress) {
        return run_estimator(*source(progress), find_estimator(request.method), request.parameters,
                             request.options, progress);
      },
      [this, method, id = scene.id, was_asked_for](const FinishedEstimate& finished) {
        const int added = bench_.session.add_estimate(finished.estimate, finished.display_range, id,
                                                      isComparing(id));
        if (!was_asked_for) bench_.session.mark_saved(added);
        offerToShow(added);
        if (finished.warning.empty()) return;
        bench_.messages.warn(tr("%1: %2.").arg(method, finding_words(finished.warning)));
        if (id == bench_.session.generation()) bench_.messages.endWithLightField();
      });
  runs_[job] = scene.id;
  bench_.jobs.setScene(job, scene.id);
  if (!was_asked_for) bench_.jobs.setExpendable(job);
  if (info.iterative) bench_.jobs.setIterative(job);
  emit changed();
}

bool MethodRuns::isComparing(std::uint64_t scene) const {
  const Panes& panes = bench_.frame.panes();
  return scene == bench_.session.generation() &&
         (panes.isSeen("tab.compare") || panes.isSeen("tab.errors"));
}

void MethodRuns::offerToShow(int estimate) {
  const EstimateEntry* entry = bench_.session.find_estimate(estimate);
  if (!entry) return;
  const render::Quantity map = bench_.overlay.quantity();
  const bool is_seen = (map == Quantity::View || is_of_result(map)) &&
                       entry->estimate->contains(bench_.session.view());
  if (is_seen && !entry->is_new) return;
  bench_.session.mark_new(estimate);
  offered_ = {estimate, tr("New result: %1").arg(QString::fromStdString(entry->name))};
  bench_.messages.offer(offered_.second, tr("Show"), [this, estimate] { show(estimate); });
}

void MethodRuns::endOffer() {
  const EstimateEntry* entry = bench_.session.find_estimate(offered_.first);
  if (!entry || !entry->is_new) bench_.messages.retract(std::exchange(offered_, {}).second);
}

void MethodRuns::show(int estimate) {
  Session& session = bench_.session;
  const EstimateEntry* entry = session.find_estimate(estimate);
  if (!entry) return;
  if (!entry->estimate->contains(session.view()))
    session.set_view(entry->estimate->field.disparity.first());
  session.show_estimate(estimate);
  bench_.overlay.showResults();
}

bool MethodRuns::isRunning(std::uint64_t scene) const {
  return std::ranges::any_of(runs_, [scene](const auto& run) { return run.second == scene; });
}

std::vector<quint64> MethodRuns::jobsOn(std::uint64_t scene) const {
  std::vector<quint64> jobs;
  for (const auto& [job, of] : runs_) {
    if (of == scene) jobs.push_back(job);
  }
  return jobs;
}

void MethodRuns::cancelClosed() {
  for (const auto& [job, scene] : runs_) {
    if (!bench_.session.find_scene(scene)) bench_.jobs.cancel(job);
  }
}

SceneSource scene_source(const OpenScene& scene, const std::filesystem::path& cache,
                         bool needs_truth) {
  if (scene.scene) return [loaded = scene.scene](const Progress&) { return loaded; };
  LoadOptions options;
  options.open = io::open_schema().parse(scene.reading);
  options.cache_folder = cache;
  options.needs_truth = needs_truth;
  return [input = scene.input, options](const Progress& progress) {
    return std::make_shared<const Scene>(load_scene(input, options, progress));
  };
}

}  // namespace episcope

#include "moc_live_controller.cpp"
