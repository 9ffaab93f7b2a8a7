// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/frame/frame.h"
#include "app/gui/frame/jobs.h"
#include "app/gui/stage/overlay.h"
#include "app/session/session.h"

#include <QObject>

#include <functional>

namespace episcope {

/// Writes results and pictures in the background: result file, map, point cloud, picture on screen.
class ExportController : public QObject {
  Q_OBJECT

 public:
  ExportController(Session& session, Jobs& jobs, const OverlayController& overlay,
                   const Panels& panels, QObject* parent);

  /// Asks for a file; its suffix says the form: .h5 result, .pfm map and .ply cloud of this view.
  void exportResultDialog(int estimate);
  /// The shown result.
  void exportShownDialog();
  void savePictureDialog();
  void saveMapDialog();

  /// Asks where to write the segmentation: .h5, or .png of this view.
  void exportSegmentationDialog();

  /// Writes without asking. The suffix of `path` says the form; an unknown one is refused.
  void exportResult(int estimate, const QString& path);
  /// Labels and probabilities of what is segmented (.h5), or labels of this view in their colours.
  void exportSegmentation(const QString& path);
  /// The view with its overlay as shown, one image pixel a pixel.
  void savePicture(const QString& path);
  /// The map that is drawn over the view, by itself: as `episcope-cli show` writes it.
  void saveMap(const QString& path);

 signals:
  void hint(const QString& sentence);
  /// Nothing is written, and why.
  void refused(const QString& sentence);
  void written(const QString& path);

 private:
  void ask(const QString& title, const QString& name, const QString& filter,
           const std::function<void(const QString&)>& write);
  /// Whether the name ends as one of the forms does; else it is refused.
  [[nodiscard]] bool hasForm(const QString& path, const QStringList& suffixes);
  void startWriting(const QString& path, std::function<void(const Progress&)> write);
  struct DrawnMap {
    MapSource source;
    render::Shading shading;
  };
  /// What is drawn over the view; none if that is bare.
  [[nodiscard]] std::optional<DrawnMap> drawnMap() const;

  Session& session_;
  Jobs& jobs_;
  const OverlayController& overlay_;
  Panels panels_;
};

}  // namespace episcope
