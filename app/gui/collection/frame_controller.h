// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "widgets/canvas/canvas_transform.h"

#include <QObject>
#include <QTimer>

#include <optional>

namespace episcope {

class TimeBar;

/// The slider of time: opens the frames of a sequence, and keeps view, cross-hair and zoom.
class FrameController : public QObject {
  Q_OBJECT

 public:
  explicit FrameController(const Workbench& bench);

 private:
  void addCommands();
  void show();
  void open(int frame);
  void step(int step);
  void setPlaying(bool is_playing);
  [[nodiscard]] bool isSequence() const;

  Workbench bench_;
  TimeBar* bar_;
  QTimer timer_;
  int wanted_ = -1;  // the frame that is loading; -1 = none
  bool is_playing_ = false;
  std::optional<CanvasTransform> kept_zoom_;  // For the frame that comes.
};

}  // namespace episcope
