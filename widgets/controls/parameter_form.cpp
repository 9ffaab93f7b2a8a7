// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/parameter_form.h"

#include "widgets/controls/number_spin.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QCheckBox>
#include <QComboBox>
#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QSlider>
#include <QSpinBox>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

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

namespace {

constexpr int kLeastDecimals = 2;

QString text_of(const std::string& text) {
  return QString::fromStdString(text);
}

QString control_name(const ParameterDescription& description, const char* control) {
  return text_of(description.key) + '.' + control;
}

QHBoxLayout* make_row(QWidget* editor) {
  auto* row = new QHBoxLayout(editor);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(theme::kSpacing);
  return row;
}

/// Lets the wheel scroll the form unless the control has the focus.
class WheelGuard : public QObject {
 public:
  explicit WheelGuard(QWidget* control) : QObject(control), control_(control) {
    control->setFocusPolicy(Qt::StrongFocus);
    control->installEventFilter(this);
  }

 protected:
  bool eventFilter(QObject*, QEvent* event) override {
    if (event->type() != QEvent::Wheel || control_->hasFocus()) return false;
    event->ignore();
    return true;
  }

 private:
  QWidget* control_;
};

NumberSpin* make_spin(const ParameterDescription& description, const char* control,
                      QWidget* parent) {
  auto* spin = new NumberSpin(parent);
  spin->setObjectName(control_name(description, control));
  const bool is_integer = std::holds_alternative<int>(description.default_value);
  const NumberScale scale(description);
  spin->setDecimals(is_integer ? 0 : scale.decimals());
  spin->setRange(description.min, description.max);
  spin->setSingleStep(is_integer ? 1 : (description.max - description.min) / 100);
  if (description.logarithmic) spin->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  if (!description.unit.empty()) spin->setSuffix(' ' + schema_text(description.unit));
  spin->setLeastDecimals(kLeastDecimals);
  new WheelGuard(spin);
  return spin;
}

/// Slider and spin box for `int` and `double`. Keeps the exact value that was set, which the spin
/// box may show rounded.
template <class Number>
class NumberEditor : public ParameterEditor {
 public:
  NumberEditor(const ParameterDescription& description, QWidget* parent)
      : ParameterEditor(parent),
        description_(description),
        scale_(description),
        slider_(new QSlider(Qt::Horizontal, this)),
        spin_(make_spin(description, "spin", this)) {
    slider_->setObjectName(control_name(description, "slider"));
    slider_->setRange(0, scale_.steps());
    slider_->setPageStep(std::max(1, scale_.steps() / 10));
    slider_->setMinimumWidth(60);
    new WheelGuard(slider_);
    auto* row = make_row(this);
    row->addWidget(slider_, 1);
    row->addWidget(spin_);
    // One width for all, so that the controls of a form stand in columns.
    spin_->setMinimumWidth(fontMetrics().horizontalAdvance(QStringLiteral("00.00 1/00000000")));
    connect(slider_, &QSlider::valueChanged, this,
            [this](int position) { edit(rounded(scale_.value(position))); });
    connect(spin_, &NumberSpin::valueChanged, this, [this](double value) { edit(value); });
    NumberEditor::setValue(description.default_value);
  }

  [[nodiscard]] ParameterValue value() const override { return value_; }

  void setValue(const ParameterValue& value) override {
    if (const auto* number = std::get_if<Number>(&value); number && !std::isnan(double(*number))) {
      show(*number);
    }
  }

 private:
  /// To the decimals shown, inside the domain.
  [[nodiscard]] double rounded(double value) const {
    const double unit = std::pow(10.0, spin_->decimals());
    return std::clamp(std::round(value * unit) / unit, description_.min, description_.max);
  }
  void show(double value) {
    const QSignalBlocker slider_blocker(slider_);
    const QSignalBlocker spin_blocker(spin_);
    const double clamped = std::clamp(value, description_.min, description_.max);
    value_ = static_cast<Number>(std::is_integral_v<Number> ? std::round(clamped) : clamped);
    slider_->setValue(scale_.position(value_));
    spin_->setValue(value_);
  }
  void edit(double value) {
    const Number before = value_;
    show(value);
    if (value_ != before) emit edited();
  }

  ParameterDescription description_;
  NumberScale scale_;
  QSlider* slider_;
  NumberSpin* spin_;
  Number value_{};
};

class FlagEditor : public ParameterEditor {
 public:
  FlagEditor(const ParameterDescription& description, QWidget* parent)
      : ParameterEditor(parent), check_(new QCheckBox(this)) {
    check_->setObjectName(control_name(description, "check"));
    make_row(this)->addWidget(check_);
    FlagEditor::setValue(description.default_value);
    connect(check_, &QCheckBox::toggled, this, &ParameterEditor::edited);
  }

  [[nodiscard]] ParameterValue value() const override { return check_->isChecked(); }

