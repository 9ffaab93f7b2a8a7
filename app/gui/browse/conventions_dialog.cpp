// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/browse/conventions_dialog.h"

#include "app/gui/browse/pattern_panel.h"
#include "engine/io/open/open_options.h"
#include "widgets/controls/elided_label.h"
#include "widgets/estimate/parameter_form.h"

#include <QDialogButtonBox>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>

namespace episcope {
namespace {

constexpr int kWidth = 460;
constexpr int kWidthWithNames = 620;

bool has_option(const std::vector<ParameterDescription>& options, const char* key) {
  return std::ranges::find(options, key, &ParameterDescription::key) != options.end();
}

}  // namespace

ConventionsDialog::ConventionsDialog(const QString& path,
                                     const std::vector<ParameterDescription>& options,
                                     const ParameterSet& given, QWidget* parent)
    : QDialog(parent), form_(new ParameterForm(this)) {
  setObjectName("conventions");
  setWindowTitle(tr("Conventions"));
  auto* file = new ElidedLabel(this, Qt::ElideMiddle);
  file->setFullText(path);
  auto* note = new QLabel(tr("The file will be read again and your choice remembered. Results of "
                             "this light field will be removed from the list."),
                          this);
  note->setWordWrap(true);
  form_->setParameters(options);
  form_->setValues(given);
  auto* buttons =
      new QDialogButtonBox(QDialogButtonBox::Cancel | QDialogButtonBox::RestoreDefaults, this);
  auto* apply = buttons->addButton(tr("Read again"), QDialogButtonBox::AcceptRole);
  apply->setObjectName("conventions.apply");
  apply->setDefault(true);
  QPushButton* reset = buttons->button(QDialogButtonBox::RestoreDefaults);
  reset->setText(tr("All automatic"));
  reset->setObjectName("conventions.reset");
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(file);
  layout->addWidget(form_);
  const bool has_names = has_option(options, "pattern");
  if (has_names) {
    layout->addWidget(makePatternPanel(path), 1);
  } else {
    layout->addStretch(1);
  }
  layout->addWidget(note);
  layout->addWidget(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(reset, &QPushButton::clicked, form_, &ParameterForm::resetToDefaults);
  layout->activate();
  const int width = has_names ? kWidthWithNames : kWidth;
  resize(width, layout->heightForWidth(width));
}

PatternPanel* ConventionsDialog::makePatternPanel(const QString& path) {
  auto* panel = new PatternPanel(path, this);
  const auto show = [this, panel] {
    const auto options = io::open_schema().parse(form_->modifiedValues());
    panel->preview(options.pattern, options.snake);
  };
  connect(form_, &ParameterForm::valuesChanged, panel, show);
  show();
  return panel;
}

ParameterSet ConventionsDialog::given() const {
  return form_->modifiedValues();
}

}  // namespace episcope

#include "moc_conventions_dialog.cpp"
