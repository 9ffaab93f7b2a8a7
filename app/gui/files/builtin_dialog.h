// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QDialog>

class QLabel;
class QListWidget;

namespace episcope {

class ParameterForm;

/// Lists the built-in scenes; of the random one, asks for seed and kind. Double click or Return
/// opens one.
class BuiltinDialog : public QDialog {
  Q_OBJECT

 public:
  explicit BuiltinDialog(QWidget* parent);

  /// What a command line opens: "demo:random?seed=7&kind=thin".
  [[nodiscard]] QString input() const;

 private:
  void listScenes();
  void showChosen();
  [[nodiscard]] QString scene() const;

  QListWidget* scenes_;
  ParameterForm* form_;
  QLabel* written_;
};

}  // namespace episcope
