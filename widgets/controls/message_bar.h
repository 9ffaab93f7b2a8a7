// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QColor>
#include <QElapsedTimer>
#include <QString>
#include <QTimer>
#include <QWidget>

#include <array>
#include <functional>
#include <map>

class QLabel;
class QProgressBar;
class QPushButton;
class QScrollArea;
class QToolButton;
class QVBoxLayout;

namespace episcope {

enum class Severity { Info, Success, Warning, Error };

/// Fills a widget, within its paint event, as a message: tinted, with an edge in the accent.
void paint_message_ground(QWidget& widget, const QColor& accent);

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

 signals:
  /// The user closed the message by its cross, without an action.
  void closed();

 protected:
  void paintEvent(QPaintEvent*) override { paint_message_ground(*this, accent()); }

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

class ElidedLabel;

/// Whole percent of a job that has done `fraction`: below 100 as long as it runs.
[[nodiscard]] int percent_done(double fraction);

/// Remaining time of a job that has done `fraction` in `seconds`, e.g. "about 12 s left"; empty
/// while unknown.
[[nodiscard]] QString time_left_text(double fraction, double seconds);

/// Running and waiting jobs, one row each: bar, stage, time left, cancel button, and a button to
/// end early for jobs that can. Shows a quiet line without jobs. It is two rows high;
/// more rows scroll.
class JobPanel : public QWidget {
  Q_OBJECT

 public:
  explicit JobPanel(QWidget* parent = nullptr);

  /// Adds a job, waiting until its first progress.
  void addJob(quint64 id, const QString& title);
  /// Ignored for an unknown id. A job's clock starts with its first progress.
  void setProgress(quint64 id, double fraction, const QString& stage);
  /// Offers to end an iterative job early, once it has begun.
  void setIterative(quint64 id);
  /// Marks the job as being cancelled.
  void setCancelling(quint64 id) { end(id, tr("cancelling"), true); }
  void setFinishing(quint64 id) { end(id, tr("finishing"), false); }
  void removeJob(quint64 id);

  [[nodiscard]] int jobCount() const { return static_cast<int>(rows_.size()); }

 signals:
  void cancelRequested(quint64 id);
  void finishRequested(quint64 id);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  struct Row {
    QWidget* widget;
    ElidedLabel* stage;
    QProgressBar* bar;
    QToolButton* finish;
    QToolButton* cancel;
    QElapsedTimer clock;
    bool is_iterative = false;
  };

  [[nodiscard]] Row* find(quint64 id);
  void end(quint64 id, const QString& stage, bool cancelled);
  void showRows();
  void fitHeight();

  QScrollArea* scroll_;
  QVBoxLayout* layout_;  // of the rows
  QLabel* idle_;
  std::map<quint64, Row> rows_;
};

}  // namespace episcope
