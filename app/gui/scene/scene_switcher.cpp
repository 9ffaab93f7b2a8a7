// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/scene/scene_switcher.h"

#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/session/load_scene.h"
#include "app/session/result_files.h"
#include "app/session/result_fit.h"
#include "app/session/run_estimator.h"
#include "app/session/scene_summary.h"
#include "engine/core/error.h"
#include "widgets/controls/text.h"

#include <QFileInfo>

#include <unistd.h>
#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace episcope {
namespace {

std::size_t third_of_memory() {
  const long pages = sysconf(_SC_PHYS_PAGES);
  const long page = sysconf(_SC_PAGE_SIZE);
  constexpr std::size_t least = std::size_t{1} << 30;
  if (pages <= 0 || page <= 0) return least;
  return std::max(least, static_cast<std::size_t>(pages) * static_cast<std::size_t>(page) / 3);
}

bool is_there(const std::string& input) {
  return !builtin_scene_id(input).empty() || QFileInfo::exists(QString::fromStdString(input));
}

bool is_kept(const OpenScene& scene) {
  const bool has_labels_in_memory = scene.labels.labeling && scene.labels.file.empty();
  return !has_labels_in_memory &&
         std::ranges::none_of(scene.estimates,
                              [](const EstimateEntry& each) { return each.kept.empty(); });
}

}  // namespace

SceneSwitcher::SceneSwitcher(Session& session, Jobs& jobs, Messages& messages, QObject* parent)
    : QObject(parent),
      session_(session),
      jobs_(jobs),
      messages_(messages),
      cache_folder_(default_cache_folder()),
      budget_(third_of_memory()) {
  session_.on_changed([this](Parts parts) {
    if (parts.has_any(Part::Scene | Part::Scenes)) keepBudget();
    if (parts.has(Part::Scenes)) keepSweeps();
  });
}

void SceneSwitcher::show(std::uint64_t id, std::function<void()> then) {
  const OpenScene* scene = session_.find_scene(id);
  if (!scene) return;
  wanted_ = 0;
  if (scene->scene) {
    session_.choose(id);
    if (then) then();
  } else if (!is_there(scene->input)) {
    emit notFound(id);
  } else {
    read(
        *scene, [](const Read&) { return true; }, std::move(then));
  }
}

void SceneSwitcher::showMoved(std::uint64_t id, const std::string& input,
                              std::function<void()> found) {
  const OpenScene* scene = session_.find_scene(id);
  if (!scene || scene->scene) return;
  OpenScene moved = *scene;
  moved.input = input;
  const auto takes = [this, input, name = scene->name, found = std::move(found)](const Read& read) {
    if (read.has_other_samples) {
      messages_.fail(tr("%1 is not “%2”: it has other samples. Nothing was changed.")
                         .arg(QString::fromStdString(input), QString::fromStdString(name)));
    } else {
      found();
    }
    return !read.has_other_samples;
  };
  read(std::move(moved), takes, nullptr);
}

void SceneSwitcher::step(int step) {
  const auto scenes = session_.scenes();
  const auto count = static_cast<int>(scenes.size());
  const auto now = std::ranges::find(scenes, session_.generation(), &OpenScene::id);
  if (count == 0) return;
  // From none of them, to the first or the last.
  const auto place = now != scenes.end() ? static_cast<int>(now - scenes.begin())
                     : step > 0          ? -1
                                         : count;
  show(scenes[static_cast<std::size_t>((place + step + count) % count)]->id);
}

void SceneSwitcher::showLatest() {
  const auto scenes = session_.scenes();
  if (session_.scene() || scenes.empty()) return;
  show((*std::ranges::max_element(scenes, {}, &OpenScene::last_used))->id);
}

SceneSwitcher::Read SceneSwitcher::read_all(const OpenScene& scene,
                                            const std::filesystem::path& cache,
                                            const Progress& progress) {
  LoadOptions options;
  options.cache_folder = cache;
  options.open = io::open_schema().parse(scene.reading);
  Read read;
  read.scene =
      std::make_shared<const Scene>(load_scene(scene.input, options, progress.part(0, 0.7)));
  read.has_other_samples =
      scene.sample_hash != 0 && scene.sample_hash != read.scene->light_field->sample_hash();
  if (read.has_other_samples) {
    read.failures << tr("“%1” has other samples than before: results and scribbles may not fit.")
                         .arg(QString::fromStdString(scene.name));
  }
  for (const EstimateEntry& entry : scene.estimates) {
    if (entry.estimate) continue;
    progress.check();
    try {
      auto estimate =
          std::make_shared<const Estimate>(read_result_of(*read.scene->light_field, entry.kept));
      read.estimates[entry.id] = std::move(estimate);
    } catch (const Error& error) {
      read.failures << QString::fromUtf8(error.what());
    }
  }
  return read;
}

void SceneSwitcher::read(OpenScene scene, std::function<bool(const Read&)> takes,
                         std::function<void()> then) {
  const std::uint64_t id = scene.id;
  wanted_ = id;
  auto copy = std::make_shared<OpenScene>(std::move(scene));
  jobs_.start<Read>(
      Lane::Open, tr("Opening %1").arg(QString::fromStdString(copy->name)),
      [copy, cache = cache_folder_](const Progress& progress) {
        return read_all(*copy, cache, progress);
      },
      [this, id, takes = std::move(takes), then = std::move(then)](const Read& found) {
        if (!takes(found)) return;
        finish(id, found);
        if (wanted_ != id) return;
        wanted_ = 0;
        session_.choose(id);
        if (then) then();
      });
}

