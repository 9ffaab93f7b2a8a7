// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/parameter_form.h"
#include "engine/core/schema.h"
#include "tests/window_test_main.h"
#include "widgets/controls/number_spin.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QSignalSpy>
#include <QSlider>
#include <QSpinBox>
#include <QToolButton>

#include <cmath>

namespace episcope::in_parameter_form_test {

namespace {

enum class Fusion { Weighted, Best };

Names<Fusion> names_of(Fusion) {
  return {{Fusion::Weighted, "weighted"}, {Fusion::Best, "best"}};
}

struct Parameters {
  double inner = 0.8;
  double weight = 0.2;
  int scales = 3;
  bool edges = true;
  Fusion fusion = Fusion::Weighted;
  IntervalOrAuto range;
  ViewOrAuto view;
};

Schema<Parameters> schema() {
  Schema<Parameters> s;
  s.real("inner", &Parameters::inner, {"Inner scale", "Width of the filter.", "px"}, {0.4, 3})
      .real("weight", &Parameters::weight, {"Smoothing", "Weight <of> data."}, {0.001, 10, true})
      .integer("scales", &Parameters::scales, {"Scales", "How many."}, {1, 5})
      .flag("edges", &Parameters::edges, {"Edges", "Stop at edges."})
      .choice("fusion", &Parameters::fusion, {"Fusion", "How."});
  s.interval("range", &Parameters::range, {"Range", "Searched.", "px"}, {-8, 8});
  s.view("view", &Parameters::view, {"View", "Which."});
  return s;
}

template <class T>
T get(const ParameterForm& form, const std::string& key) {
  for (const auto& [name, value] : form.values()) {
    if (name == key) return std::get<T>(value);
  }
  qFatal("no such parameter");
}

}  // namespace

class ParameterFormTest : public QObject {
  Q_OBJECT

  ParameterForm form_;

  template <class Widget>
  Widget* control(const char* name) {
    return form_.findChild<Widget*>(name);
  }

  QStringList sources() {
    const auto* combo = control<QComboBox>("range.source");
    QStringList texts;
    for (int i = 0; i < combo->count(); ++i) texts << combo->itemText(i);
    return texts;
  }
  void choose(const QString& source) { control<QComboBox>("range.source")->setCurrentText(source); }

  /// Whether every value lies in its domain.
  bool is_accepted() const {
    try {
      return schema().values(schema().parse(form_.values())) == form_.values();
    } catch (const InvalidInput&) {
      return false;
    }
  }

 private slots:
  void init() {
    form_.setRangeHints({});
    form_.setAdvancedShown(false);
    form_.setParameters(schema().descriptions());
  }

  void freshForm_holdsTheDefaults() {
    QVERIFY(form_.values() == schema().values(Parameters{}));
    QVERIFY(form_.modifiedValues().empty());
  }

  void values_goThroughFormAndSchemaUnchanged() {
    Parameters parameters;
    parameters.inner = 1.2345678901234;  // More digits than the spin box shows.
    parameters.weight = 0.0042;
    parameters.scales = 5;
    parameters.edges = false;
    parameters.fusion = Fusion::Best;
    parameters.range = Interval{-1.25, 3.5};
    parameters.view = ViewIndex{2, 7};

    form_.setValues(schema().values(parameters));
    const Parameters back = schema().parse(form_.values());

    QCOMPARE(back.inner, parameters.inner);
    QCOMPARE(back.weight, parameters.weight);
    QCOMPARE(back.scales, 5);
    QCOMPARE(back.edges, false);
    QCOMPARE(back.fusion, parameters.fusion);
    QVERIFY(back.range == parameters.range);
    QVERIFY(back.view == parameters.view);
    QCOMPARE(int(form_.modifiedValues().size()), 7);
  }

  void setValues_clampsAndIgnoresWhatDoesNotFit() {
    QSignalSpy changed(&form_, &ParameterForm::valuesChanged);

    form_.setValues({{"inner", 99.0},
                     {"scales", -7},
                     {"edges", std::string("no flag")},
                     {"fusion", std::string("unknown")},
                     {"no-such-key", 1.0},
                     {"range", IntervalOrAuto(Interval{-100, 2})}});

    QCOMPARE(get<double>(form_, "inner"), 3.0);
    QCOMPARE(get<int>(form_, "scales"), 1);
    QCOMPARE(get<bool>(form_, "edges"), true);
    QCOMPARE(get<std::string>(form_, "fusion"), std::string("weighted"));
    QVERIFY(get<IntervalOrAuto>(form_, "range") == IntervalOrAuto(Interval{-8, 2}));
    QCOMPARE(changed.size(), 0);
    QVERIFY(is_accepted());
  }

