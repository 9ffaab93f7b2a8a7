// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QLabel>
#include <QString>
#include <QStringList>

namespace episcope {

/// One line of plain text that is elided where it does not fit; the whole of it is then the tool
/// tip. Never asks for more width than it gets.
class ElidedLabel : public QLabel {
  Q_OBJECT

 public:
  explicit ElidedLabel(QWidget* parent = nullptr, Qt::TextElideMode mode = Qt::ElideRight);

  void setFullText(const QString& text);
  [[nodiscard]] const QString& fullText() const { return full_text_; }
  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  /// What is shown of the text in `room` pixels.
  [[nodiscard]] virtual QString shortened(int room) const;
  /// The tool tip while not all is shown.
  [[nodiscard]] virtual QString tip() const { return full_text_; }
  void elide();

  Qt::TextElideMode mode_;
  QString full_text_;
};

/// A long text of which two lines are shown, and all of it after a click, or as tool tip. Never
/// asks for more width than it gets.
class FoldedLabel : public QLabel {
  Q_OBJECT

 public:
  explicit FoldedLabel(QWidget* parent = nullptr);

  void setFullText(const QString& text);
  [[nodiscard]] const QString& fullText() const { return full_text_; }
  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;
  [[nodiscard]] int heightForWidth(int width) const override;

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  [[nodiscard]] QStringList linesAt(int width) const;
  void fold();

  QString full_text_;
  bool is_open_ = false;
};

/// One line of parts, "a · b · c". Where they do not all fit, the first ones are shown whole and
/// the line ends in "+2 more"; the tool tip then lists all. Never asks for more width than it gets.
class PartsLabel : public ElidedLabel {
  Q_OBJECT

 public:
  using ElidedLabel::ElidedLabel;

  void setParts(const QStringList& parts);

 private:
  [[nodiscard]] QString shortened(int room) const override;
  [[nodiscard]] QString tip() const override;
  /// The first `count` parts and how many are left out.
  [[nodiscard]] QString textOf(qsizetype count) const;

  QStringList parts_;
};

}  // namespace episcope
