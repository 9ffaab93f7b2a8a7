// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "app/session/capture/rectify_photographs.h"
#include "app/session/scene/gantry_scene.h"
#include "engine/capture/calibrate/calibrate.h"
#include "engine/capture/demo/demo_scene.h"

#include <QObject>
#include <QString>
#include <QStringList>

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace episcope {

class PhotographSteps;

/// From photographs of a pattern to a camera, and from the photographs that are open to a light
/// field whose rows and columns are aligned.
class Photographs : public QObject {
  Q_OBJECT

 public:
  /// `picks`: in the centre view of the photographs that are shown.
  Photographs(const Workbench& bench, std::function<std::vector<capture::PointPair>()> picks,
              QObject* parent);

  /// Shows the state there from now on, and does what is asked for there.
  void attach(PhotographSteps* steps);

  void calibrate(const QStringList& photographs, const capture::Pattern& pattern);
  /// The lens of the demo from its photographs, and the step of its gantry.
  void calibrateGantry(const GantryFolder& demo);
  void openCamera(const QString& path);
  void saveCamera(const QString& path);
  /// Writes the light field of what is open, and opens it.
  void rectify(const QString& path, const capture::RectifyOptions& options);
  /// Writes photographs of a gantry, of a pattern and a mesh into a new folder in `folder`,
  /// calibrates, and opens the photographs.
  void makeDemo(const QString& folder, const capture::DemoOptions& options = {});

  [[nodiscard]] const std::optional<capture::LensCamera>& camera() const { return camera_; }

 signals:
  /// The rectified light field is shown.
  void rectified(const std::vector<capture::PointPair>& pairs);
  /// The photographs of the demo are shown.
  void demoOpened(const QString& mesh, const QString& picks);

 private:
  void askForPattern();
  void askForRectified();
  void take(const capture::Calibration& calibration);
  void take(const capture::LensCamera& camera, const QString& details);
  void show();
  [[nodiscard]] bool canRectify() const;

  Workbench bench_;
  std::function<std::vector<capture::PointPair>()> picks_;
  PhotographSteps* steps_ = nullptr;
  std::optional<capture::LensCamera> camera_;
  QString camera_details_;
  capture::Pattern pattern_;
  capture::RectifyOptions options_;
  std::map<std::uint64_t, QString> alignments_;  // of light fields made here
};

}  // namespace episcope
