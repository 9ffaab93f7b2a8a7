// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/render/shade.h"
#include "widgets/cloud/cloud_look.h"

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

/// What is drawn over the clouds of a scene, whatever lies in front: crosses at points, named
/// marks, and the colour bar.
class CloudMarks {
 public:
  /// `renderer` must outlive this.
  explicit CloudMarks(vtkRenderer& renderer);
  ~CloudMarks();
  CloudMarks(const CloudMarks&) = delete;
  CloudMarks& operator=(const CloudMarks&) = delete;

  /// A cross at each of these places.
  void setCrosses(const std::vector<std::array<double, 3>>& places);
  /// A small cross with its name at each of these, those emphasised in the colour of the
  /// cross-hair.
  void setNamed(const std::vector<CloudMark>& marks);
  /// The colour bar; an empty title takes it away.
  void setLegend(const QString& title, const render::Shading& shading);
  /// Sizes follow it: device pixels per logical one, and the height of the view.
  void setScale(double ratio, int height);

 private:
  struct Named;
  void addCross();

  vtkRenderer& renderer_;
  double ratio_ = 1;
  std::vector<std::unique_ptr<vtkNew<vtkActor2D>>> crosses_;
  std::vector<std::unique_ptr<Named>> named_;
  vtkNew<vtkLookupTable> colors_;
  vtkNew<vtkScalarBarActor> bar_;
};

}  // namespace episcope
