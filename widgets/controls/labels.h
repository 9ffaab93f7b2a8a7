// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QLabel>
#include <QString>
#include <QStringList>

namespace episcope {

/// One line of plain text, elided if it does not fit; the full text is the tool tip then. Never
/// asks for more width than it gets.
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
  /// The text elided to `room` pixels.
  [[nodiscard]] virtual QString shortened(int room) const;
  /// Tool tip while the text is elided.
  [[nodiscard]] virtual QString tip() const { return full_text_; }
  void elide();

  Qt::TextElideMode mode_;
  QString full_text_;
};

/// A long text that shows its first lines, or all of it after a click; the tool tip has all of it.
/// Never asks for more width than it gets.
class FoldedLabel : public QLabel {
  Q_OBJECT

 public:
  /// `lines`: how many it shows while it is folded.
  explicit FoldedLabel(QWidget* parent = nullptr, int lines = 2);

  void setFullText(const QString& text);
  [[nodiscard]] const QString& fullText() const { return full_text_; }
  /// Shows all of the text, or folds it.
  void setOpen(bool is_open);
  [[nodiscard]] bool isOpen() const { return is_open_; }
  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;
  [[nodiscard]] int heightForWidth(int width) const override;

 signals:
  /// A click opened or folded it.
  void toggled(bool is_open);

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  [[nodiscard]] QStringList linesAt(int width) const;
  void fold();

  int lines_;
  QString full_text_;
  bool is_open_ = false;
};

/// One line of parts, "a · b · c". If they do not fit, it shows the first ones and "+2 more"; the
/// tool tip lists all. Never asks for more width than it gets.
class PartsLabel : public ElidedLabel {
  Q_OBJECT

 public:
  using ElidedLabel::ElidedLabel;

  void setParts(const QStringList& parts);

 private:
  [[nodiscard]] QString shortened(int room) const override;
  [[nodiscard]] QString tip() const override { return parts_.join('\n'); }
  /// The first `count` parts and the number of the others.
  [[nodiscard]] QString textOf(qsizetype count) const;

  QStringList parts_;
};

}  // namespace episcope
