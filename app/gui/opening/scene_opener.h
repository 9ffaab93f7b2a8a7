// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/browse/browse_controller.h"
#include "app/gui/frame/frame.h"
#include "app/gui/frame/jobs.h"
#include "app/session/scene/load_scene.h"
#include "app/session/session.h"

#include <QObject>
#include <QStringList>

#include <filesystem>
#include <functional>
#include <memory>

namespace episcope {

/// Opens light fields and results in the background: dialogs, dropped files, recent files.
class OpenController : public QObject {
  Q_OBJECT

 public:
  OpenController(Session& session, Jobs& jobs, BrowseController& browse, const Panels& panels,
                 QObject* parent);

  /// Opens a path, `demo` or `demo:<scene>`. The centre view is shown as soon as it is read. What
  /// was open stays if this fails or is cancelled. `opened` is called after success.
  void open(const QString& input, std::function<void()> opened = nullptr);
  /// Adds a result file, or a map from elsewhere, to the results of the open light field.
  void openResult(const QString& path);
  /// Reads what is open, or what failed to open, again as the user chose. The choice is remembered
  /// for that file if it could be read.
  void reopenWith(const ParameterSet& given);
  /// Reads what is open again with another focus plane baked in (0: none). `opened` is called after
  /// success.
  void reopenAt(double focus_px, std::function<void()> opened);
  /// What `reopenWith` would read; empty if there is nothing, or a built-in scene.
  [[nodiscard]] QString reopenable() const;
  void conventionsDialog();
  void openFileDialog();
  void openFolderDialog();
  void openResultDialog();
  void closeScene();

  /// Asked before the open light field is left: it calls back once nothing is lost by that, or
  /// never.
  using Guard = std::function<void(std::function<void()> go_on)>;
  void setGuard(Guard guard) { guard_ = std::move(guard); }

  /// Opened before, newest first.
  [[nodiscard]] QStringList recentInputs() const;
  void forgetRecentInputs();
  /// Where built-in scenes are kept; for tests.
  void setCacheFolder(std::filesystem::path folder) { cache_folder_ = std::move(folder); }

 signals:
  void recentInputsChanged();
  void titleChanged(const QString& title);
  /// What `reopenWith` would read may be another one, or none.
  void reopenableChanged();
  void previewing(bool is_previewing);
  /// What was opened, and may not be what the user means.
  void warned(const QString& sentence);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void load(const QString& input, const ParameterSet& given, bool is_remembered,
            std::function<void()> opened);
  void startLoading(const QString& input, const ParameterSet& given, bool is_remembered,
                    std::function<void()> opened);
  [[nodiscard]] LoadOptions loadOptions(quint64 load, const ParameterSet& given);
  void beginLoading(const QString& name);
  void showLoading(quint64 job, double fraction);
  void finishOpening(const QString& input, const std::shared_ptr<const Scene>& scene);
  void endLoading(quint64 load, const QString& input);
  void keepBuiltin(const QString& input);
  void remember(const QString& input);

  Session& session_;
  Jobs& jobs_;
  BrowseController& browse_;
  Panels panels_;
  Guard guard_ = [](const std::function<void()>& go_on) { go_on(); };
  std::filesystem::path cache_folder_;
  quint64 load_ = 0;  // number of the newest load
  quint64 loading_job_ = 0;
  QString loading_name_;
  QString last_failure_;
  QString failed_input_;  // asked for last, and not to be read
};

}  // namespace episcope
