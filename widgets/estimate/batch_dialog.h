// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QDialog>
#include <QString>

#include <vector>

class QListWidget;
class QPushButton;

namespace episcope {

/// Chooses methods, and light fields to run them on.
class BatchDialog : public QDialog {
  Q_OBJECT

 public:
  struct Row {
    QString id;
    QString name;
    bool is_checked = false;
  };

  BatchDialog(const std::vector<Row>& methods, const std::vector<Row>& scenes, QWidget* parent);

  /// Ids of the rows that are checked, in their order.
  [[nodiscard]] QStringList methods() const;
  [[nodiscard]] QStringList scenes() const;

 private:
  QListWidget* addList(const QString& name, const QString& title, const std::vector<Row>& rows);
  void showCount();

  QListWidget* methods_;
  QListWidget* scenes_;
  QPushButton* run_;
};

}  // namespace episcope
