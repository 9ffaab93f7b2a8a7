// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/render/shade.h"

#include <vtkNew.h>

#include <QString>

#include <array>
#include <memory>
#include <vector>

class vtkActor2D;
class vtkLookupTable;
class vtkRenderer;
class vtkScalarBarActor;

namespace episcope {

/// What is drawn over the clouds of a scene, whatever lies in front: crosses at points, and the
/// colour bar.
class CloudMarks {
 public:
  /// `renderer` must outlive this.
  explicit CloudMarks(vtkRenderer& renderer);
  ~CloudMarks();
  CloudMarks(const CloudMarks&) = delete;
  CloudMarks& operator=(const CloudMarks&) = delete;

  /// A cross at each of these places.
  void setCrosses(const std::vector<std::array<double, 3>>& places);
  /// The colour bar; an empty title takes it away.
  void setLegend(const QString& title, const render::Shading& shading);
  /// Sizes follow it: device pixels per logical one, and the height of the view.
  void setScale(double ratio, int height);

 private:
  void addCross();

  vtkRenderer& renderer_;
  double ratio_ = 1;
  std::vector<std::unique_ptr<vtkNew<vtkActor2D>>> crosses_;
  vtkNew<vtkLookupTable> colors_;
  vtkNew<vtkScalarBarActor> bar_;
};

}  // namespace episcope
