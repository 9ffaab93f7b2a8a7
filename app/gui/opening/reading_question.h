// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/undecided.h"

#include <QDialog>

class QButtonGroup;

namespace episcope {

/// Asks how a light field is to be read where the files do not tell.
class ReadingQuestion : public QDialog {
  Q_OBJECT

 public:
  ReadingQuestion(const io::Undecided& question, QWidget* parent);

  /// The value of the option that was chosen.
  [[nodiscard]] std::string chosen() const;

 private:
  std::vector<io::ReadingChoice> choices_;
  QButtonGroup* buttons_;
};

}  // namespace episcope