  void typing_changesTheValueAndIsClamped() {
    QSignalSpy changed(&form_, &ParameterForm::valuesChanged);
    auto* spin = control<QDoubleSpinBox>("inner.spin");

    spin->selectAll();
    QTest::keyClicks(spin, "2.5");
    QTest::keyClick(spin, Qt::Key_Return);
    QCOMPARE(get<double>(form_, "inner"), 2.5);
    QCOMPARE(changed.size(), 1);
    spin->setValue(7);
    QCOMPARE(get<double>(form_, "inner"), 3.0);
  }

  void sliderEnds_areTheDomain() {
    auto* slider = control<QSlider>("weight.slider");

    slider->setValue(slider->maximum());
    QCOMPARE(get<double>(form_, "weight"), 10.0);
    slider->setValue(slider->minimum());
    QCOMPARE(get<double>(form_, "weight"), 0.001);
  }

  void logarithmicSlider_movesInPowers() {
    auto* slider = control<QSlider>("weight.slider");
    const int quarter = slider->maximum() / 4;

    // Four decades: a quarter of the way is a factor of ten.
    slider->setValue(quarter);
    QVERIFY(std::abs(get<double>(form_, "weight") - 0.01) < 1e-4);
    slider->setValue(2 * quarter);
    QVERIFY(std::abs(get<double>(form_, "weight") - 0.1) < 1e-4);
    slider->setValue(3 * quarter);
    QVERIFY(std::abs(get<double>(form_, "weight") - 1) < 1e-4);
  }

  void integerSlider_stepsByOne() {
    auto* slider = control<QSlider>("scales.slider");

    QCOMPARE(slider->maximum() - slider->minimum(), 4);
    slider->setFocus();
    QTest::keyClick(slider, Qt::Key_Right);
    QCOMPARE(get<int>(form_, "scales"), 4);
  }

  void flagAndChoice_followTheirControls() {
    control<QCheckBox>("edges.check")->click();
    QTest::keyClick(control<QComboBox>("fusion.combo"), Qt::Key_Down);

    QCOMPARE(get<bool>(form_, "edges"), false);
    QCOMPARE(get<std::string>(form_, "fusion"), std::string("best"));
  }

  void interval_keepsItsEndsApart() {
    choose("By hand");
    auto* min = control<QDoubleSpinBox>("range.min");
    auto* max = control<QDoubleSpinBox>("range.max");
    QVERIFY(!min->isHidden());

    for (const double value : {3.0, 8.0}) {
      min->setValue(value);
      const auto range = get<IntervalOrAuto>(form_, "range");
      QVERIFY(range && range->min < range->max);
      QVERIFY(is_accepted());
    }
    max->setValue(-8);
    const auto range = get<IntervalOrAuto>(form_, "range");
    QVERIFY(range && range->min < range->max);
    choose("Automatic");
    QVERIFY(!get<IntervalOrAuto>(form_, "range"));
  }

  void interval_isOneChoice() {
    QSignalSpy changed(&form_, &ParameterForm::valuesChanged);

    choose("Found in the images");
    QVERIFY(get<IntervalOrAuto>(form_, "range") == IntervalOrAuto::found());
    QVERIFY(!control<QDoubleSpinBox>("range.min")->isVisibleTo(&form_));
    QVERIFY(is_accepted());
    choose("Automatic");
    QVERIFY(get<IntervalOrAuto>(form_, "range") == IntervalOrAuto{});
    QCOMPARE(changed.size(), 2);
    choose("By hand");
    QVERIFY(control<QDoubleSpinBox>("range.min")->isVisibleTo(&form_));
  }

  void rangeOfTheFile_isNamedAndBeginsTheOneByHand() {
    form_.setRangeHints({true, Interval{-1.5, 2}, {}});
    QCOMPARE(sources(), (QStringList{"File: −1.50 … 2.00 px", "Found in the images", "By hand"}));

    choose("By hand");

    QVERIFY(get<IntervalOrAuto>(form_, "range") == IntervalOrAuto(Interval{-1.5, 2}));
  }

