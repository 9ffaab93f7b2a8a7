// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"

#include <QObject>

namespace episcope {

class MethodPanel;

/// Tells the form of the methods which disparity range the files promise and which one is found
/// from the images. The range is searched in the background where nothing else tells it, once a run
/// has searched it, or once the form asks to find it; the focus plane uses it as well.
class MethodRange : public QObject {
  Q_OBJECT

 public:
  MethodRange(const Workbench& bench, MethodPanel& panel);

 private:
  void showHints();
  /// Searches the range if it is worth it now and not known yet.
  void search();
  [[nodiscard]] bool isWanted() const;

  Workbench bench_;
  MethodPanel& panel_;
  LatestJob job_;
  std::uint64_t searched_ = 0;  // the scene that the job is or was of
};

}  // namespace episcope
