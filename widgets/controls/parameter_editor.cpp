// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/parameter_editor.h"

#include "widgets/controls/layout.h"
#include "widgets/controls/number_spin.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"

#include <QCheckBox>
#include <QComboBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QSlider>
#include <QSpinBox>

#include <algorithm>
#include <cmath>

namespace episcope {
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
  auto* spin = named(control_name(description, control), new NumberSpin(parent));
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
    if (const auto* flag = std::get_if<bool>(&value)) Quietly(check_)->setChecked(*flag);
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
    Quietly(combo_)->setCurrentIndex(combo_->findData(text_of(*text)));
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

QString ends_text(Interval ends, const std::string& unit) {
  const QString text =
      QStringLiteral("%1 … %2").arg(number_text(ends.min, 2), number_text(ends.max, 2));
  return unit.empty() ? text : text + ' ' + schema_text(unit);
}

/// One choice: automatic, found, or by hand, which shows two ends of which the lower one stays
/// below the upper one.
class IntervalEditor : public ParameterEditor {
 public:
  IntervalEditor(const ParameterDescription& description, QWidget* parent)
      : ParameterEditor(parent),
        domain_{description.min, description.max},
        unit_(description.unit),
        source_(new QComboBox(this)),
        ends_row_(new QWidget(this)),
        min_(make_spin(description, "min", ends_row_)),
        max_(make_spin(description, "max", ends_row_)) {
    source_->setObjectName(control_name(description, "source"));
    source_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    new WheelGuard(source_);
    min_->setSuffix({});
    for (auto* end : {min_, max_}) end->setButtonSymbols(QAbstractSpinBox::NoButtons);
    min_->setMinimumWidth(44);
    ends_ = {std::max(domain_.min, -1.0), std::min(domain_.max, 1.0)};
    if (ends_.length() <= 0) ends_ = domain_;
    auto* ends = make_row(ends_row_);
    ends->addWidget(min_, 1);
    ends->addWidget(new QLabel("…", ends_row_));
    ends->addWidget(max_, 1);
    make_column(this, {source_, ends_row_}, {.spacing = 2});
    IntervalEditor::setValue(description.default_value);
    connect(source_, &QComboBox::currentIndexChanged, this, [this] { choose(); });
    connect(min_, &NumberSpin::valueChanged, this, [this](double value) {
      edit({value, std::max(ends_.max, value + least())});
    });
    connect(max_, &NumberSpin::valueChanged, this, [this](double value) {
      edit({std::min(ends_.min, value - least()), value});
    });
  }

  [[nodiscard]] ParameterValue value() const override {
    switch (kind_) {
      case Kind::Automatic:
        return IntervalOrAuto{};
      case Kind::Found:
        return IntervalOrAuto::found();
      case Kind::Given:
        break;
    }
    return IntervalOrAuto(ends_);
  }

  void setValue(const ParameterValue& value) override {
    const auto* interval = std::get_if<IntervalOrAuto>(&value);
    if (!interval) return;
    kind_ = *interval ? Kind::Given : interval->is_found ? Kind::Found : Kind::Automatic;
    if (*interval) {
      ends_ = **interval;
      were_given_ = true;
    }
    showSource();
    showEnds();
  }

  void setRangeHints(const RangeHints& hints) override {
    hints_ = hints;
    showSource();
  }

 private:
  enum class Kind { Automatic, Found, Given };

  /// Least length of the interval: one unit of the last decimal.
  [[nodiscard]] double least() const { return std::pow(10.0, -min_->decimals()); }

  /// The range that the images show, with its ends where they are known.
  [[nodiscard]] QString foundText() const {
    return hints_.found ? ParameterEditor::tr("Found: %1").arg(ends_text(*hints_.found, unit_))
                        : ParameterEditor::tr("Found in the images");
  }
  [[nodiscard]] QString automaticText() const {
    if (!hints_.is_open) return ParameterEditor::tr("Automatic");
    return hints_.promised ? ParameterEditor::tr("File: %1").arg(ends_text(*hints_.promised, unit_))
                           : foundText();
  }

  /// Without a promise of the file, automatic is found: one of them will do.
  void showSource() {
    const QSignalBlocker blocker(source_);
    source_->clear();
    const auto add = [this](const QString& text, Kind kind) {
      source_->addItem(text, static_cast<int>(kind));
      source_->setItemData(source_->count() - 1, text, Qt::ToolTipRole);
    };
    const bool is_one = hints_.is_open && !hints_.promised;
    if (!is_one || kind_ != Kind::Found) add(automaticText(), Kind::Automatic);
    if (!is_one || kind_ == Kind::Found) add(foundText(), Kind::Found);
    add(ParameterEditor::tr("By hand"), Kind::Given);
    source_->setCurrentIndex(source_->findData(static_cast<int>(kind_)));
    ends_row_->setVisible(kind_ == Kind::Given);
  }

  /// By hand begins with what is known.
  void choose() {
    kind_ = static_cast<Kind>(source_->currentData().toInt());
    if (kind_ == Kind::Given && !were_given_) {
      if (const auto known = hints_.promised ? hints_.promised : hints_.found) ends_ = *known;
      were_given_ = true;
      showEnds();
    }
    ends_row_->setVisible(kind_ == Kind::Given);
    emit edited();
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
  std::string unit_;
  Interval ends_;
  RangeHints hints_;
  Kind kind_ = Kind::Automatic;
  bool were_given_ = false;
  QComboBox* source_;
  QWidget* ends_row_;
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
    auto* place = named(control_name(description, name), new QSpinBox(this));
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

#include "moc_parameter_editor.cpp"
