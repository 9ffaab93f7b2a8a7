// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/parameter_form.h"

#include "widgets/controls/layout.h"
#include "widgets/controls/parameter_help.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QEvent>
#include <QGridLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>

namespace episcope {
namespace {

constexpr int kLineSpacing = 2;
constexpr QSize kSmallIcon(12, 12);

QString reset_tip(const ParameterDescription& d) {
  return ParameterForm::tr("Reset to the default, %1").arg(value_text(d, d.default_value));
}

bool is_among(const std::vector<std::string>& keys, const std::string& key) {
  return std::ranges::find(keys, key) != keys.end();
}

}  // namespace

ParameterForm::ParameterForm(QWidget* parent) : QWidget(parent) {
  setObjectName("parameterForm");
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
}

QGridLayout* ParameterForm::addGrid(QWidget* place) {
  auto* grid = make_grid(place, theme::kSpacing, kLineSpacing);
  grid->setColumnStretch(0, 2);
  grid->setColumnStretch(1, 3);
  return grid;
}

void ParameterForm::setParameters(const std::vector<ParameterDescription>& parameters,
                                  const std::vector<std::string>& main) {
  delete sheet_;
  rows_.clear();
  fold_ = nullptr;
  advanced_ = nullptr;
  descriptions_ = parameters;
  sheet_ = new QWidget(this);
  std::vector<std::size_t> first;
  std::vector<std::size_t> others;
  for (const auto& description : parameters) {
    const bool is_main = main.empty() || is_among(main, description.key);
    (is_main ? first : others).push_back(rows_.size());
    rows_.push_back(makeRow(description, is_main));
  }
  std::ranges::stable_sort(first, {}, [&](std::size_t index) {
    return std::ranges::find(main, rows_[index].description.key) - main.begin();
  });
  auto* layout = new QVBoxLayout(sheet_);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(kLineSpacing);
  auto* top = new QWidget(sheet_);
  layRows(first, addGrid(top));
  layout->addWidget(top);
  if (!others.empty()) {
    fold_ = make_tool_button({"parameters.advanced", "", {}}, sheet_);
    fold_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    connect(fold_, &QToolButton::clicked, this, [this] { setAdvancedShown(!is_advanced_shown_); });
    advanced_ = new QWidget(sheet_);
    layRows(others, addGrid(advanced_));
    layout->addWidget(fold_, 0, Qt::AlignLeft);
    layout->addWidget(advanced_);
  }
  this->layout()->addWidget(sheet_);
  sheet_->show();
  showFold();
}

ParameterForm::Row ParameterForm::makeRow(const ParameterDescription& description, bool is_main) {
  const QString key = QString::fromStdString(description.key);
  auto* label = new QLabel(schema_text(description.label), sheet_);
  auto* editor = make_parameter_editor(description, sheet_);
  auto* reset = make_tool_button({key + ".reset", "reset", reset_tip(description)}, sheet_);
  label->setObjectName(key + ".label");
  label->setToolTip(parameter_help(description));
  label->setBuddy(editor);
  label->setWordWrap(true);
  // The row has one label for all its controls.
  for (QWidget* control : editor->findChildren<QWidget*>()) {
    if (control->accessibleName().isEmpty()) control->setAccessibleName(label->text());
  }
  editor->setToolTip(parameter_help(description));
  editor->setRangeHints(hints_);
  reset->setIconSize(kSmallIcon);
  QSizePolicy keeps_place = reset->sizePolicy();
  keeps_place.setRetainSizeWhenHidden(true);
  reset->setSizePolicy(keeps_place);
  const std::size_t index = rows_.size();
  connect(editor, &ParameterEditor::edited, this, [this, index] { edit(index); });
  connect(reset, &QToolButton::clicked, this, [this, index] {
    rows_[index].editor->setValue(rows_[index].description.default_value);
    edit(index);
  });
  return {description, label, editor, reset, is_main};
}

void ParameterForm::layRows(const std::vector<std::size_t>& rows, QGridLayout* grid) {
  int line = 0;
  for (const std::size_t index : rows) {
    const Row& row = rows_[index];
    grid->addWidget(row.label, line, 0);
    grid->addWidget(row.editor, line, 1);
    grid->addWidget(row.reset, line, 2);
    grid->addWidget(makeHelp(index), line, 3);
    showModified(row);
    ++line;
  }
}

QToolButton* ParameterForm::makeHelp(std::size_t index) {
  const QString key = QString::fromStdString(rows_[index].description.key);
  auto* help = make_tool_button({key + ".help", "help", tr("What this parameter does")}, sheet_);
  help->setIconSize(kSmallIcon);
  help->setAccessibleName(tr("Help on %1").arg(rows_[index].label->text()));
  connect(help, &QToolButton::clicked, this, [this, index, help] {
    showHelp(index, help->mapToGlobal(QPoint(help->width(), help->height())));
  });
  return help;
}

void ParameterForm::showHelp(std::size_t index, const QPoint& at) {
  const Row& row = rows_[index];
  auto* help = new ParameterHelp(row.description, row.editor->value(), this);
  help->setAttribute(Qt::WA_DeleteOnClose);
  help->showAt(at);
}

void ParameterForm::setAdvancedShown(bool is_shown) {
  if (is_advanced_shown_ == is_shown) return;
  is_advanced_shown_ = is_shown;
  showFold();
}

// What is folded and changed is told: it acts all the same.
void ParameterForm::showFold() {
  if (!fold_) return;
  int folded = 0;
  int changed = 0;
  for (const Row& row : rows_) {
    if (row.is_main) continue;
    ++folded;
    changed += row.editor->value() != row.description.default_value ? 1 : 0;
  }
  const QString text = changed == 0 ? tr("Advanced (%1)").arg(folded)
                                    : tr("Advanced (%1, %2 changed)").arg(folded).arg(changed);
  QFont font = this->font();
  font.setBold(changed > 0);
  fold_->setFont(font);
  fold_->setText(text);
  fold_->setArrowType(is_advanced_shown_ ? Qt::DownArrow : Qt::RightArrow);
  fold_->setToolTip(is_advanced_shown_ ? tr("Hides the parameters that are rarely changed")
                                       : tr("Shows the parameters that are rarely changed"));
  advanced_->setVisible(is_advanced_shown_);
}

bool ParameterForm::event(QEvent* event) {
  const bool is_done = QWidget::event(event);
  if (event->type() == QEvent::LayoutRequest) emit heightChanged();
  return is_done;
}

void ParameterForm::edit(std::size_t index) {
  if (!rows_[index].description.presets.empty()) followPresets();
  showModified(rows_[index]);
  showFold();
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
    row.label->setToolTip(parameter_help(row.description));
    row.editor->setToolTip(parameter_help(row.description));
    row.reset->setToolTip(reset_tip(row.description));
    showModified(row);
  }
  showFold();
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
  showFold();
}

void ParameterForm::setRangeHints(const RangeHints& hints) {
  if (hints_ == hints) return;
  hints_ = hints;
  for (const Row& row : rows_) row.editor->setRangeHints(hints);
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