  void rangeThatWasFound_isOneChoiceWithoutAFileThatPromisesOne() {
    QSignalSpy changed(&form_, &ParameterForm::valuesChanged);

    form_.setRangeHints({true, {}, Interval{-0.5, 0.75}});

    QCOMPARE(sources(), (QStringList{"Found: −0.50 … 0.75 px", "By hand"}));
    QVERIFY(get<IntervalOrAuto>(form_, "range") == IntervalOrAuto{});
    // A value that asks to find it stays what it is, as one choice too.
    form_.setValues({{"range", IntervalOrAuto::found()}});
    QCOMPARE(sources().size(), 2);
    QVERIFY(get<IntervalOrAuto>(form_, "range") == IntervalOrAuto::found());
    QCOMPARE(changed.size(), 0);
  }

  void givenRange_isKeptByHints() {
    form_.setValues({{"range", IntervalOrAuto(Interval{-3, 3})}});

    form_.setRangeHints({true, Interval{-1.5, 2}, Interval{-1, 1}});

    QVERIFY(get<IntervalOrAuto>(form_, "range") == IntervalOrAuto(Interval{-3, 3}));
    QCOMPARE(control<QComboBox>("range.source")->currentText(), QString("By hand"));
  }

  void parametersBesidesTheMainOnes_areFolded() {
    form_.setParameters(schema().descriptions(), {"range", "weight"});
    auto* fold = control<QToolButton>("parameters.advanced");
    const auto is_seen = [&](const char* key) {
      return control<QLabel>((std::string(key) + ".label").c_str())->isVisibleTo(&form_);
    };
    QCOMPARE(fold->text(), QString("Advanced (5)"));
    QVERIFY(is_seen("range") && is_seen("weight") && !is_seen("inner") && !is_seen("view"));

    fold->click();
    QVERIFY(is_seen("inner") && is_seen("view"));
    // Another method leaves them as they are.
    form_.setParameters(schema().descriptions(), {"inner"});
    QVERIFY(is_seen("weight"));
    form_.setAdvancedShown(false);
    QVERIFY(is_seen("inner") && !is_seen("weight"));
  }

  void foldedParameters_haveTheirValuesAndTellChanges() {
    form_.setParameters(schema().descriptions(), {"range"});

    form_.setValues({{"inner", 2.0}, {"scales", 4}});

    QCOMPARE(get<double>(form_, "inner"), 2.0);
    QCOMPARE(control<QToolButton>("parameters.advanced")->text(),
             QString("Advanced (6, 2 changed)"));
    form_.resetToDefaults();
    QCOMPARE(control<QToolButton>("parameters.advanced")->text(), QString("Advanced (6)"));
    QVERIFY(form_.values() == schema().values(Parameters{}));
  }

  void mainParameters_comeInTheirOrder() {
    form_.setParameters(schema().descriptions(), {"range", "inner"});
    form_.resize(form_.sizeHint());
    form_.show();

    QVERIFY(control<QLabel>("range.label")->y() < control<QLabel>("inner.label")->y());
    form_.hide();
  }

  void help_isOneClickAway() {
    form_.show();

    control<QToolButton>("inner.help")->click();

    const auto* help = control<QLabel>("parameterHelp.text");
    QVERIFY(help && help->isVisible());
    QVERIFY(help->text().contains("Width of the filter."));
    QVERIFY(!control<QWidget>("parameterHelp.picture"));  // of no key that it is drawn for
    QTest::keyClick(help->window(), Qt::Key_Escape);
    form_.hide();
    form_.setParameters(schema().descriptions());
    control<QToolButton>("range.help")->click();
    QVERIFY(control<QWidget>("parameterHelp.picture"));
    control<QWidget>("parameterHelp.picture")->window()->close();
  }

  void view_isChosenByRowAndColumn() {
    auto* v = control<QSpinBox>("view.v");
    QVERIFY(!v->isEnabled());

    control<QCheckBox>("view.auto")->click();
    v->setValue(3);
    control<QSpinBox>("view.u")->setValue(5);

    QVERIFY(get<ViewOrAuto>(form_, "view") == (ViewIndex{3, 5}));
    QVERIFY(is_accepted());
    control<QCheckBox>("view.auto")->click();
    QVERIFY(!get<ViewOrAuto>(form_, "view"));
  }

  void modifiedParameter_isMarkedAndReset() {
    auto* label = control<QLabel>("inner.label");
    auto* reset = control<QToolButton>("inner.reset");
    QVERIFY(!label->font().bold());
    QVERIFY(reset->isHidden());

    control<QDoubleSpinBox>("inner.spin")->setValue(1.5);
    QVERIFY(label->font().bold());
    QVERIFY(!reset->isHidden());
    reset->click();

    QVERIFY(!label->font().bold());
    QCOMPARE(get<double>(form_, "inner"), 0.8);
  }

