// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/parameter_help.h"
#include "tests/window_test_main.h"

#include <QImage>
#include <QPainter>

namespace episcope::in_parameter_help_test {

namespace {

QImage drawn(const ParameterDescription& description, const ParameterValue& value) {
  QImage image(200, 80, QImage::Format_RGB32);
  image.fill(Qt::magenta);
  QPainter painter(&image);
  draw_parameter(painter, image.rect(), description, value);
  painter.end();
  return image;
}

}  // namespace

class ParameterHelpTest : public QObject {
  Q_OBJECT

 private slots:
  void picture_followsTheValue_data() {
    QTest::addColumn<QString>("key");
    QTest::addColumn<double>("max");
    QTest::newRow("window") << "outer_scale" << 3.0;
    QTest::newRow("smoothing") << "lambda" << 10.0;
    QTest::newRow("edges") << "edge_strength" << 100.0;
    QTest::newRow("cap") << "truncation" << 5.0;
    QTest::newRow("power") << "weight_power" << 16.0;
    QTest::newRow("labels") << "labels" << 512.0;
    QTest::newRow("iterations") << "max_iterations" << 2000.0;
  }
  void picture_followsTheValue() {
    QFETCH(QString, key);
    QFETCH(double, max);
    ParameterDescription description;
    description.key = key.toStdString();
    description.default_value = max / 50;
    description.max = max;

    QVERIFY(!parameter_caption(description.key).isEmpty());
    QVERIFY(drawn(description, max / 50) != drawn(description, max / 20));
  }

  void pictureOfARange_showsItsSlopes() {
    ParameterDescription description;
    description.key = "range";
    description.default_value = IntervalOrAuto();

    QVERIFY(!parameter_caption("range").isEmpty());
    QVERIFY(drawn(description, IntervalOrAuto(Interval{-1, 1})) !=
            drawn(description, IntervalOrAuto(Interval{-0.5, 3})));
  }

  void option_isNamedAsOnTheCommandLine() {
    ParameterDescription description;
    description.key = "edge_strength";
    description.default_value = 1.0;

    QVERIFY(parameter_help(description).contains("--edge-strength"));
  }

  void parameterWithoutAPicture_drawsNone() {
    ParameterDescription description;
    description.key = "device";

    QVERIFY(parameter_caption(description.key).isEmpty());
    const QImage image = drawn(description, description.default_value);
    QCOMPARE(drawn(description, 7), image);
  }
};

}  // namespace episcope::in_parameter_help_test

EPISCOPE_WINDOW_TEST(parameter_help_test, ParameterHelpTest)
#include "parameter_help_test.moc"
