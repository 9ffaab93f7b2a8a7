// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/document/document_controller.h"
#include "app/gui/frame/frame.h"
#include "app/gui/frame/jobs.h"
#include "app/session/session.h"

#include <QObject>
#include <QPointer>
#include <QString>

#include <filesystem>
#include <functional>

class QMessageBox;

namespace episcope {

/// Saves, exports and imports scribbles in the background, and sees to it that nobody loses any by
/// leaving the light field. Files and pictures keep to the views as they are stored, also at a
/// focus plane (shear.h).
class AnnotationFiles : public QObject {
  Q_OBJECT

 public:
  AnnotationFiles(Session& session, Jobs& jobs, DocumentController& document, const Panels& panels,
                  QObject* parent);

  /// Where `save` writes: where it was saved last, else beside the light field; empty if neither is
  /// known or can be written, then `save` asks.
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
  /// Compares the segmentation with GT_LABELS of another file.
  void compareDialog();
  void compareWith(const QString& path);
  /// Calls `go_on` at once if nothing is unsaved; else asks whether to save or to discard first. It
  /// is never called if the user stays or saving fails.
  void leave(std::function<void()> go_on);

 signals:
  void written(const QString& path);
  void imported(const QString& path);
  void compared(const QString& path);
  void hint(const QString& sentence);

 private:
  void showState();
  void saveTo(const QString& path, std::function<void()> then);
  /// As `save`, then calls `then` on success.
  void saveAndThen(std::function<void()> then);
  void askForPlace(std::function<void()> then);
  [[nodiscard]] std::function<Scribbles()> snapshot();
  [[nodiscard]] QString suggestion() const;

  Session& session_;
  Jobs& jobs_;
  DocumentController& document_;
  Panels panels_;
  std::filesystem::path place_;  // where it was saved last
  int saving_ = 0;
  QPointer<QMessageBox> question_;
};

}  // namespace episcope
