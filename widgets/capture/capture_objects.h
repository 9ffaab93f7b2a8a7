// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>
#include <QStringList>
#include <QWidget>

class QComboBox;
class QPushButton;

namespace episcope {

class ElidedLabel;

/// The things before the cameras, one of which is worked on, and its mesh. Setters never emit.
class CaptureObjects : public QWidget {
  Q_OBJECT

 public:
  explicit CaptureObjects(QWidget* parent = nullptr);

  /// `current`: place of the one that is worked on.
  void setObjects(const QStringList& names, int current);
  /// What is known of its mesh; empty = there is none.
  void setMesh(const QString& text);

 signals:
  void chosen(int object);
  /// The current one, by typing.
  void renamed(const QString& name);
  void addRequested();
  void removeRequested();
  void openMeshRequested();

 private:
  QComboBox* names_;
  QPushButton* remove_;
  ElidedLabel* mesh_;
};

}  // namespace episcope
