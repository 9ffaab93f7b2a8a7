// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"
#include "app/session/load_scene.h"
#include "app/session/session.h"
#include "engine/core/parameter.h"
#include "engine/io/models/open_options.h"

#include <QObject>
#include <QString>

#include <filesystem>
#include <functional>
#include <memory>

namespace episcope {

class LeaveGuards;
class SceneSwitcher;
class ViewerArea;

/// Opens light fields in the background, and asks where files do not tell how. The centre view is
/// shown as soon as it is read; what was open stays until everything is loaded, and if loading
/// fails or is cancelled.
class SceneOpener : public QObject {
  Q_OBJECT

 public:
  SceneOpener(Session& session, Jobs& jobs, ViewerArea& viewer_area, const LeaveGuards& guards,
              SceneSwitcher& scenes, QObject* parent);

  /// Opens a path, `demo` or `demo:<scene>`, with the conventions that are remembered for it,
  /// beside what is open already; what is open itself is shown. `then` is called after success,
  /// `otherwise` after a failure, with the sentence that told it, and after `isCollection`, with
  /// none; neither if it is cancelled or gives way to another. A project is not opened here: see
  /// `isProject`.
  void open(const QString& input, std::function<void()> then = nullptr,
            std::function<void(const QString&)> otherwise = nullptr);
  /// Reads what is open, or what failed to open, again as it is on the disk by now.
  void reopen();
  /// Reads what is open, or what failed to open, again as the user chose. The choice is remembered
  /// for that file if it could be read.
  void reopenWith(const ParameterSet& given);
  /// The same of what is open, also after something else failed to open.
  void reopenShownWith(const ParameterSet& given);
  /// Reads what is open again at another focus plane (0: that of the files). `then` is called after
  /// success.
  void reopenAt(double focus_px, std::function<void()> then);
  /// Reads another frame of the sequence that is open. `then` is called after success.
  void reopenFrame(int frame, std::function<void()> then);
  /// What `reopenWith` would read; empty if there is nothing, or a built-in scene.
  [[nodiscard]] QString reopenable() const;
  /// Whether what was asked for last could not be read.
  [[nodiscard]] bool hasFailed() const { return !failed_input_.isEmpty(); }
  /// Closes what is shown; another light field that is open is shown then.
  void close();

  /// Where built-in scenes, and what is known of collections, are kept; empty = nowhere.
  [[nodiscard]] const std::filesystem::path& cacheFolder() const { return cache_folder_; }
  /// For tests.
  void setCacheFolder(const std::filesystem::path& folder);

 signals:
  /// A load begins or ended; what `reopenable` says may be another.
  void changed();
  /// The session has a light field that `open` was asked for; paths are absolute.
  void opened(const QString& input);
  /// `open` was asked for a folder that is no light field but holds some.
  void isCollection(const QString& folder);
  /// `open` was asked for a project file.
  void isProject(const QString& path);
  /// Something else is open by now than what this sentence says could not be.
  void failureIsOver(const QString& sentence);

 private:
  struct Load {
    QString input;
    ParameterSet given;
    bool is_remembered = false;  ///< Conventions that do not fit any more are passed over.
    std::function<void()> then{};
    std::function<void(const QString&)> otherwise{};
    bool keeps_results = false;  ///< `then` brings them back.
    bool is_added = false;       ///< Beside what is open, not in its place.
  };

  void readAs(const QString& input, const ParameterSet& given, bool is_added);
  void load(const Load& load);
  void leave(const Load& load, const std::function<void()>& go_on);
  void start(const Load& load);
  [[nodiscard]] LoadOptions loadOptions(quint64 number, const ParameterSet& given);
  void showLoading(quint64 job, double fraction);
  void finish(const Load& load, const std::shared_ptr<const Scene>& scene);
  void end(quint64 number, const Load& load);
  void ask(const Load& load, const io::Undecided& question);
  void keepBuiltin(const QString& input);
  void forgetFailure();

  Session& session_;
  Jobs& jobs_;
  ViewerArea& viewer_area_;
  const LeaveGuards& guards_;
  SceneSwitcher& scenes_;
  std::filesystem::path cache_folder_;
  quint64 number_ = 0;  // of the newest load
  quint64 loading_job_ = 0;
  QString loading_name_;
  bool has_asked_ = false;  // whether it waits for an answer
  QString last_failure_;
  QString told_failure_;  // of the last load that failed, until another succeeds
  QString failed_input_;  // asked for last, and not to be read
};

/// Whether this opens a built-in scene.
[[nodiscard]] bool is_builtin(const QString& input);

/// The reading options (io::open_schema) that the user set for this file or folder; none if all are
/// automatic. `path` is absolute.
[[nodiscard]] ParameterSet remembered_conventions(const QString& path);

/// Keeps the options for later opens; without any, the file is forgotten.
void remember_conventions(const QString& path, const ParameterSet& given);

}  // namespace episcope
