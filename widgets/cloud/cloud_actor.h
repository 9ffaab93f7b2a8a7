// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class vtkActor2D;
class vtkActor;
class vtkLookupTable;
class vtkPlaneCollection;
class vtkPolyData;
class vtkPolyDataMapper;
class vtkRenderer;
class vtkScalarBarActor;
#include "engine/core/point_cloud.h"
#include "engine/render/shade.h"

#include <vtkNew.h>
#include <QString>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace episcope {

/// Clouds of one scene, shared with their creator.
using CloudParts = std::vector<CloudPart>;
using CloudPartsPtr = std::shared_ptr<const CloudParts>;

/// A picked point of a part.
struct PickedPoint {
  std::size_t part = 0;
  std::size_t point = 0;
};

/// A named mark among the clouds, in their coordinates; never hidden.
struct CloudMark {
  std::array<double, 3> at{};
  std::string name{};
  bool is_emphasised = false;
  friend bool operator==(const CloudMark&, const CloudMark&) = default;
};

/// How clouds are drawn.
struct CloudLook {
  double z_stretch = 1;    ///< Factor on z, > 0.
  double point_size = 2;   ///< Logical pixels.
  bool is_shaded = false;  ///< Surfaces are lit from the viewer.
  /// Visible range as fractions of the scene's depth: 0 = nearest, 1 = farthest. The defaults clip
  /// nothing.
  double clip_near = 0;
  double clip_far = 1;
  friend bool operator==(const CloudLook&, const CloudLook&) = default;
};

enum class CloudColoring { Image, Disparity, Error, Labels, Distance, Source };

/// What is shown together with the result.
enum class CloudCompanion { None, Truth, Other };

/// The user's choice in the 3D view.
struct CloudChoice {
  CloudColoring coloring = CloudColoring::Image;
  CloudCompanion companion = CloudCompanion::None;
  bool is_beside = false;   ///< Both side by side; else at their places.
  bool is_surface = false;  ///< Joined to a surface; else points.
  double jump_px = 0.1;     ///< Where the surface is cut: px of disparity per pixel.
  friend bool operator==(const CloudChoice&, const CloudChoice&) = default;
};

/// Surface for the 3D view, lit from the viewer. Vertex i is position i with y and z negated, since
/// a mesh has y downwards and z forwards, like images. Faces are three vertex indices. Linear.
[[nodiscard]] PointCloud make_mesh_cloud(std::span<const std::array<float, 3>> vertices,
                                         std::span<const std::array<std::uint32_t, 3>> faces);

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

/// Marks drawn over the clouds of a scene, never hidden: crosses, named marks and the color bar.
class CloudMarks {
 public:
  /// `renderer` must outlive this.
  explicit CloudMarks(vtkRenderer& renderer);
  ~CloudMarks();
  CloudMarks(const CloudMarks&) = delete;
  CloudMarks& operator=(const CloudMarks&) = delete;

  /// Draws a cross at each place.
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
