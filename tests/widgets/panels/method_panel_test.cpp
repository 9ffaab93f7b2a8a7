// SPDX-License-Identifier: BSD-3-Clause
#include "tests/window_test_main.h"
#include "widgets/controls/parameter_form.h"
#include "widgets/panels/method_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QCoreApplication>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>

namespace episcope::in_method_panel_test {

namespace {

ParameterDescription number(const std::string& key, double value) {
  ParameterDescription description;
  description.key = description.label = key;
  description.default_value = value;
  description.max = 10;
  return description;
}

std::vector<MethodDescription> methods() {
  return {{"epi_l", "EPI_L", "local", "Wanner 2012", true, {number("inner", 0.8)}},
          {"stereo", "ST_CH", "stereo", "Wanner 2013", false, {number("weight", 2)}}};
}

}  // namespace

class MethodPanelTest : public QObject {
  Q_OBJECT

  template <class Widget>
  static Widget* control(MethodPanel& panel, const char* name) {
    return panel.findChild<Widget*>(name);
  }

 private slots:
  void run_givesMethodValuesAndViews() {
    MethodPanel panel;
    panel.setMethods(methods());
    QSignalSpy run(&panel, &MethodPanel::runRequested);
    control<QDoubleSpinBox>(panel, "inner.spin")->setValue(1.5);

    control<QPushButton>(panel, "method.run")->click();

    QCOMPARE(run.size(), 1);
    const auto request = run[0][0].value<RunRequest>();
    QCOMPARE(request.method, std::string("epi_l"));
    QVERIFY(request.values == (ParameterSet{{"inner", 1.5}}));
    QVERIFY(request.all_views);
  }

  void copyCommand_givesTheSameRequest() {
    MethodPanel panel;
    panel.setMethods(methods());
    QSignalSpy copy(&panel, &MethodPanel::copyCommandRequested);
    control<QCheckBox>(panel, "method.allViews")->click();

    control<QPushButton>(panel, "method.copyCommand")->click();

    QCOMPARE(copy.size(), 1);
    QVERIFY(!copy[0][0].value<RunRequest>().all_views);
  }

  void choosingAMethod_showsItsTextAndForm() {
    MethodPanel panel;
    panel.setMethods(methods());
    QSignalSpy changed(&panel, &MethodPanel::methodChanged);

    QTest::keyClick(control<QComboBox>(panel, "method.combo"), Qt::Key_Down);

    QCOMPARE(changed.size(), 1);
    QCOMPARE(changed[0][0].toString(), QString("stereo"));
    QCOMPARE(control<QLabel>(panel, "method.summary")->text(), QString("stereo"));
    QCOMPARE(control<QLabel>(panel, "method.reference")->text(), QString("Wanner 2013"));
    QVERIFY(panel.request().values == (ParameterSet{{"weight", 2.0}}));
    QVERIFY(!control<QCheckBox>(panel, "method.allViews")->isEnabled());
    QVERIFY(!panel.request().all_views);
  }

  void values_areKeptWhileAnotherMethodIsChosen() {
    MethodPanel panel;
    panel.setMethods(methods());
    control<QDoubleSpinBox>(panel, "inner.spin")->setValue(3);

    panel.setCurrentMethod("stereo");
    panel.setCurrentMethod("epi_l");

    QVERIFY(panel.request().values == (ParameterSet{{"inner", 3.0}}));
  }

  void setRequest_bringsAnEarlierRunBack() {
    MethodPanel panel;
    panel.setMethods(methods());

    panel.setRequest({"epi_l", {{"inner", 4.0}}, false});

    QVERIFY(panel.request().values == (ParameterSet{{"inner", 4.0}}));
    QVERIFY(!panel.request().all_views);
    control<QPushButton>(panel, "method.reset")->click();
    QVERIFY(panel.request().values == (ParameterSet{{"inner", 0.8}}));
  }

  void setRequestOfAnUnknownMethod_changesNothing() {
    MethodPanel panel;
    panel.setMethods(methods());
    const auto before = panel.request();

    panel.setRequest({"nonsense", {{"inner", 4.0}}, false});

    QCOMPARE(panel.request().method, before.method);
    QVERIFY(panel.request().values == before.values);
  }

  void form_fitsIntoANarrowPanel() {
    auto description = number("inner", 0.8);
    description.label = "A label of more words than a narrow panel has room for";
    auto all = methods();
    all[0].parameters = {description};
    MethodPanel panel;
    panel.setMethods(all);
    panel.show();

    panel.resize(panel.minimumSizeHint().width(), 400);
    QCoreApplication::processEvents();

    const auto* spin = control<QDoubleSpinBox>(panel, "inner.spin");
    const QPoint corner = spin->mapTo(&panel, QPoint(spin->width(), 0));
    QVERIFY(panel.width() < 320);
    QVERIFY2(corner.x() <= panel.width(), qPrintable(QString::number(corner.x())));
  }

  void buttons_followTheState() {
    MethodPanel panel;
    QVERIFY(!control<QPushButton>(panel, "method.run")->isEnabled());
    panel.setMethods(methods());
    QVERIFY(control<QPushButton>(panel, "method.run")->isEnabled());

    panel.setRunBlocked("The light field has one view.");
    QVERIFY(!control<QPushButton>(panel, "method.run")->isEnabled());
    QCOMPARE(control<QPushButton>(panel, "method.run")->toolTip(),
             QString("The light field has one view."));
    QVERIFY(!control<QPushButton>(panel, "method.copyCommand")->isEnabled());
    panel.setRunning(true);
    QSignalSpy cancel(&panel, &MethodPanel::cancelRequested);
    control<QPushButton>(panel, "method.cancel")->click();
    QCOMPARE(cancel.size(), 1);
    panel.setRunning(false);
    QVERIFY(!control<QPushButton>(panel, "method.cancel")->isEnabled());
  }
};

}  // namespace episcope::in_method_panel_test

EPISCOPE_WINDOW_TEST(method_panel_test, MethodPanelTest)
#include "method_panel_test.moc"
