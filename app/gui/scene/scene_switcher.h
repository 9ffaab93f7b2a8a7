// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/session.h"
#include "app/session/sweep.h"
#include "app/session/user_folders.h"
#include "engine/io/models/better_reading.h"

#include <QObject>
#include <QString>
#include <QStringList>

#include <filesystem>
#include <functional>
#include <map>

namespace episcope {

class Jobs;
class Messages;

/// Switches between open scenes: at once if the scene is in memory, else after reading it and its
/// results in the background. Keeps the sweeps over scenes. Frees the least recently used scenes
/// while all exceed a memory budget; their results are in files by then.
class SceneSwitcher : public QObject {
  Q_OBJECT

 public:
  SceneSwitcher(Session& session, Jobs& jobs, Messages& messages, QObject* parent);

  /// Calls `then` once the scene is shown. Ignores a scene that is not open.
  void show(std::uint64_t scene, std::function<void()> then = nullptr);
  /// Shows a scene that was moved. Calls `found` first if its samples are there; else tells the
  /// user and leaves the scene unchanged.
  void showMoved(std::uint64_t scene, const std::string& input, std::function<void()> found);
  /// Shows the next scene of the list, or the previous one.
  void step(int step);
  /// Shows the last shown scene, if nothing is shown.
  void showLatest();

  /// Sweeps over all scenes.
  [[nodiscard]] SweepList& sweeps() { return sweeps_; }

  /// Memory budget of all scenes; a third of the machine's memory by default.
  void setBudget(std::size_t bytes);
  /// Folder of built-in scenes; empty = nowhere.
  void setCacheFolder(std::filesystem::path folder) { cache_folder_ = std::move(folder); }

 signals:
  /// The light field of a scene is not at its place.
  void notFound(quint64 scene);

 private:
  struct Read {
    std::shared_ptr<const Scene> scene;
    std::map<int, EstimatePtr> estimates;
    QStringList failures;
    bool has_other_samples = false;
  };

  void read(OpenScene scene, std::function<bool(const Read&)> takes, std::function<void()> then);
  void finish(std::uint64_t id, const Read& read);
  [[nodiscard]] static Read read_all(const OpenScene& scene, const std::filesystem::path& cache,
                                     const Progress& progress);
  void keepBudget();
  void keepSweeps();

  Session& session_;
  Jobs& jobs_;
  Messages& messages_;
  std::filesystem::path cache_folder_;
  std::size_t budget_;
  SweepList sweeps_;
  std::uint64_t wanted_ = 0;  // asked for last, and on its way
};

/// Whether a path names a result. False for unreadable files; opening those reports the problem.
[[nodiscard]] bool is_result(const QString& path);

/// Adds result files and maps of other programs to the open light field's results, in the
/// background. Warns of results that may belong to another light field, and of maps that fit far
/// better by another reading, which it offers to apply.
class ResultOpener : public QObject {
  Q_OBJECT

 public:
  ResultOpener(Session& session, Jobs& jobs, Messages& messages, QObject* parent);

  /// Precondition: a light field is open.
  void open(const QString& path) { openAs({.path = path}); }
  /// Adds a result that is known to belong to another light field, and marks it. Precondition: a
  /// light field is open.
  void openForeign(const QString& path) { openAs({.path = path, .is_foreign = true}); }
  /// Asks whether to add a map that was found beside the light field, unless it is its ground
  /// truth. Precondition: a light field is open.
  void offer(const QString& path) { openAs({.path = path, .is_offered = true}); }
  /// Files that results were read from or written to.
  [[nodiscard]] KnownFiles& files() { return files_; }

 private:
  struct Request {
    QString path;
    io::MapReading reading{};
    int misread = 0;  ///< The result of the same file that this reading replaces; 0 = none.
    bool is_foreign = false;
    bool is_offered = false;  ///< To be asked about, once it was read.
  };
  void openAs(const Request& request);
  void offer(Request request);
  /// Offers to read a file so that was read into the result `misread`.
  void offerReading(const Request& request, const io::BetterReading& better, int misread);

  Session& session_;
  Jobs& jobs_;
  Messages& messages_;
  KnownFiles files_;
};

}  // namespace episcope
