// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>
#include <QWidget>

class QAction;
class QPushButton;

namespace episcope {

class ElidedLabel;

/// The steps from photographs to a rectified light field: what each has brought, and what can be
/// done. Setters never emit.
class PhotographSteps : public QWidget {
  Q_OBJECT

 public:
  explicit PhotographSteps(QWidget* parent = nullptr);

  /// `text`: what is known of the lens; `details`: the same at length, the tool tip of its button.
  void setCamera(const QString& text, const QString& details, bool is_known);
  /// `text`: how the light field that is shown came to be aligned, or why it cannot be.
  void setAlignment(const QString& text, bool can_rectify);

 signals:
  void calibrateRequested();
  void openCameraRequested();
  void saveCameraRequested();
  void rectifyRequested();
  void demoRequested();

 private:
  ElidedLabel* camera_;
  ElidedLabel* alignment_;
  QPushButton* lens_;
  QPushButton* rectify_;
  QAction* save_ = nullptr;
};

}  // namespace episcope
