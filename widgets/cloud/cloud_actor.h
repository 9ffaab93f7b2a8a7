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

/// One cloud in a VTK scene, drawn with all its points or with few. VTK's arrays refer to the cloud
/// without a copy.
class CloudActor {
 public:
  /// `part` and `renderer` must outlive this.
  CloudActor(const CloudPart& part, vtkRenderer& renderer);
  ~CloudActor();
  CloudActor(const CloudActor&) = delete;
  CloudActor& operator=(const CloudActor&) = delete;

  /// Draws few points, for speed, or all.
  void drawFew(bool few);
  void setPointSize(double device_pixels);
  /// Lights surfaces from the viewer; else shows plain colors.
  void setShaded(bool is_shaded);
  /// Scales z by a factor around a point.
  void setStretch(double factor, const std::array<double, 3>& around);
  /// Clips the cloud at these planes.
  void setClip(vtkPlaneCollection& planes);

  [[nodiscard]] const PointCloud& cloud() const { return part_.all; }
  /// Points for searches.
  [[nodiscard]] vtkPolyData& points() const { return *all_.data.Get(); }

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

/// Marks drawn over the clouds of a scene, never hidden: crosses, named marks and the color bar.
class CloudMarks {
 public:
  /// `renderer` must outlive this.
  explicit CloudMarks(vtkRenderer& renderer);
  ~CloudMarks();
  CloudMarks(const CloudMarks&) = delete;
  CloudMarks& operator=(const CloudMarks&) = delete;

  void setCrosses(const std::vector<std::array<double, 3>>& places);
  /// Draws a small named cross at each mark; emphasized ones in the color of the cross-hair.
  void setNamed(const std::vector<CloudMark>& marks);
  /// Shows the color bar; an empty title removes it.
  void setLegend(const QString& title, const render::Shading& shading);
  /// Scales marks: device pixels per logical pixel, and height of the view.
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
