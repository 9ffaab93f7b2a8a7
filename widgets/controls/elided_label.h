// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QLabel>
#include <QString>

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

}  // namespace episcope
