// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QLabel>
#include <QStringList>

namespace episcope {

/// One line of parts, "a · b · c". Where they do not all fit, the first ones are shown whole and
/// the line ends in "+2 more"; the tool tip then lists all. Never asks for more width than it gets.
class PartsLabel : public QLabel {
  Q_OBJECT

 public:
  explicit PartsLabel(QWidget* parent = nullptr);

  void setParts(const QStringList& parts);
  /// All parts.
  [[nodiscard]] QString fullText() const;
  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void fit();
  /// The first `count` parts and how many are left out.
  [[nodiscard]] QString textOf(qsizetype count) const;

  QStringList parts_;
};

}  // namespace episcope
