// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>
#include <QTimer>
#include <QWidget>

#include <array>
#include <functional>

class QLabel;
class QPushButton;
class QToolButton;

namespace episcope {

enum class Severity { Info, Success, Warning, Error };

/// One message that does not block: severity, text, close button and at most two actions. Info and
/// success disappear by themselves; warnings and errors stay until closed. Hidden when empty.
class MessageBar : public QWidget {
  Q_OBJECT

 public:
  struct Action {
    QString text;
    std::function<void()> run;
  };

  explicit MessageBar(QWidget* parent = nullptr);

  void showMessage(Severity severity, const QString& text);
  /// Shows a second button if `other` is set.
  void showMessage(Severity severity, const QString& text, Action action, Action other = {});

  [[nodiscard]] const QString& text() const { return sentence_; }
  [[nodiscard]] Severity severity() const { return severity_; }

 public slots:
  void dismiss();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  struct Button {
    QPushButton* button;
    Action action;
  };
  void setAction(Button& button, Action action);
  [[nodiscard]] QColor accent() const;
  void updateIcon();

  Severity severity_ = Severity::Info;
  QString sentence_;
  QLabel* icon_;
  QLabel* text_;
  std::array<Button, 2> buttons_;
  QToolButton* close_;
  QTimer timer_;
};

}  // namespace episcope
