// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/render/shade.h"
#include "widgets/cloud/point_cloud.h"
#include "widgets/cloud/point_cloud_view.h"

#include <QWidget>

class QComboBox;
class QHBoxLayout;
class QLabel;
class QSlider;
class QStackedLayout;

namespace episcope {

class ColorRamp;

enum class CloudColoring { Image, Disparity, Error };

/// The 3D tab: the point cloud view, or the reason why there is none, with its controls.
class PointCloudPanel : public QWidget {
  Q_OBJECT

 public:
  explicit PointCloudPanel(QWidget* parent = nullptr);

  /// An empty cloud shows `hint` instead.
  void setCloud(const PointCloud& cloud, const QString& hint = {});
  /// Colour map and range of the points, drawn below them. An empty title takes it away: the points
  /// have the colours of the image.
  void setLegend(const QString& title, const render::Shading& shading = {});
  void setColoring(CloudColoring coloring);
  /// Whether errors can be chosen as colours: there is truth.
  void setErrorAvailable(bool available);

  [[nodiscard]] CloudColoring coloring() const;
  /// Whether a 3D view exists; if not, making clouds is wasted work.
  [[nodiscard]] bool isAvailable() const { return view_ != nullptr; }

 signals:
  /// The host should give a cloud of these colours.
  void coloringSelected(episcope::CloudColoring coloring);
  /// A click on a point that is from this pixel.
  void pixelPicked(episcope::PixelIndex pixel);

 private:
  QHBoxLayout* makePresets();
  QHBoxLayout* makeStretch();
  QWidget* makeLegend();

  QComboBox* coloring_;
  QSlider* stretch_;
  QLabel* count_;
  QLabel* hint_;
  QWidget* legend_;
  QLabel* legend_title_;
  QLabel* legend_min_;
  QLabel* legend_max_;
  ColorRamp* ramp_;
  QStackedLayout* stack_;
  PointCloudView* view_ = nullptr;
  std::vector<PixelIndex> pixels_;  // of the points
};

}  // namespace episcope
