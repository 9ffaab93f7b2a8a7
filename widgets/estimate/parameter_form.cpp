// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/estimate/parameter_form.h"

#include "widgets/controls/tool_button.h"
#include "widgets/estimate/parameter_editor.h"
#include "widgets/style/schema_text.h"
#include "widgets/style/theme.h"

#include <QGridLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>

namespace episcope {
namespace {

QString tool_tip(const ParameterDescription& d) {
  const QString domain = domain_text(d);
  QStringList facts;
  if (!domain.isEmpty()) facts << ParameterForm::tr("Range %1").arg(domain);
  facts << ParameterForm::tr("Default %1").arg(value_text(d, d.default_value));
  return QString("<p><b>%1</b></p><p>%2</p><p>%3<br/><code>--%4</code></p>")
      .arg(schema_text(d.label).toHtmlEscaped(), schema_text(d.help).toHtmlEscaped(),
           facts.join(" · ").toHtmlEscaped(), QString::fromStdString(d.key).toHtmlEscaped());
}

QString reset_tip(const ParameterDescription& d) {
  return ParameterForm::tr("Reset to the default, %1").arg(value_text(d, d.default_value));
}

}  // namespace

ParameterForm::ParameterForm(QWidget* parent) : QWidget(parent), layout_(new QGridLayout(this)) {
  setObjectName("parameterForm");
  layout_->setContentsMargins(0, 0, 0, 0);
  layout_->setHorizontalSpacing(theme::kSpacing);
  layout_->setVerticalSpacing(2);
  layout_->setColumnStretch(0, 2);
  layout_->setColumnStretch(1, 3);
}

void ParameterForm::setParameters(const std::vector<ParameterDescription>& parameters) {
  for (const auto& row : rows_) {
    delete row.label;
    delete row.editor;
    delete row.reset;
  }
  rows_.clear();
  descriptions_ = parameters;
  for (const auto& description : parameters) addRow(description);
}

void ParameterForm::addRow(const ParameterDescription& description) {
  const QString key = QString::fromStdString(description.key);
  auto* label = new QLabel(schema_text(description.label), this);
  auto* editor = make_parameter_editor(description, this);
  auto* reset = make_tool_button({key + ".reset", "reset", reset_tip(description)}, this);
  label->setObjectName(key + ".label");
  label->setToolTip(tool_tip(description));
  label->setBuddy(editor);
  // The row has one label for all its controls.
  for (QWidget* control : editor->findChildren<QWidget*>()) {
    if (control->accessibleName().isEmpty()) control->setAccessibleName(label->text());
  }
  label->setWordWrap(true);
  editor->setToolTip(tool_tip(description));
  reset->setIconSize({12, 12});
  QSizePolicy keeps_place = reset->sizePolicy();
  keeps_place.setRetainSizeWhenHidden(true);
  reset->setSizePolicy(keeps_place);

  const std::size_t index = rows_.size();
  const int line = static_cast<int>(index);
  layout_->addWidget(label, line, 0);
  layout_->addWidget(editor, line, 1);
  layout_->addWidget(reset, line, 2);
  const Row row{description, label, editor, reset};
  rows_.push_back(row);
  showModified(row);
  connect(editor, &ParameterEditor::edited, this, [this, index] { edit(index); });
  connect(reset, &QToolButton::clicked, this, [this, index] {
    rows_[index].editor->setValue(rows_[index].description.default_value);
    edit(index);
  });
}

void ParameterForm::edit(std::size_t index) {
  if (!rows_[index].description.presets.empty()) followPresets();
  showModified(rows_[index]);
  emit valuesChanged();
}

void ParameterForm::followPresets() {
  const std::vector<ParameterDescription> described = described_under(descriptions_, values());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    Row& row = rows_[i];
    const bool follows =
        row.editor->value() == row.description.default_value && row.description.presets.empty();
    row.description = described[i];
    if (follows) row.editor->setValue(row.description.default_value);
    row.label->setToolTip(tool_tip(row.description));
    row.editor->setToolTip(tool_tip(row.description));
    row.reset->setToolTip(reset_tip(row.description));
    showModified(row);
  }
}

void ParameterForm::showModified(const Row& row) const {
  const bool is_modified = row.editor->value() != row.description.default_value;
  QFont font = row.label->font();
  font.setBold(is_modified);
  row.label->setFont(font);
  row.reset->setVisible(is_modified);
}

void ParameterForm::setValues(const ParameterSet& values) {
  const auto set = [&](bool chooses_preset) {
    for (const auto& [key, value] : values) {
      for (const auto& row : rows_) {
        if (row.description.key != key) continue;
        if (row.description.presets.empty() == chooses_preset) continue;
        row.editor->setValue(value);
        showModified(row);
      }
    }
  };
  set(true);
  followPresets();
  set(false);
}

ParameterSet ParameterForm::values() const {
  ParameterSet set;
  for (const auto& row : rows_) set.emplace_back(row.description.key, row.editor->value());
  return set;
}

ParameterSet ParameterForm::modifiedValues() const {
  ParameterSet set;
  for (const auto& row : rows_) {
    if (auto value = row.editor->value(); value != row.description.default_value) {
      set.emplace_back(row.description.key, std::move(value));
    }
  }
  return set;
}

void ParameterForm::resetToDefaults() {
  if (modifiedValues().empty()) return;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    rows_[i].description = descriptions_[i];
    rows_[i].editor->setValue(descriptions_[i].default_value);
  }
  followPresets();
  emit valuesChanged();
}

}  // namespace episcope

#include "moc_parameter_form.cpp"
