// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"
#include "app/session/load_scene.h"
#include "app/session/session.h"
#include "engine/core/parameter.h"
#include "engine/io/models/open_options.h"

#include <QHash>
#include <QObject>
#include <QString>

#include <filesystem>
#include <functional>
#include <memory>

namespace episcope {

class LeaveGuards;
class SceneSwitcher;
class ViewerArea;

/// Opens light fields in the background, and asks if files leave their reading open. Shows the
/// center view as soon as it is read; the previous scene stays until loading succeeds.
class SceneOpener : public QObject {
  Q_OBJECT

 public:
  SceneOpener(Session& session, Jobs& jobs, ViewerArea& viewer_area, const LeaveGuards& guards,
              SceneSwitcher& scenes, QObject* parent);

  /// Opens a path, `demo` or `demo:<scene>` in addition to the open light fields, with its
  /// remembered conventions; shows it if it is open already. Calls `then` on success. Calls
  /// `otherwise` with a sentence on failure, and without one after `isCollection`. Calls neither if
  /// cancelled or superseded. Does not open projects: see `isProject`.
  void open(const QString& input, std::function<void()> then = nullptr,
            std::function<void(const QString&)> otherwise = nullptr);
  /// Reads the open input, or the one that failed to open, from disk again.
  void reopen();
  /// Reads the open input, or the one that failed, again with the given options. Remembers them for
  /// that file on success.
  void reopenWith(const ParameterSet& given);
  /// As `reopenWith`, but always for the open light field.
  void reopenShownWith(const ParameterSet& given);
  /// Reads the open light field again at another focus plane (0: the plane of the files). Calls
  /// `then` on success.
  void reopenAt(double focus_px, std::function<void()> then);
  /// Reads another frame of the open sequence. Calls `then` on success.
  void reopenFrame(int frame, std::function<void()> then);
  /// Input that `reopenWith` would read; empty if there is none, or for a built-in scene.
  [[nodiscard]] QString reopenable() const;
  /// Whether the last requested input could not be read.
  [[nodiscard]] bool hasFailed() const { return !failed_input_.isEmpty(); }
  /// Name of the input that is being read; empty if there is none.
  [[nodiscard]] QString loading() const { return loading_job_ == 0 ? QString() : loading_name_; }
  /// Closes the shown light field and shows another open one.
  void close();

  /// Folder of built-in scenes and of facts about collections; empty = nowhere.
  [[nodiscard]] const std::filesystem::path& cacheFolder() const { return cache_folder_; }
  /// For tests.
  void setCacheFolder(const std::filesystem::path& folder);

 signals:
  /// A load began or ended; `reopenable` may have changed.
  void changed();
  /// The session has a requested light field; paths are absolute.
  void opened(const QString& input);
  /// The requested folder is no light field but contains some.
  void isCollection(const QString& folder);
  /// The requested path is a project file. `then` (may be null) is to be called once it is open.
  void isProject(const QString& path, const std::function<void()>& then);
  /// An input could not be opened; `sentence` is for the user.
  void failed(const QString& sentence);
  /// This input was opened after all, or its failure is shown elsewhere.
  void failureIsOver(const QString& sentence);

 private:
  struct Load {
    QString input;
    ParameterSet given;
    bool is_remembered = false;  ///< Skips conventions that no longer fit.
    std::function<void()> then{};
    std::function<void(const QString&)> otherwise{};
    bool keeps_results = false;  ///< `then` brings them back.
    bool is_added = false;       ///< In addition to the open scenes.
  };

  void readAs(const QString& input, const ParameterSet& given, bool is_added);
  void load(const Load& load);
  void leave(const Load& load, const std::function<void()>& go_on);
  void start(const Load& load);
  [[nodiscard]] LoadOptions loadOptions(quint64 number, const ParameterSet& given);
  void showLoading(quint64 job, double fraction);
  void finish(const Load& load, const std::shared_ptr<const Scene>& scene);
  void end(quint64 number, const Load& load);
  void tellFailure(const Load& load);
  void ask(const Load& load, const io::Undecided& question);
  void keepBuiltin(const QString& input);

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
  QHash<QString, QString> told_failures_;  // by inputs
  QString failed_input_;                   // asked for last, and not to be read
};

/// Whether this opens a built-in scene.
[[nodiscard]] bool is_builtin(const QString& input);

/// Reading options (io::open_schema) that the user set for this file or folder; none if all are
/// automatic. `path` is absolute.
[[nodiscard]] ParameterSet remembered_conventions(const QString& path);

/// Keeps the options for later opens; without any, forgets the file.
void remember_conventions(const QString& path, const ParameterSet& given);

}  // namespace episcope
