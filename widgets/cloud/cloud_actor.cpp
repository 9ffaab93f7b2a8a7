// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/cloud/cloud_actor.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPlaneCollection.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include <cstdint>
#include <numeric>
#include <vector>

namespace episcope {
namespace {

constexpr double kAmbient = 0.35;
constexpr int kBorrowed = 1;  // VTK's word for an array that it must not free

/// Rows of numbers as an array of VTK, which only reads them.
template <class Array, class Number, std::size_t size>
vtkNew<Array> borrowed(const std::vector<std::array<Number, size>>& rows) {
  using Value = typename Array::ValueType;
  static_assert(sizeof(Number) == sizeof(Value));
  vtkNew<Array> array;
  array->SetNumberOfComponents(static_cast<int>(size));
  if (!rows.empty()) {
    auto* first = reinterpret_cast<Value*>(const_cast<Number*>(rows.front().data()));
    array->SetArray(first, static_cast<vtkIdType>(size * rows.size()), kBorrowed);
  }
  return array;
}

// One cell of all points.
vtkNew<vtkCellArray> all_points(vtkIdType count) {
  vtkNew<vtkTypeInt32Array> points;
  points->SetNumberOfValues(count);
  std::iota(points->GetPointer(0), points->GetPointer(0) + count, 0);
  vtkNew<vtkCellArray> cells;
  cells->SetData(count, points);
  return cells;
}

vtkNew<vtkCellArray> cells_of(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  auto corners = borrowed<vtkTypeInt32Array>(triangles);
  corners->SetNumberOfComponents(1);
  vtkNew<vtkCellArray> cells;
  cells->SetData(3, corners);
  return cells;
}

}  // namespace

CloudActor::Form::Form() {
  mapper->SetInputData(data);
  mapper->SetScalarModeToUsePointData();
  mapper->SetColorModeToDirectScalars();
}

CloudActor::Form::~Form() = default;

void CloudActor::Form::show(const PointCloud& cloud) {
  const auto count = static_cast<vtkIdType>(cloud.positions.size());
  vtkNew<vtkPoints> positions;
  positions->SetData(borrowed<vtkFloatArray>(cloud.positions));
  data->SetPoints(positions);
  if (!cloud.triangles.empty()) {
    data->SetPolys(cells_of(cloud.triangles));
  } else if (count > 0) {
    data->SetVerts(all_points(count));
  }
  data->GetPointData()->SetScalars(borrowed<vtkUnsignedCharArray>(cloud.colors));
}

CloudActor::CloudActor(const CloudPart& part, vtkRenderer& renderer)
    : part_(part), renderer_(renderer) {
  all_.show(part.all);
  few_.show(part.few);
  actor_->SetMapper(all_.mapper);
  actor_->GetProperty()->SetAmbient(kAmbient);
  actor_->GetProperty()->SetDiffuse(1 - kAmbient);
  setShaded(false);
  renderer_.AddActor(actor_);
}

CloudActor::~CloudActor() {
  renderer_.RemoveActor(actor_);
}

void CloudActor::drawFew(bool few) {
  actor_->SetMapper(few && !part_.few.positions.empty() ? few_.mapper : all_.mapper);
}

void CloudActor::setPointSize(double device_pixels) {
  actor_->GetProperty()->SetPointSize(static_cast<float>(device_pixels));
}

void CloudActor::setShaded(bool is_shaded) {
  actor_->GetProperty()->SetLighting(is_shaded && !part_.all.triangles.empty());
}

void CloudActor::setStretch(double factor, const std::array<double, 3>& around) {
  actor_->SetOrigin(around.data());
  actor_->SetScale(1, 1, factor);
}

void CloudActor::setClip(vtkPlaneCollection& planes) {
  for (auto* mapper : {all_.mapper.Get(), few_.mapper.Get()}) mapper->SetClippingPlanes(&planes);
}

vtkPolyData& CloudActor::points() const {
  return *all_.data.Get();
}

}  // namespace episcope