  void setValue(const ParameterValue& value) override {
    const QSignalBlocker blocker(check_);
    if (const auto* flag = std::get_if<bool>(&value)) check_->setChecked(*flag);
  }

 private:
  QCheckBox* check_;
};

class ChoiceEditor : public ParameterEditor {
 public:
  ChoiceEditor(const ParameterDescription& description, QWidget* parent)
      : ParameterEditor(parent), combo_(new QComboBox(this)) {
    combo_->setObjectName(control_name(description, "combo"));
    const auto& choices = description.choices;
    const auto& labels = description.choice_labels.empty() ? choices : description.choice_labels;
    for (std::size_t i = 0; i < choices.size(); ++i) {
      combo_->addItem(schema_text(labels[i]), text_of(choices[i]));
    }
    new WheelGuard(combo_);
    make_row(this)->addWidget(combo_, 1);
    ChoiceEditor::setValue(description.default_value);
    connect(combo_, &QComboBox::currentIndexChanged, this, &ParameterEditor::edited);
  }

  [[nodiscard]] ParameterValue value() const override {
    return combo_->currentData().toString().toStdString();
  }

  void setValue(const ParameterValue& value) override {
    const auto* text = std::get_if<std::string>(&value);
    if (!text || combo_->findData(text_of(*text)) < 0) return;
    const QSignalBlocker blocker(combo_);
    combo_->setCurrentIndex(combo_->findData(text_of(*text)));
  }

 private:
  QComboBox* combo_;
};

class TextEditor : public ParameterEditor {
 public:
  TextEditor(const ParameterDescription& description, QWidget* parent)
      : ParameterEditor(parent), line_(new QLineEdit(this)) {
    line_->setObjectName(control_name(description, "text"));
    line_->setPlaceholderText(ParameterEditor::tr("automatic"));
    make_row(this)->addWidget(line_);
    TextEditor::setValue(description.default_value);
    connect(line_, &QLineEdit::textEdited, this, &ParameterEditor::edited);
  }

  [[nodiscard]] ParameterValue value() const override { return line_->text().toStdString(); }

  void setValue(const ParameterValue& value) override {
    if (const auto* text = std::get_if<std::string>(&value)) line_->setText(text_of(*text));
  }

 private:
  QLineEdit* line_;
};

/// "auto", "found", or two ends of which the lower one stays below the upper one.
class IntervalEditor : public ParameterEditor {
 public:
  IntervalEditor(const ParameterDescription& description, QWidget* parent)
      : ParameterEditor(parent),
        domain_{description.min, description.max},
        automatic_(new QCheckBox(ParameterEditor::tr("auto"), this)),
        found_(new QCheckBox(ParameterEditor::tr("found"), this)),
        min_(make_spin(description, "min", this)),
        max_(make_spin(description, "max", this)) {
    automatic_->setObjectName(control_name(description, "auto"));
    found_->setObjectName(control_name(description, "found"));
    found_->setToolTip(ParameterEditor::tr("From the images, whatever the files say"));
    min_->setSuffix({});
    for (auto* end : {min_, max_}) end->setButtonSymbols(QAbstractSpinBox::NoButtons);
    min_->setMinimumWidth(44);
    ends_ = {std::max(domain_.min, -1.0), std::min(domain_.max, 1.0)};
    if (ends_.length() <= 0) ends_ = domain_;
    auto* row = make_row(this);
    auto* choices = new QVBoxLayout;
    choices->setSpacing(0);
    choices->addWidget(automatic_);
    choices->addWidget(found_);
    row->addLayout(choices);
    row->addWidget(min_, 1);
    row->addWidget(new QLabel("…", this));
    row->addWidget(max_, 1);
    IntervalEditor::setValue(description.default_value);
    connect(automatic_, &QCheckBox::toggled, this, [this] { choose(found_); });
    connect(found_, &QCheckBox::toggled, this, [this] { choose(automatic_); });
    connect(min_, &NumberSpin::valueChanged, this, [this](double value) {
      edit({value, std::max(ends_.max, value + least())});
    });
    connect(max_, &NumberSpin::valueChanged, this, [this](double value) {
      edit({std::min(ends_.min, value - least()), value});
    });
  }

  [[nodiscard]] ParameterValue value() const override {
    if (found_->isChecked()) return IntervalOrAuto::found();
    return automatic_->isChecked() ? IntervalOrAuto{} : IntervalOrAuto(ends_);
  }

  void setValue(const ParameterValue& value) override {
    const auto* interval = std::get_if<IntervalOrAuto>(&value);
    if (!interval) return;
    const QSignalBlocker automatic_blocker(automatic_), found_blocker(found_);
    automatic_->setChecked(!*interval && !interval->is_found);
    found_->setChecked(interval->is_found);
    enableEnds();
    if (*interval) ends_ = **interval;
    showEnds();
  }

