// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/changed_file.h"

#include "app/gui/frame/question_box.h"

#include <QCoreApplication>
#include <QPushButton>

namespace episcope {
namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(episcope::ChangedFile)
};

}  // namespace

void ask_about_changed_file(QWidget* window, const QString& path,
                            const ChangedFileAnswers& answers) {
  auto* box = new_question_box(
      window, {.name = "changed_file",
               .icon = QMessageBox::Warning,
               .title = Text::tr("The file has changed"),
               .text = Text::tr("Another program has written %1 since it was read or saved here. "
                                "Saving replaces what that program wrote.")
                           .arg(path) +
                       ' ' + answers.of_reloading});
  const auto add = [box](const char* name, const QString& text, QMessageBox::ButtonRole role,
                         const std::function<void()>& run) {
    QPushButton* button = box->addButton(text, role);
    button->setObjectName(name);
    QObject::connect(button, &QPushButton::clicked, box, run);
  };
  add("changed_file.elsewhere", Text::tr("Save to another file…"), QMessageBox::AcceptRole,
      answers.elsewhere);
  add("changed_file.overwrite", Text::tr("Overwrite"), QMessageBox::DestructiveRole,
      answers.overwrite);
  if (answers.reload) {
    add("changed_file.reload", Text::tr("Reload"), QMessageBox::DestructiveRole, answers.reload);
  }
  box->setDefaultButton(QMessageBox::Cancel);
  box->open();
}

}  // namespace episcope
