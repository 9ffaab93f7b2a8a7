// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/question_box.h"

#include "widgets/style/breakable_text.h"

#include <QCoreApplication>

namespace episcope {
namespace {

constexpr int kMostNames = 5;

struct Text {
  Q_DECLARE_TR_FUNCTIONS(episcope::QuestionBox)
};

}  // namespace

QMessageBox* new_question_box(QWidget* window, const BoxQuestion& question) {
  auto* box = new QMessageBox(question.icon, question.title, breakable(question.text),
                              question.buttons, window);
  box->setObjectName(question.name);
  box->setTextFormat(Qt::PlainText);
  box->setAttribute(Qt::WA_DeleteOnClose);
  return box;
}

QString listed(const QStringList& names) {
  const QString separator = QStringLiteral(", ");
  // One name takes no more room than "and 1 more".
  if (names.size() <= kMostNames + 1) return names.join(separator);
  return Text::tr("%1 and %2 more")
      .arg(names.mid(0, kMostNames).join(separator))
      .arg(names.size() - kMostNames);
}

}  // namespace episcope
