// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/scene/document_controller.h"
#include "app/gui/shell/workbench.h"
#include "app/session/known_files.h"
#include "app/session/session.h"

#include <QKeySequence>
#include <QList>
#include <QObject>
#include <QPointer>
#include <QString>

#include <filesystem>
#include <functional>
#include <set>

class QMessageBox;

namespace episcope {

class AnnotationBar;
class SegmentController;

/// Saves, exports and imports scribbles in the background, and ensures that none are lost by
/// leaving the light field. Files hold views as stored, also while a focus plane is applied
/// (shear.h).
class AnnotationFiles : public QObject {
  Q_OBJECT

 public:
  AnnotationFiles(const Workbench& bench, AnnotationBar* bar);

  /// Where `save` writes: where it wrote last, else beside the light field. Empty if neither is
  /// known and writable: then `save` asks.
  [[nodiscard]] QString place() const;
  void save();
  void saveAsDialog();
  void saveAs(const QString& path);
  /// A picture of each painted view into a folder.
  void exportDialog();
  void exportPictures(const QString& folder);
  void importDialog();
  /// From an HDF5 file of labels, or the folder of an exported picture.
  void importFrom(const QString& path);
  /// Compares the segmentation with the GT_LABELS of another file.
  void compareDialog();
  void compareWith(const QString& path);
  /// Calls `go_on` at once if nothing is unsaved; else asks whether to save or to discard first. It
  /// is never called if the user cancels or saving fails.
  void leave(std::function<void()> go_on);

 private:
  void addCommands();
  void addCommand(const QString& id, const QString& text, const QString& tip, const QString& icon,
                  const QList<QKeySequence>& keys, void (AnnotationFiles::*run)());
  void showState();
  /// Asks first if another program wrote the file meanwhile.
  void saveTo(const QString& path, std::function<void()> then);
  void write(const QString& path, std::function<void()> then);
  void reload(const QString& path);
  [[nodiscard]] bool hasChangedOnDisk(const QString& path) const;
  /// As `save`, then calls `then` on success.
  void saveAndThen(std::function<void()> then);
  void askForPlace(std::function<void()> then);
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

/// Asks where to write the segmentation of the current view or of all, as below.
void ask_to_export_segmentation(const Workbench& bench, const SegmentController& segment);

/// Writes labels and probabilities (.h5), or the labels of this view in their colours (.png), in
/// the background. The user is told if the path has another suffix.
void export_segmentation(const Workbench& bench, const SegmentController& segment,
                         const QString& path);

/// Asks for a folder and writes masks of every label there: of all views once they are segmented,
/// else of this one.
void ask_to_export_masks(const Workbench& bench, const SegmentController& segment);
void export_masks(const Workbench& bench, const SegmentController& segment, const QString& folder);

}  // namespace episcope
