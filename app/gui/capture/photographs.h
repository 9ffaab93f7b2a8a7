// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"
#include "app/session/gantry_scene.h"
#include "engine/capture/calibrate.h"
#include "engine/capture/demo_folder.h"

#include <QObject>
#include <QString>
#include <QStringList>

#include <cstdint>

namespace episcope {

class CaptureDocuments;
class PhotographSteps;

/// Calibrates a camera from photographs of a pattern, and rectifies open photographs into a light
/// field with aligned rows and columns.
class Photographs : public QObject {
  Q_OBJECT

 public:
  Photographs(const Workbench& bench, CaptureDocuments& documents, QObject* parent);

  /// Shows its state in these steps and obeys them.
  void attach(PhotographSteps* steps);

  void calibrate(const QStringList& photographs, const capture::Pattern& pattern);
  /// Loads mesh, picks and step of the demo's gantry, and calibrates.
  void beginGantry(const GantryFolder& demo);
  void openCamera(const QString& path);
  void saveCamera(const QString& path);
  /// Writes the rectified light field and opens it; the work continues there.
  void rectify(const QString& path);
  /// Writes photographs of a gantry and a pattern, and a mesh, into a new folder in `folder`;
  /// calibrates, and opens the photographs.
  void makeDemo(const QString& folder, const capture::DemoOptions& options = {});

 private:
  void askForPattern();
  void askForRectified();
  void take(const capture::Calibration& calibration, const capture::Pattern& pattern,
            std::uint64_t scene);
  void show();
  [[nodiscard]] bool canRectify() const;

  Workbench bench_;
  CaptureDocuments& documents_;
  PhotographSteps* steps_ = nullptr;
};

}  // namespace episcope
