// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/space/point_cloud.h"

#include <vtkNew.h>

#include <array>

class vtkActor;
class vtkPlaneCollection;
class vtkPolyData;
class vtkPolyDataMapper;
class vtkRenderer;

namespace episcope {

/// One cloud in a scene of VTK, drawn with all its points or with few. The arrays of VTK are those
/// of the cloud, which is not copied.
class CloudActor {
 public:
  /// `part` and `renderer` must outlive this.
  CloudActor(const CloudPart& part, vtkRenderer& renderer);
  ~CloudActor();
  CloudActor(const CloudActor&) = delete;
  CloudActor& operator=(const CloudActor&) = delete;

  /// Draws few points instead of all.
  void drawFew(bool few);
  void setPointSize(double device_pixels);
  /// Lit from the viewer; else in the plain colours of the points.
  void setShaded(bool is_shaded);
  /// Factor on z around a point.
  void setStretch(double factor, const std::array<double, 3>& around);
  /// What is beyond one of these planes is not drawn.
  void setClip(vtkPlaneCollection& planes);

  [[nodiscard]] const PointCloud& cloud() const { return part_.all; }
  /// For searches in it.
  [[nodiscard]] vtkPolyData& points() const;

 private:
  struct Form {
    Form();
    ~Form();
    void show(const PointCloud& cloud);
    vtkNew<vtkPolyData> data;
    vtkNew<vtkPolyDataMapper> mapper;
  };

  const CloudPart& part_;
  vtkRenderer& renderer_;
  Form all_;
  Form few_;
  vtkNew<vtkActor> actor_;
};

}  // namespace episcope
