// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>
#include <QWidget>

class QAction;
class QCheckBox;
class QComboBox;
class QHBoxLayout;

namespace episcope {

class ElidedLabel;

/// What is done with all scribbles: carrying them to all views, saving, exporting, importing.
/// Setters never emit.
class AnnotationBar : public QWidget {
  Q_OBJECT

 public:
  /// What scribbles are carried by.
  enum class CarriedBy { Estimate, Truth };

  explicit AnnotationBar(QWidget* parent = nullptr);

  /// A button for an action, in order of the calls.
  void addAction(QAction* action, const QString& object_name);
  /// Which disparities there are; what is missing cannot be chosen.
  void setSources(bool has_estimate, bool has_truth);
  void setCarried(bool is_carried);
  /// What carrying is about, e.g. "carrying …"; empty = nothing.
  void setCarryState(const QString& state);
  /// The file and whether it holds what is painted.
  void setFileState(const QString& state);

  [[nodiscard]] bool isCarried() const;
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
