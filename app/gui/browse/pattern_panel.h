// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/frame/jobs.h"
#include "engine/io/grid/pattern_preview.h"

#include <QWidget>

class QLabel;
class QTreeWidget;

namespace episcope {

/// Shows what a pattern for file names makes of a folder of images: how many match, which grid
/// comes of it, and row and column of each file.
class PatternPanel : public QWidget {
  Q_OBJECT

 public:
  /// `folder` or an image in it.
  PatternPanel(const QString& path, QWidget* parent);

  /// Looks at the folder in the background; only the newest request is shown.
  void preview(const std::string& pattern, bool is_snake);

 private:
  void fill(const io::PatternPreview& preview);

  QString folder_;
  QLabel* summary_;
  QTreeWidget* names_;
  LatestJob job_;
};

}  // namespace episcope
