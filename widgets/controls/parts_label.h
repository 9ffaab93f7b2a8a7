// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/controls/elided_label.h"

#include <QStringList>

namespace episcope {

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