void SceneSwitcher::finish(std::uint64_t id, const Read& read) {
  const OpenScene* scene = session_.find_scene(id);
  if (!scene || scene->scene) return;
  session_.load(id, read.scene, read.estimates);
  if (!read.failures.isEmpty()) messages_.warn(read.failures.join(' '));
}

// Drops sweeps of closed scenes.
void SceneSwitcher::keepSweeps() {
  std::vector<std::uint64_t> open;
  for (const OpenScene* each : session_.scenes()) open.push_back(each->id);
  sweeps_.keep_scenes(open);
}

void SceneSwitcher::setBudget(std::size_t bytes) {
  budget_ = bytes;
  keepBudget();
}

void SceneSwitcher::keepBudget() {
  std::size_t bytes = 0;
  std::vector<const OpenScene*> loaded;
  for (const OpenScene* each : session_.scenes()) {
    if (!each->scene) continue;
    bytes += byte_size(*each);
    if (each->id != session_.generation() && is_kept(*each)) loaded.push_back(each);
  }
  std::ranges::sort(loaded, {}, &OpenScene::last_used);
  for (const OpenScene* each : loaded) {
    if (bytes <= budget_) return;
    bytes -= byte_size(*each);
    session_.unload(each->id);
  }
}

namespace {

struct ReadEstimate : FinishedEstimate {
  bool is_truth = false;
  bool is_of_others = false;
  std::string differing_options;
  std::optional<io::BetterReading> better;
  std::string poor_fit;
  FileStamp stamp;
};

/// A user's reading is not doubted.
ReadEstimate read_estimate(const Scene& scene, const std::string& path,
                           const io::MapReading& reading, const Progress& progress) {
  const LightField& light_field = *scene.light_field;
  const FileStamp stamp = stamp_of(path);
  auto estimate = std::make_shared<Estimate>(read_result_of(light_field, path, reading));
  progress.check();
  const bool is_of_others = is_of_other_samples(*estimate, light_field);
  const bool is_moved = estimate->reading.focus_px() != light_field.info().reading.focus_px();
  bring_to_focus(*estimate, light_field, progress);
  const bool is_truth = reading == io::MapReading() && is_ground_truth(*estimate, scene);
  const Interval range = display_range(*estimate);
  std::string options = differing_options(*estimate, light_field);
  std::optional<io::BetterReading> better;
  if (reading == io::MapReading()) better = find_better_reading(*estimate, scene);
  std::string poor_fit = better ? std::string() : doubt_text(*estimate, scene, is_of_others);
  return {
      {std::move(estimate), range}, is_truth, is_of_others && !is_moved, std::move(options), better,
      std::move(poor_fit),          stamp};
}

}  // namespace

bool is_result(const QString& path) {
  try {
    return names_result(path.toStdString());
  } catch (const std::exception&) {
    return false;
  }
}

ResultOpener::ResultOpener(Session& session, Jobs& jobs, Messages& messages, QObject* parent)
    : QObject(parent), session_(session), jobs_(jobs), messages_(messages) {}

void ResultOpener::openAs(const Request& request) {
  const QString name = QFileInfo(request.path).fileName();
  jobs_.start<ReadEstimate>(
      Lane::Load, tr("Opening %1").arg(name),
      [scene = session_.scene(), path = request.path.toStdString(), reading = request.reading](
          const Progress& progress) { return read_estimate(*scene, path, reading, progress); },
      [this, generation = session_.generation(), name, request](const ReadEstimate& read) {
        if (read.is_truth) {
          return messages_.hint(tr("%1 is the ground truth of this light field.").arg(name));
        }
        if (request.is_offered) return offer(request);
        const std::filesystem::path path = request.path.toStdString();
        files_.note(path, read.stamp);
        session_.remove_estimate(request.misread);
        const int id = session_.add_estimate(read.estimate, read.display_range, generation);
        session_.show_opened_estimate(id);
        session_.mark_saved(id);
        if (request.is_foreign || read.is_of_others) session_.set_foreign_file(id, path);
        if (!read.differing_options.empty()) {
          messages_.warn(tr("%1 was estimated with%2: its errors may be meaningless. Choose the "
                            "same values in Conventions…")
                             .arg(name, QString::fromStdString(read.differing_options)));
        } else if (read.better) {
          offerReading(request, *read.better, id);
        } else if (read.is_of_others) {
          messages_.warn(
              tr("%1 was estimated from different samples than those of this light field: "
                 "its errors may be meaningless.")
                  .arg(name));
        } else if (!read.poor_fit.empty()) {
          messages_.warn(QString("%1: %2.").arg(name, finding_words(read.poor_fit)));
        } else {
          return;
        }
        messages_.endWithLightField();
      });
}

void ResultOpener::offer(Request request) {
  request.is_offered = false;
  messages_.offer(tr("%1 can be added to the results.").arg(QFileInfo(request.path).fileName()),
                  tr("Add"), [this, request] {
                    if (session_.scene()) openAs(request);
                  });
}

void ResultOpener::offerReading(const Request& request, const io::BetterReading& better,
                                int misread) {
  const QString finding = finding_words(better_reading_finding(better));
  const QString name = QFileInfo(request.path).fileName();
  Request again = request;
  again.reading = better.reading;
  again.misread = misread;
  messages_.warn(tr("%1: %2. If the file is stored so, apply it.").arg(name, finding), tr("Apply"),
                 [this, again] {
                   // Of the light field that is open, and not removed meanwhile.
                   const auto& entries = session_.estimates();
                   const bool is_there =
                       std::ranges::count(entries, again.misread, &EstimateEntry::id) > 0;
                   if (is_there) openAs(again);
                 });
}

}  // namespace episcope

#include "moc_scene_switcher.cpp"
