// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/capture/form_question.h"

#include "widgets/estimate/parameter_form.h"

#include <QDialog>
#include <QDialogButtonBox>
#include <QPushButton>
#include <QVBoxLayout>

#include <utility>

namespace episcope {

void ask_for_values(QWidget* window, const FormQuestion& question,
                    std::function<void(const ParameterSet&)> answer) {
  auto* dialog = new QDialog(window);
  dialog->setObjectName(question.name);
  dialog->setWindowTitle(question.title);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  auto* form = new ParameterForm(dialog);
  form->setParameters(question.parameters);
  form->setValues(question.values);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, dialog);
  auto* accept = buttons->addButton(question.accept, QDialogButtonBox::AcceptRole);
  accept->setObjectName(question.name + ".accept");
  accept->setDefault(true);
  auto* layout = new QVBoxLayout(dialog);
  layout->addWidget(form);
  layout->addWidget(buttons);
  QObject::connect(buttons, &QDialogButtonBox::accepted, dialog, &QDialog::accept);
  QObject::connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
  QObject::connect(dialog, &QDialog::accepted, window,
                   [form, answer = std::move(answer)] { answer(form->values()); });
  dialog->open();
}

}  // namespace episcope
