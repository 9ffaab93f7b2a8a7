// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QLabel>
#include <QString>
#include <QStringList>

namespace episcope {

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

}  // namespace episcope
