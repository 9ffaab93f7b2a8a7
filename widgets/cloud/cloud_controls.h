// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/cloud/cloud_choice.h"
#include "widgets/cloud/cloud_look.h"

#include <QWidget>

class QCheckBox;
class QComboBox;
class QGridLayout;
class QLabel;
class QSlider;

namespace episcope {

class NumberSpin;

/// What of the choices of a user can be had now.
struct CloudOffers {
  bool has_truth = false;
  bool has_error = false;
  bool has_labels = false;
  bool has_distance = false;
  QString other{};  ///< Name of the result to compare with; empty = there is none.
};

/// Controls of the 3D view: what is seen, and how.
class CloudControls : public QWidget {
  Q_OBJECT

 public:
  explicit CloudControls(QWidget* parent = nullptr);

  void setChoice(const CloudChoice& choice);
  [[nodiscard]] CloudChoice choice() const;
  void setLook(const CloudLook& look);
  [[nodiscard]] CloudLook look() const;
  /// What cannot be had cannot be chosen; what is chosen stays chosen.
  void setOffers(const CloudOffers& offers);
  /// What is drawn, in words, below the controls.
  void setSummary(const QString& text);

 signals:
  /// The host should give clouds of this choice.
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

}  // namespace episcope
