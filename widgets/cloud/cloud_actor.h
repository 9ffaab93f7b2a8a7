// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/point_cloud.h"
#include "engine/render/shade.h"
#include "widgets/cloud/cloud_look.h"

#include <vtkNew.h>
#include <QString>

#include <array>
#include <memory>
#include <vector>

class vtkActor2D;
class vtkActor;
class vtkLookupTable;
class vtkPlaneCollection;
class vtkPolyData;
class vtkPolyDataMapper;
class vtkRenderer;
class vtkScalarBarActor;

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
