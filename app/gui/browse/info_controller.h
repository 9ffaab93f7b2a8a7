// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "engine/cuda/device.h"

#include <QObject>

#include <functional>
#include <optional>

class QAction;

namespace episcope {

class InfoPanel;

/// Shows facts of the open light field, and the conventions found and how they were checked. The
/// user can override them.
class InfoController : public QObject {
  Q_OBJECT

 public:
  explicit InfoController(const Workbench& bench);

  /// Replaces the query for the GPU, for tests. The query runs on a worker.
  void setGpuQuestion(std::function<CudaDevice()> question) { question_ = std::move(question); }

 private:
  void show();
  void askForGpu();
  void askForConventions();
  [[nodiscard]] bool canReverseSign() const;
  void reverseSign();

  Workbench bench_;
  InfoPanel* panel_;
  QAction* conventions_ = nullptr;
  QAction* reverse_ = nullptr;
  std::function<CudaDevice()> question_ = cuda_device;
  LatestJob gpu_job_;
  std::optional<CudaDevice> gpu_;  // as it was when it was asked for last
};

}  // namespace episcope
