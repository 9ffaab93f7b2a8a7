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

/// From photographs of a pattern to a camera, and from the photographs that are open to a light
/// field whose rows and columns are aligned.
class Photographs : public QObject {
  Q_OBJECT

 public:
  Photographs(const Workbench& bench, CaptureDocuments& documents, QObject* parent);

  /// Shows the state there from now on, and does what is asked for there.
  void attach(PhotographSteps* steps);

  void calibrate(const QStringList& photographs, const capture::Pattern& pattern);
  /// Begins with the mesh of the demo, its picks and the step of its gantry, and calibrates.
  void beginGantry(const GantryFolder& demo);
  void openCamera(const QString& path);
  void saveCamera(const QString& path);
  /// Writes the light field of what is open, and opens it; the work goes on there.
  void rectify(const QString& path);
  /// Writes photographs of a gantry, of a pattern and a mesh into a new folder in `folder`,
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
