// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QMessageBox>
#include <QString>
#include <QStringList>

namespace episcope {

struct BoxQuestion {
  QString name;  ///< Of the box, as an object.
  QMessageBox::Icon icon = QMessageBox::Question;
  QString title;
  QString text;  ///< Plain; its long words, as paths and names of results, are broken.
  QMessageBox::StandardButtons buttons = QMessageBox::Cancel;
};

/// A box over the window that deletes itself when it is closed. The caller adds what is missing and
/// opens it.
[[nodiscard]] QMessageBox* new_question_box(QWidget* window, const BoxQuestion& question);

/// The names with commas between them; of many the first few, and how many more there are.
[[nodiscard]] QString listed(const QStringList& names);

}  // namespace episcope
