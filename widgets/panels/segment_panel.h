// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/number_spin.h"
#include "widgets/controls/parameter_form.h"
#include "widgets/controls/tool_button.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QString>
#include <QWidget>

#include <vector>

class QAction;
class QScrollArea;
class QToolButton;

namespace episcope {

/// Meaning of the state chip's color.
enum class ChipMood { Quiet, Busy, Stale, Hint, Failed };

/// The segmentation learnt from scribbles: state and quality, action buttons, and settings folded
/// away. Setters never emit.
class SegmentPanel : public QWidget {
  Q_OBJECT

 public:
  /// An available disparity.
  struct Source {
    int id = 0;
    QString name;
    bool is_available = true;
  };

  explicit SegmentPanel(QWidget* parent = nullptr);

  /// Adds buttons for actions in order of the calls: computing above, display below.
  void addAction(QAction* action) { add_action_button(actions_, action); }
  void addOverlay(QAction* action) { add_action_button(overlays_, action); }
  /// "refining …", "idle · 2.1 s"; `detail` is its tool tip.
  void setState(const QString& text, ChipMood mood, const QString& detail);
  /// Sentence on what is missing or was found; empty = none.
  void setNote(const QString& sentence) { note_->setText(sentence); }
  void setParameters(const std::vector<ParameterDescription>& parameters);
  void setSources(const std::vector<Source>& sources, int current);
  void setSettingsVisible(bool are_visible);
  void setSmoothing(double smoothing_px) { Quietly(smoothing_)->setValue(smoothing_px); }

  [[nodiscard]] ParameterSet parameters() const { return form_->values(); }
  /// Id of the chosen disparity.
  [[nodiscard]] int source() const { return source_->currentData().toInt(); }
  /// Whether strokes change the labels of all views.
  [[nodiscard]] bool keepsAllViews() const { return all_views_->isChecked(); }
  void setKeepsAllViews(bool keeps) { Quietly(all_views_)->setChecked(keeps); }
  [[nodiscard]] QString state() const { return chip_->text(); }
  [[nodiscard]] QString note() const { return note_->text(); }

 signals:
  void parametersEdited();
  void sourceEdited();
  void keepsAllViewsEdited();
  void smoothingEdited(double smoothing_px);

 private:
  QWidget* makeSettings();
  QLayout* makeSmoothing();
  void showMood();

  QLabel* chip_;
  ChipMood mood_ = ChipMood::Quiet;
  QHBoxLayout* actions_;
  QHBoxLayout* overlays_;
  QLabel* note_;
  QToolButton* fold_;
  QScrollArea* settings_;
  QComboBox* source_;
  QCheckBox* all_views_;
  NumberSpin* smoothing_;
  ParameterForm* form_;
};

}  // namespace episcope
