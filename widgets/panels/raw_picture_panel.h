// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QImage>
#include <QPointF>
#include <QString>
#include <QStringList>
#include <QWidget>

#include <vector>

class QAction;
class QCheckBox;
class QComboBox;
class QGridLayout;
class QMenu;
class QPushButton;

namespace episcope {

class FoldedLabel;
class RawCanvas;

/// The steps from a raw picture of a plenoptic camera to a light field: each has a line of what was
/// found and a button that does it alone. Below, one of the pictures with the centers of its
/// lenses. Setters never emit.
class RawPicturePanel : public QWidget {
  Q_OBJECT

 public:
  /// `mosaics`: names of the colors of a sensor.
  explicit RawPicturePanel(const QStringList& mosaics, QWidget* parent = nullptr);

  /// States of the steps; empty = not done. Steps that need a raw picture, or lenses, are disabled
  /// without them.
  void setRaw(const QString& text);
  void setWhite(const QString& text);
  void setLenses(const QString& text);
  void setViews(const QString& text);
  /// Pictures to choose from, of one size, the first shown; none shows a hint.
  void setPictures(const QStringList& names, std::vector<QImage> pictures);
  /// Centers of lenses, px from the center of the first pixel; none = no lenses.
  void setCenters(std::vector<QPointF> centers, double pitch_px);

 signals:
  void openRequested();
  void demoRequested();
  void mosaicChosen(const QString& name);
  void whiteRequested();
  void calibrationRequested();
  void darkRequested();
  void opticsRequested();
  void lensesRequested();
  void decodeRequested();

 private:
  QGridLayout* makeSteps();
  void makeRawMenu(const QStringList& mosaics);
  void makeWhiteMenu();
  void showPicture(int index);

  FoldedLabel* raw_;
  FoldedLabel* white_;
  FoldedLabel* lenses_;
  FoldedLabel* views_;
  QPushButton* raw_button_;
  QPushButton* white_button_;
  QPushButton* find_;
  QPushButton* decode_;
  QMenu* mosaic_ = nullptr;
  QAction* optics_ = nullptr;
  QComboBox* shown_;
  QCheckBox* marks_;
  RawCanvas* canvas_;
  std::vector<QImage> pictures_;
};

}  // namespace episcope