 private:
  /// Least length of the interval: one unit of the last decimal.
  [[nodiscard]] double least() const { return std::pow(10.0, -min_->decimals()); }

  /// One of the boxes was clicked: the other one is not what is wanted.
  void choose(QCheckBox* other) {
    const QSignalBlocker blocker(other);
    other->setChecked(false);
    enableEnds();
    emit edited();
  }
  void enableEnds() {
    const bool is_given = !automatic_->isChecked() && !found_->isChecked();
    min_->setEnabled(is_given);
    max_->setEnabled(is_given);
  }
  void edit(Interval ends) {
    // At the border of the domain the edited end gives way.
    if (ends.max > domain_.max) ends = {domain_.max - least(), domain_.max};
    if (ends.min < domain_.min) ends = {domain_.min, domain_.min + least()};
    ends_ = ends;
    showEnds();
    emit edited();
  }
  void showEnds() {
    const QSignalBlocker min_blocker(min_);
    const QSignalBlocker max_blocker(max_);
    ends_.min = std::clamp(ends_.min, domain_.min, domain_.max);
    ends_.max = std::clamp(ends_.max, domain_.min, domain_.max);
    min_->setValue(ends_.min);
    max_->setValue(ends_.max);
  }

  Interval domain_;
  Interval ends_;
  QCheckBox* automatic_;
  QCheckBox* found_;
  NumberSpin* min_;
  NumberSpin* max_;
};

/// "auto", or row and column of a view.
class ViewEditor : public ParameterEditor {
 public:
  ViewEditor(const ParameterDescription& description, QWidget* parent)
      : ParameterEditor(parent),
        automatic_(new QCheckBox(ParameterEditor::tr("auto"), this)),
        v_(make_place(description, "v", ParameterEditor::tr("Row of the view"))),
        u_(make_place(description, "u", ParameterEditor::tr("Column of the view"))) {
    automatic_->setObjectName(control_name(description, "auto"));
    auto* row = make_row(this);
    row->addWidget(automatic_);
    row->addWidget(v_, 1);
    row->addWidget(new QLabel(",", this));
    row->addWidget(u_, 1);
    ViewEditor::setValue(description.default_value);
    connect(automatic_, &QCheckBox::toggled, this, [this](bool checked) {
      v_->setEnabled(!checked);
      u_->setEnabled(!checked);
      emit edited();
    });
    for (auto* place : {v_, u_}) {
      connect(place, &QSpinBox::valueChanged, this, &ParameterEditor::edited);
    }
  }

  [[nodiscard]] ParameterValue value() const override {
    if (automatic_->isChecked()) return ViewOrAuto{};
    return ViewOrAuto(ViewIndex{v_->value(), u_->value()});
  }

  void setValue(const ParameterValue& value) override {
    const auto* view = std::get_if<ViewOrAuto>(&value);
    if (!view) return;
    const QSignalBlocker blockers[] = {QSignalBlocker(automatic_), QSignalBlocker(v_),
                                       QSignalBlocker(u_)};
    automatic_->setChecked(!*view);
    v_->setEnabled(view->has_value());
    u_->setEnabled(view->has_value());
    if (!*view) return;
    v_->setValue((*view)->v);
    u_->setValue((*view)->u);
  }

 private:
  QSpinBox* make_place(const ParameterDescription& description, const char* name,
                       const QString& tip) {
    auto* place = new QSpinBox(this);
    place->setObjectName(control_name(description, name));
    place->setToolTip(tip);
    place->setButtonSymbols(QAbstractSpinBox::NoButtons);
    return place;
  }

  QCheckBox* automatic_;
  QSpinBox* v_;
  QSpinBox* u_;
};

}  // namespace

ParameterEditor* make_parameter_editor(const ParameterDescription& description, QWidget* parent) {
  struct Maker {
    const ParameterDescription& description;
    QWidget* parent;
    ParameterEditor* operator()(bool) const { return new FlagEditor(description, parent); }
    ParameterEditor* operator()(int) const { return new NumberEditor<int>(description, parent); }
    ParameterEditor* operator()(double) const {
      return new NumberEditor<double>(description, parent);
    }
    ParameterEditor* operator()(const std::string&) const {
      if (description.choices.empty()) return new TextEditor(description, parent);
      return new ChoiceEditor(description, parent);
    }
    ParameterEditor* operator()(const IntervalOrAuto&) const {
      return new IntervalEditor(description, parent);
    }
    ParameterEditor* operator()(const ViewOrAuto&) const {
      return new ViewEditor(description, parent);
    }
  };
  ParameterEditor* editor = std::visit(Maker{description, parent}, description.default_value);
  editor->setObjectName(text_of(description.key));
  return editor;
}

}  // namespace episcope

#include "moc_parameter_form.cpp"
