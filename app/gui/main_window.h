// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/frame/frame.h"

#include <QMainWindow>

#include <memory>

class QMenu;

namespace episcope {

class ActionTable;
class AnnotateController;
class AnnotationFiles;
class BrowseController;
class CloudController;
class CommandPalette;
class CompareController;
class DocumentController;
class EstimateController;
class ExportController;
class FocusController;
class Jobs;
class MetricController;
class OpenController;
class OverlayController;
class RecoveryController;
class ScribbleController;
class SegmentController;
class Session;
class ShortcutWindow;
class StatisticsController;
class ValueController;

/// Joins the session, the panels and the controllers; does nothing itself.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  explicit MainWindow(QWidget* parent = nullptr);
  ~MainWindow() override;

  /// Opens a path or a built-in scene; a built-in one gets an estimate at once, so that there is
  /// something to see.
  void open(const QString& input);

  /// Offers what a session that died left behind.
  void offerRecovery();

  [[nodiscard]] Session& session() { return *session_; }
  [[nodiscard]] Jobs& jobs() { return *jobs_; }
  [[nodiscard]] const Panels& panels() const { return panels_; }
  [[nodiscard]] ActionTable& actions() { return *actions_; }
  [[nodiscard]] BrowseController& browse() { return *browse_; }
  [[nodiscard]] OverlayController& overlay() { return *overlay_; }
  [[nodiscard]] CompareController& compare() { return *compare_; }
  [[nodiscard]] StatisticsController& statistics() { return *statistics_; }
  [[nodiscard]] DocumentController& document() { return *document_; }
  [[nodiscard]] AnnotateController& annotate() { return *annotate_; }
  [[nodiscard]] ScribbleController& scribbles() { return *scribbles_; }
  [[nodiscard]] AnnotationFiles& annotationFiles() { return *annotation_files_; }
  [[nodiscard]] SegmentController& segment() { return *segment_; }
  [[nodiscard]] EstimateController& estimate() { return *estimate_; }
  [[nodiscard]] ExportController& exporter() { return *exporter_; }
  [[nodiscard]] OpenController& opener() { return *opener_; }
  [[nodiscard]] FocusController& focus() { return *focus_; }

  void showShortcuts();
  void showPalette();
  void showAbout();
  /// Ends what is in hand, else cancels the job begun last.
  void escape();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  void connectJobs();
  void connectControllers();
  void connectAnnotation();
  void connectFiles();
  void buildBars();
  void fillRecentMenu();
  void updateActions();
  void showInfo();
  void showInvitation();
  void showStatus();
  void restoreLayout();

  Panels panels_;
  std::vector<QWidget*> flippers_;  // where the key that flips to B is heard while it is held
  std::unique_ptr<Session> session_;
  Jobs* jobs_;
  BrowseController* browse_;
  OverlayController* overlay_;
  CompareController* compare_;
  StatisticsController* statistics_;
  ValueController* values_;
  DocumentController* document_;
  AnnotateController* annotate_;
  ScribbleController* scribbles_;
  AnnotationFiles* annotation_files_;
  RecoveryController* recovery_;
  SegmentController* segment_;
  EstimateController* estimate_;
  MetricController* metrics_;
  OpenController* opener_;
  FocusController* focus_;
  ExportController* exporter_;
  CloudController* cloud_;
  ActionTable* actions_;
  CommandPalette* palette_;
  ShortcutWindow* shortcuts_ = nullptr;
  QMenu* recent_menu_ = nullptr;
};

}  // namespace episcope
