// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/cloud/cloud_look.h"
#include "widgets/cloud/point_cloud_view.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QWidget>

class QCheckBox;
class QComboBox;
class QGridLayout;
class QSlider;
class QStackedLayout;
class QVBoxLayout;

namespace episcope {

class NumberSpin;

/// The 3D view, or a sentence that tells why it is empty. Can move to another window.
class CloudDisplay : public QWidget {
  Q_OBJECT

 public:
  explicit CloudDisplay(QWidget* parent = nullptr);

  /// Shows clouds, or `hint` if they have no points.
  void setParts(const CloudPartsPtr& parts, const QString& hint);
  /// Null without a display to draw on.
  [[nodiscard]] PointCloudView* view() const { return view_; }

 signals:
  /// The display became visible.
  void shown();
  /// The user clicked a point that comes from this pixel.
  void pixelPicked(episcope::PixelIndex pixel);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QLabel* hint_;
  QStackedLayout* stack_;
  PointCloudView* view_;
  CloudPartsPtr parts_;
};

/// Choices that are available now.
struct CloudOffers {
  bool has_truth = false;
  bool has_error = false;
  bool has_labels = false;
  bool has_distance = false;
  QString other{};  ///< Name of the result to compare with; empty = there is none.
};

/// Controls of the 3D view: its contents and look.
class CloudControls : public QWidget {
  Q_OBJECT

 public:
  explicit CloudControls(QWidget* parent = nullptr);

  void setChoice(const CloudChoice& choice);
  [[nodiscard]] CloudChoice choice() const;
  void setLook(const CloudLook& look);
  [[nodiscard]] CloudLook look() const;
  /// Disables unavailable choices; the current choice stays.
  void setOffers(const CloudOffers& offers);
  /// Describes the drawn clouds below the controls.
  void setSummary(const QString& text) { summary_->setText(text); }

 signals:
  /// The host should provide clouds for this choice.
  void choiceChanged();
  void lookChanged();

 private:
  void addColoring(QGridLayout& grid);
  void addCompanion(QGridLayout& grid);
  void addSurface(QGridLayout& grid);
  void addLook(QGridLayout& grid);
  QSlider* makeSlider(const QString& name, const QString& text, const QString& tip);
  void keepClipOpen(const QSlider* moved);

  QComboBox* coloring_;
  QComboBox* companion_;
  QComboBox* arrangement_;
  QCheckBox* surface_;
  QCheckBox* shaded_;
  NumberSpin* jump_;
  QSlider* size_ = nullptr;
  QSlider* stretch_ = nullptr;
  QSlider* near_ = nullptr;
  QSlider* far_ = nullptr;
  QLabel* summary_;
};

/// The 3D tab: the display with its controls. The display can be lent to another place.
class PointCloudPanel : public QWidget {
  Q_OBJECT

 public:
  explicit PointCloudPanel(QWidget* parent = nullptr);

  [[nodiscard]] CloudDisplay& display() const { return *display_; }
  [[nodiscard]] CloudControls& controls() const { return *controls_; }
  /// Whether a 3D view exists; if not, making clouds is wasted work.
  [[nodiscard]] bool isAvailable() const { return display_->view() != nullptr; }

  /// Gives the display away and shows `where` instead. The caller reparents the display.
  void lendDisplay(const QString& where);
  void takeDisplayBack();
  /// Adds a command's button beside the presets.
  void addButton(QWidget* button) { buttons_->addWidget(button); }

 private:
  void addPresets();

  CloudDisplay* display_;
  CloudControls* controls_;
  QLabel* elsewhere_;
  QHBoxLayout* buttons_;
  QVBoxLayout* rows_;
};

}  // namespace episcope
