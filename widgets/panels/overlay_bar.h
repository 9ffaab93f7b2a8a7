// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/render/quantity.h"
#include "widgets/controls/labels.h"
#include "widgets/controls/number_spin.h"
#include "widgets/controls/tool_button.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QSlider>
#include <QString>
#include <QToolButton>
#include <QWidget>

#include <vector>

class QAction;

namespace episcope {

/// A row of controls for the tool bar: map, opacity and focus plane (shear). Setters never emit.
class OverlayBar : public QWidget {
  Q_OBJECT

 public:
  static constexpr double kFarthestFocus = 100;

  explicit OverlayBar(QWidget* parent = nullptr);

  /// Quantities to choose from, in order; Quantity::View, no map, need not be among them.
  void setAvailable(const std::vector<render::Quantity>& quantities);
  /// Ignored if it is not available.
  void setQuantity(render::Quantity quantity);
  void setOpacity(double opacity);
  /// Range of the focus slider, px per view step. The field beside it takes numbers up to
  /// kFarthestFocus and extends the slider.
  void setFocusRange(Interval range_px);
  void setFocus(double focus_px) { showFocus(focus_px); }
  /// Adds a button for an action on the look of the overlay, beside its opacity.
  void addOpacityAction(QAction* action);
  /// Adds a button for a focus plane action, beside its controls.
  void addFocusAction(QAction* action) { add_action_button(row_, action); }

  [[nodiscard]] render::Quantity quantity() const;
  [[nodiscard]] double opacity() const { return opacity_->value() / 100.0; }
  [[nodiscard]] double focus() const { return focus_spin_->value(); }

 public slots:
  /// Selects the next available quantity, like the user ("next metric map").
  void selectNextQuantity();
  /// Moves the focus plane by slider steps, like the user.
  void stepFocus(double steps) { changeFocus(focus() + steps * focus_spin_->singleStep()); }

 signals:
  void quantitySelected(episcope::render::Quantity quantity);
  void opacityChanged(double opacity);
  void focusChanged(double focus_px);

 private:
  void showFocus(double focus_px);
  void changeFocus(double focus_px);

  std::vector<render::Quantity> listed_;
  QComboBox* quantity_;
  QSlider* opacity_;
  QSlider* focus_slider_;
  NumberSpin* focus_spin_;
  QHBoxLayout* row_;
};

}  // namespace episcope

namespace episcope {

/// Chooses A (shown) and B (compared), with buttons for actions on both. Setters never emit.
class CompareBar : public QWidget {
  Q_OBJECT

 public:
  struct Choice {
    quint64 id = 0;
    QString name;
    QString warning{};  ///< The name then has a warning sign, and this is its tool tip.
  };

  explicit CompareBar(QWidget* parent = nullptr);

  /// Adds a button for a map to compare by, above the others.
  void addMap(QAction* action) { add_action_button(maps_, action); }
  /// Adds a button for an action, in order of the calls.
  void addAction(QAction* action) { add_action_button(buttons_, action); }
  /// Available results, with A and B; 0 = none: `other` then names what replaces B, e.g. "truth".
  void setChoices(const std::vector<Choice>& choices, quint64 a, quint64 b, const QString& other);

 signals:
  void aChosen(quint64 id);
  void bChosen(quint64 id);

 private:
  QComboBox* a_;
  QComboBox* b_;
  QHBoxLayout* maps_;
  QHBoxLayout* buttons_;
};

/// Region that metrics evaluate, and its number of pixels. Setters never emit.
class RegionBar : public QWidget {
  Q_OBJECT

 public:
  explicit RegionBar(QWidget* parent = nullptr);

  /// Adds the button of an action at the end.
  void addAction(QAction* action) { layout_->addWidget(make_action_button(action, this)); }
  /// Available regions, in order.
  void setParts(const QStringList& names);
  void setCurrent(int part) { part_->setCurrentIndex(part); }
  /// "1 024 px", or why nothing is evaluated.
  void setSummary(const QString& text) { summary_->setFullText(text); }
  [[nodiscard]] QString summary() const { return summary_->fullText(); }

 signals:
  void partChosen(int part);

 private:
  QComboBox* part_;
  ElidedLabel* summary_;
  QHBoxLayout* layout_;
};

}  // namespace episcope
