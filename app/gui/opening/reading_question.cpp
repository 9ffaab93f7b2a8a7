// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/opening/reading_question.h"

#include "widgets/controls/elided_label.h"
#include "widgets/style/schema_text.h"
#include "widgets/style/theme.h"

#include <QButtonGroup>
#include <QDialogButtonBox>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>
#include <QVBoxLayout>

#include <algorithm>

namespace episcope {
namespace {

constexpr int kWidth = 460;

QString sentence(const std::string& text) {
  const QString whole = QString::fromStdString(text);
  return whole.left(1).toUpper() + whole.mid(1) + '.';
}

QLabel* paragraph(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  label->setTextFormat(Qt::PlainText);
  label->setWordWrap(true);
  return label;
}

}  // namespace

ReadingQuestion::ReadingQuestion(const io::Undecided& question, QWidget* parent)
    : QDialog(parent), choices_(question.choices()), buttons_(new QButtonGroup(this)) {
  setObjectName("readingQuestion");
  setWindowTitle(tr("How is it to be read?"));
  auto* layout = new QVBoxLayout(this);
  auto* file = new ElidedLabel(this, Qt::ElideMiddle);
  file->setFullText(QString::fromStdString(question.path().string()));
  layout->addWidget(file);
  layout->addWidget(paragraph(sentence(question.reason()), this));
  for (std::size_t i = 0; i < choices_.size(); ++i) {
    auto* button = new QRadioButton(schema_text(choices_[i].label), this);
    button->setObjectName("readingQuestion." + QString::fromStdString(choices_[i].value));
    buttons_->addButton(button, static_cast<int>(i));
    layout->addWidget(button);
  }
  if (auto* first = buttons_->button(0)) first->setChecked(true);
  auto* note =
      paragraph(tr("Your choice is remembered for this file; “Conventions…” changes it."), this);
  note->setPalette(theme::text_palette(theme::muted_text(palette())));
  layout->addWidget(note);
  layout->addStretch(1);
  auto* answer = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
  answer->addButton(tr("Open"), QDialogButtonBox::AcceptRole)->setObjectName("readingQuestion.ok");
  layout->addWidget(answer);
  connect(answer, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(answer, &QDialogButtonBox::rejected, this, &QDialog::reject);
  layout->activate();
  resize(kWidth, layout->heightForWidth(kWidth));
}

std::string ReadingQuestion::chosen() const {
  const int index = std::max(buttons_->checkedId(), 0);
  return choices_[static_cast<std::size_t>(index)].value;
}

}  // namespace episcope

#include "moc_reading_question.cpp"
