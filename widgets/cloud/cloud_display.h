// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/cloud/point_cloud_view.h"

#include <QWidget>

class QLabel;
class QStackedLayout;

namespace episcope {

/// The 3D view, or a sentence on why nothing is seen in it. Can be moved to another window.
class CloudDisplay : public QWidget {
  Q_OBJECT

 public:
  explicit CloudDisplay(QWidget* parent = nullptr);

  /// Clouds without points show `hint` instead.
  void setParts(const CloudPartsPtr& parts, const QString& hint);
  /// Null where there is no display to draw on.
  [[nodiscard]] PointCloudView* view() const { return view_; }

 signals:
  /// It came on screen, or left it.
  void shown();
  void hidden();
  /// A click on a point that is from this pixel.
  void pixelPicked(episcope::PixelIndex pixel);

 protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  QLabel* hint_;
  QStackedLayout* stack_;
  PointCloudView* view_;
  CloudPartsPtr parts_;
};

}  // namespace episcope
