// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/known_files.h"
#include "app/session/session.h"
#include "app/session/sweep.h"

#include <QObject>
#include <QString>
#include <QStringList>

#include <filesystem>
#include <functional>
#include <map>

namespace episcope {

class Jobs;
class Messages;
class Session;

/// Shows another of the open scenes: at once if it is in memory, else after reading it and its
/// results in the background; keeps the sweeps over them. Lets go of the memory of scenes that were
/// not looked at for long while all of them take more than a budget; what was computed for them is
/// in files by then.
class SceneSwitcher : public QObject {
  Q_OBJECT

 public:
  SceneSwitcher(Session& session, Jobs& jobs, Messages& messages, QObject* parent);

  /// `then` is called once it is shown. Ignored for a scene that is not open.
  void show(std::uint64_t scene, std::function<void()> then = nullptr);
  /// One that is at another place now; `found` is called if its samples are there, before it is
  /// shown. If there are others, that is told, and the scene stays as it was.
  void showMoved(std::uint64_t scene, const std::string& input, std::function<void()> found);
  /// The next of the list, or the one before.
  void step(int step);
  /// The one that was shown last, if nothing is shown.
  void showLatest();

  /// What was swept over them, whichever is shown.
  [[nodiscard]] SweepList& sweeps() { return sweeps_; }

  /// Memory for all scenes together; a third of the machine's at first.
  void setBudget(std::size_t bytes);
  /// Where built-in scenes are kept; empty = nowhere.
  void setCacheFolder(std::filesystem::path folder) { cache_folder_ = std::move(folder); }

 signals:
  /// The light field of a scene is not where it was.
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

/// Whether a path names a result. False for what cannot be read: opening it tells what is wrong.
[[nodiscard]] bool is_result(const QString& path);

/// Adds result files, and maps of other programs, to the results of the open light field, in the
/// background. Warns of results that may belong to another light field.
class ResultOpener : public QObject {
  Q_OBJECT

 public:
  ResultOpener(Session& session, Jobs& jobs, Messages& messages, QObject* parent);

  /// Precondition: a light field is open.
  void open(const QString& path);
  /// Files that results were read from or written to.
  [[nodiscard]] KnownFiles& files() { return files_; }

 private:
  Session& session_;
  Jobs& jobs_;
  Messages& messages_;
  KnownFiles files_;
};

}  // namespace episcope
