// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/cloud/cloud_actor.h"

#include "widgets/controls/theme.h"

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCoordinate.h>
#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkPlaneCollection.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace episcope {
namespace {

constexpr double kActorAmbient = 0.35;
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
  actor_->GetProperty()->SetAmbient(kActorAmbient);
  actor_->GetProperty()->SetDiffuse(1 - kActorAmbient);
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

namespace {

// Logical pixels.
constexpr double kCrossGap = 4;
constexpr double kArm = 13;
constexpr double kSmallGap = 2;
constexpr double kSmallArm = 6;
constexpr int kTextSize = 10;  // points
constexpr int kBarWidth = 90;
constexpr int kScaleHeight = 260;

// Two lines across, open in the middle, where the point is.
vtkNew<vtkPolyData> cross_lines(double gap, double arm) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  for (const auto& [x, y] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    const vtkIdType from = points->InsertNextPoint(x * gap, y * gap, 0);
    const vtkIdType to = points->InsertNextPoint(x * arm, y * arm, 0);
    lines->InsertNextCell({from, to});
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  return data;
}

void style_text(vtkTextProperty& text, double ratio) {
  const QColor color = theme::kCanvasText;
  text.SetColor(color.redF(), color.greenF(), color.blueF());
  text.SetFontSize(static_cast<int>(std::lround(kTextSize * ratio)));
  text.SetFontFamilyToArial();
  text.ItalicOff();
  text.BoldOff();
  text.ShadowOff();
}

}  // namespace

// A cross and a text beside it.
struct CloudMarks::Named {
  Named(const CloudMark& mark, double ratio, vtkRenderer& of) : renderer(of) {
    const QColor color = mark.is_emphasised ? theme::kCrossHair : theme::kEstimate;
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(cross_lines(kSmallGap * ratio, kSmallArm * ratio));
    lines->SetMapper(mapper);
    lines->GetProperty()->SetColor(color.redF(), color.greenF(), color.blueF());
    lines->GetProperty()->SetLineWidth(static_cast<float>((mark.is_emphasised ? 3 : 2) * ratio));
    text->SetInput((" " + mark.name).c_str());
    style_text(*text->GetTextProperty(), ratio);
    text->GetTextProperty()->SetColor(color.redF(), color.greenF(), color.blueF());
    text->GetTextProperty()->ShadowOn();
    text->GetTextProperty()->SetBold(mark.is_emphasised);
    const auto& [x, y, z] = mark.at;
    for (vtkActor2D* actor : {lines.Get(), static_cast<vtkActor2D*>(text.Get())}) {
      actor->GetPositionCoordinate()->SetCoordinateSystemToWorld();
      actor->GetPositionCoordinate()->SetValue(x, y, z);
      renderer.AddActor2D(actor);
    }
  }
  ~Named() {
    renderer.RemoveActor2D(lines);
    renderer.RemoveActor2D(text);
  }
  Named(const Named&) = delete;
  Named& operator=(const Named&) = delete;

  vtkRenderer& renderer;
  vtkNew<vtkActor2D> lines;
  vtkNew<vtkTextActor> text;
};

CloudMarks::CloudMarks(vtkRenderer& renderer) : renderer_(renderer) {
  bar_->SetLookupTable(colors_);
  bar_->UnconstrainedFontSizeOn();
  bar_->SetNumberOfLabels(5);
  bar_->SetMaximumNumberOfColors(256);
  bar_->SetLabelFormat("%.3g");
  bar_->SetBarRatio(0.25);
  bar_->VisibilityOff();
  renderer_.AddActor2D(bar_);
}

CloudMarks::~CloudMarks() {
  setCrosses({});
  renderer_.RemoveActor2D(bar_);
}

void CloudMarks::addCross() {
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(cross_lines(kCrossGap * ratio_, kArm * ratio_));
  auto actor = std::make_unique<vtkNew<vtkActor2D>>();
  (*actor)->SetMapper(mapper);
  (*actor)->GetPositionCoordinate()->SetCoordinateSystemToWorld();
  const QColor color = theme::kCrossHair;
  (*actor)->GetProperty()->SetColor(color.redF(), color.greenF(), color.blueF());
  (*actor)->GetProperty()->SetLineWidth(static_cast<float>(2 * ratio_));
  renderer_.AddActor2D(*actor);
  crosses_.push_back(std::move(actor));
}

void CloudMarks::setCrosses(const std::vector<std::array<double, 3>>& places) {
  while (crosses_.size() > places.size()) {
    renderer_.RemoveActor2D(*crosses_.back());
    crosses_.pop_back();
  }
  while (crosses_.size() < places.size()) addCross();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& [x, y, z] = places[i];
    (*crosses_[i])->GetPositionCoordinate()->SetValue(x, y, z);
  }
}

void CloudMarks::setNamed(const std::vector<CloudMark>& marks) {
  named_.clear();
  for (const CloudMark& mark : marks) {
    named_.push_back(std::make_unique<Named>(mark, ratio_, renderer_));
  }
}

void CloudMarks::setLegend(const QString& title, const render::Shading& shading) {
  bar_->SetVisibility(!title.isEmpty());
  if (title.isEmpty()) return;
  const auto& colors = shading.map.colors;
  colors_->SetNumberOfTableValues(static_cast<vtkIdType>(colors.size()));
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const auto& [red, green, blue] = colors[i];
    colors_->SetTableValue(static_cast<vtkIdType>(i), red / 255.0, green / 255.0, blue / 255.0);
  }
  colors_->SetTableRange(shading.range.min, shading.range.max);
  bar_->SetTitle(QString(title).replace(" [", "\n[").toUtf8().constData());
}

void CloudMarks::setScale(double ratio, int height) {
  ratio_ = ratio;
  style_text(*bar_->GetTitleTextProperty(), ratio);
  style_text(*bar_->GetLabelTextProperty(), ratio);
  const double width = kBarWidth * ratio;
  const double tall = std::min(kScaleHeight * ratio, 0.8 * height);
  bar_->SetMaximumWidthInPixels(static_cast<int>(width));
  bar_->SetMaximumHeightInPixels(static_cast<int>(tall));
  bar_->GetPositionCoordinate()->SetCoordinateSystemToViewport();
  bar_->GetPositionCoordinate()->SetValue(8 * ratio, (height - tall) / 2);
  bar_->GetPosition2Coordinate()->SetCoordinateSystemToViewport();
  bar_->GetPosition2Coordinate()->SetReferenceCoordinate(nullptr);
  bar_->GetPosition2Coordinate()->SetValue(8 * ratio + width, (height + tall) / 2);
  for (const auto& actor : crosses_) {
    static_cast<vtkPolyDataMapper2D*>((*actor)->GetMapper())
        ->SetInputData(cross_lines(kCrossGap * ratio, kArm * ratio));
  }
}

}  // namespace episcope
