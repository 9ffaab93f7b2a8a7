// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/scene/document_controller.h"
#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/annotation_journal.h"
#include "app/session/session.h"
#include "app/session/user_folders.h"

#include <QKeySequence>
#include <QList>
#include <QObject>
#include <QPointer>
#include <QString>

#include <functional>
#include <optional>
#include <set>
#include <vector>

class QMessageBox;

namespace episcope {

class AnnotationBar;
class SegmentController;

/// Saves and exports scribbles in the background, and ensures that leaving the light field
/// loses none. Files hold views as stored, also while a focus plane is applied (shear.h).
class AnnotationFiles : public QObject {
  Q_OBJECT

 public:
  AnnotationFiles(const Workbench& bench, AnnotationBar* bar);

  /// Target of `save`: the last file written, else a file beside the light field. Empty if neither
  /// is known and writable; `save` asks then.
  [[nodiscard]] QString place() const;
  /// Writes nothing if nothing was painted or changed.
  void save();
  void saveAsDialog() { askForPlace(nullptr); }
  void saveAs(const QString& path) { saveTo(path, nullptr); }
  /// Writes a picture of each painted view into a folder.
  void exportDialog();
  void exportPictures(const QString& folder);
  /// Compares the segmentation with the GT_LABELS of another file.
  void compareDialog();
  void compareWith(const QString& path);
  /// Calls `go_on` at once if nothing is unsaved; else asks whether to save or to discard. Never
  /// calls it if the user cancels or saving fails.
  void leave(std::function<void()> go_on);

 private:
  void addCommands();
  void addCommand(const QString& id, const QString& text, const QString& tip, const QString& icon,
                  const QList<QKeySequence>& keys, void (AnnotationFiles::*run)());
  void showState();
  [[nodiscard]] bool hasStrokes() const;
  /// Asks first if another program has written the file since.
  void saveTo(const QString& path, std::function<void()> then);
  void write(const QString& path, std::function<void()> then);
  void reload(const QString& path);
  /// Saves, then calls `then` on success.
  void saveAndThen(std::function<void()> then);
  /// Why the file beside the light field is not the place, if there could be one.
  void tellReadOnly() const;
  void askForPlace(std::function<void()> then);
  /// Asks first if this is another file that exists.
  void saveToChosen(const QString& path, std::function<void()> then);
  [[nodiscard]] std::function<Scribbles()> snapshot();
  [[nodiscard]] QString suggestion() const;

  Workbench bench_;
  Session& session_;
  DocumentController& document_;
  AnnotationBar* bar_;
  KnownFiles known_;
  std::set<std::uint64_t> seen_;  // open scenes whose files were noted
  int saving_ = 0;
  QPointer<QMessageBox> question_;
};

/// Asks for a folder and writes masks of every label: for all views if they are segmented, else for
/// this view.
void ask_to_export_masks(const Workbench& bench, const SegmentController& segment);
void export_masks(const Workbench& bench, const SegmentController& segment, const QString& folder);
/// As `write_in_background`; warns of labels that were out of date. `written` may be null.
void write_labels_in_background(const Workbench& bench, const SegmentController& segment,
                                const QString& path, std::function<void(const Progress&)> write,
                                const std::function<void()>& written = nullptr);

}  // namespace episcope
