// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/canvas/canvas_tool.h"
#include "widgets/controls/labels.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QSlider>
#include <QString>
#include <QWidget>

class QAction;
class QComboBox;
class QFormLayout;
class QSpinBox;

namespace episcope {

/// Limit of a fill.
enum class FillBound { Likeness, Segmentation };

/// Buttons of the tools, sizes of brush and eraser, and limits of a fill. Setters never emit.
class BrushPanel : public QWidget {
  Q_OBJECT

 public:
  explicit BrushPanel(QWidget* parent = nullptr);

  /// Adds a button for an action, in order of the calls, with a gap before another group.
  void addAction(QAction* action) { add_action_button(buttons_, action); }
  void addGap() { buttons_->insertSpacing(buttons_->count() - 1, theme::kMargin); }
  void setBrushSize(double diameter_px) { setSize(brush_, diameter_px); }
  void setEraserSize(double diameter_px) { setSize(eraser_, diameter_px); }
  /// Keys that change the size, for the tool tips; empty without keys.
  void setSizeKeys(const QString& keys);
  void setProtectsOthers(bool protects) { Quietly(protects_)->setChecked(protects); }
  void setScribbleOpacity(double opacity) { Quietly(opacity_)->setValue(qRound(100 * opacity)); }
  /// In units of the noise of the view.
  void setFillTolerance(double tolerance) { Quietly(tolerance_)->setValue(tolerance); }
  /// Without a segmentation, only likeness can limit fills.
  void setSegmentationAvailable(bool is_available);

  [[nodiscard]] FillBound fillBound() const;
  [[nodiscard]] double fillTolerance() const { return tolerance_->value(); }
  [[nodiscard]] bool protectsOthers() const { return protects_->isChecked(); }
  [[nodiscard]] double scribbleOpacity() const { return opacity_->value() / 100.0; }

 signals:
  void brushSizeEdited(double diameter_px);
  void eraserSizeEdited(double diameter_px);
  void protectsOthersEdited(bool protects);
  void scribbleOpacityEdited(double opacity);

 private:
  struct SizeRow {
    QSlider* slider;
    QSpinBox* spin;
  };
  [[nodiscard]] SizeRow addSize(QFormLayout& form, const QString& name, const QString& text,
                                void (BrushPanel::*edited)(double));
  void setSize(const SizeRow& row, double diameter_px);
  void addFill(QFormLayout& form);

  QHBoxLayout* buttons_;
  SizeRow brush_{};
  SizeRow eraser_{};
  QCheckBox* protects_;
  QComboBox* bound_;
  QDoubleSpinBox* tolerance_;
  QSlider* opacity_;
};

/// Actions on all scribbles: carrying them to all views, saving, exporting, importing. Setters
/// never emit.
class AnnotationBar : public QWidget {
  Q_OBJECT

 public:
  /// Disparity used to carry scribbles.
  enum class CarriedBy { Estimate, Truth };

  explicit AnnotationBar(QWidget* parent = nullptr);

  /// Adds a button for an action, in order of the calls.
  void addAction(QAction* action) { add_action_button(buttons_, action); }
  /// Enables the available disparities.
  void setSources(bool has_estimate, bool has_truth);
  void setCarried(bool is_carried) { Quietly(carried_)->setChecked(is_carried); }
  /// State of carrying, e.g. "carrying …"; empty = none.
  void setCarryState(const QString& state);
  /// File name, and whether the file is up to date.
  void setFileState(const QString& state) { file_state_->setFullText(state); }

  [[nodiscard]] bool isCarried() const { return carried_->isChecked(); }
  [[nodiscard]] CarriedBy carriedBy() const;

 signals:
  void carriedEdited(bool is_carried);
  void carriedByEdited();

 private:
  QCheckBox* carried_;
  QComboBox* by_;
  ElidedLabel* carry_state_;
  ElidedLabel* file_state_;
  QHBoxLayout* buttons_;
  bool is_chosen_ = false;  // by the user; until then the estimate goes before the truth
};

}  // namespace episcope