  void preset_movesRowsAtTheirDefaultAndNoOthers() {
    Schema<Parameters> with_preset = schema();
    with_preset.preset("fusion", "best", {{"scales", 5}, {"weight", 1.0}});
    form_.setParameters(with_preset.descriptions());
    form_.setValues({{"weight", 0.5}});
    auto* const combo = form_.findChild<QComboBox*>("fusion.combo");

    combo->setCurrentIndex(1);
    emit combo->activated(1);
    QCOMPARE(get<int>(form_, "scales"), 5);
    QCOMPARE(get<double>(form_, "weight"), 0.5);
    QCOMPARE(form_.modifiedValues().size(), std::size_t{2});  // the choice itself and the weight

    form_.findChild<QToolButton*>("weight.reset")->click();
    QCOMPARE(get<double>(form_, "weight"), 1.0);
    form_.resetToDefaults();
    QCOMPARE(get<int>(form_, "scales"), 3);
    QCOMPARE(get<double>(form_, "weight"), 0.2);
    QVERIFY(form_.modifiedValues().empty());
  }

  void setValues_takesThePresetAndWhatIsGivenBesideIt() {
    Schema<Parameters> with_preset = schema();
    with_preset.preset("fusion", "best", {{"scales", 5}, {"weight", 1.0}});
    form_.setParameters(with_preset.descriptions());

    form_.setValues({{"weight", 0.2}, {"fusion", std::string("best")}});

    QCOMPARE(get<int>(form_, "scales"), 5);
    QCOMPARE(get<double>(form_, "weight"), 0.2);
  }

  void resetToDefaults_resetsAllAtOnce() {
    form_.setValues({{"inner", 2.0}, {"scales", 4}, {"edges", false}});
    QSignalSpy changed(&form_, &ParameterForm::valuesChanged);

    form_.resetToDefaults();

    QVERIFY(form_.values() == schema().values(Parameters{}));
    QCOMPARE(changed.size(), 1);
  }

  void toolTip_tellsHelpRangeUnitAndDefault() {
    const QString tip = control<QLabel>("inner.label")->toolTip();

    for (const char* part : {"Width of the filter.", "0.4", "3 px", "0.8 px", "--inner"}) {
      QVERIFY2(tip.contains(part), part);
    }
    // Help is text, not markup.
    QVERIFY(control<QLabel>("weight.label")->toolTip().contains("&lt;of&gt;"));
  }

  void choice_showsItsLabel_andStandsForItsName() {
    ParameterDescription description;
    description.key = "fusion";
    description.default_value = std::string("best");
    description.choices = {"weighted", "best"};
    description.choice_labels = {"Weighted mean", "The better one"};
    form_.setParameters({description});
    auto* combo = control<QComboBox>("fusion.combo");
    QCOMPARE(combo->currentText(), QString("The better one"));

    combo->setCurrentText("Weighted mean");

    QCOMPARE(get<std::string>(form_, "fusion"), std::string("weighted"));
  }

  void textParameter_isEdited() {
    ParameterDescription description;
    description.key = "note";
    description.default_value = std::string("none");
    form_.setParameters({description});
    auto* line = control<QLineEdit>("note.text");

    line->selectAll();
    QTest::keyClicks(line, "abc");

    QCOMPARE(get<std::string>(form_, "note"), std::string("abc"));
  }

  void numberScale_isInverseOfItself_data() {
    QTest::addColumn<double>("min");
    QTest::addColumn<double>("max");
    QTest::addColumn<bool>("logarithmic");
    QTest::newRow("linear") << -3.0 << 5.0 << false;
    QTest::newRow("powers") << 0.001 << 10.0 << true;
    QTest::newRow("powers from zero") << 0.0 << 10.0 << true;
    QTest::newRow("powers from below zero") << -1.0 << 1.0 << true;
    QTest::newRow("single value") << 2.0 << 2.0 << true;
  }

  void numberScale_isInverseOfItself() {
    QFETCH(double, min);
    QFETCH(double, max);
    QFETCH(bool, logarithmic);
    const NumberScale scale(min, max, logarithmic, 200);

    QCOMPARE(scale.value(0), min);
    QCOMPARE(scale.value(200), max);
    for (int position = 0; position <= 200; ++position) {
      const double value = scale.value(position);
      QVERIFY(value >= min && value <= max);
      QVERIFY(max == min || scale.position(value) == position);
    }
  }
};

}  // namespace episcope::in_parameter_form_test

EPISCOPE_WINDOW_TEST(parameter_form_test, ParameterFormTest)
#include "parameter_form_test.moc"
