// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <algorithm>
#include <limits>

namespace episcope::in_shared_data_test {

using namespace episcope::test;

namespace fs = std::filesystem;

namespace {

/// Folder of real light fields, which are no part of the project.
fs::path data_folder() {
  const QByteArray named = qgetenv("EPISCOPE_SHARED_DATA");
  return named.isEmpty() ? fs::path(EPISCOPE_SHARED_DATA_FALLBACK) : fs::path(named.toStdString());
}

Interval range_of(const DisparityView& map) {
  Interval range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (int y = 0; y < map.disparity.height; ++y) {
    for (int x = 0; x < map.disparity.width; ++x) {
      if (!map.is_valid(y, x)) continue;
      range.min = std::min<double>(range.min, map.disparity.at(y, x));
      range.max = std::max<double>(range.max, map.disparity.at(y, x));
    }
  }
  return range;
}

}  // namespace

/// Opens real files where available.
class SharedDataTest : public QObject {
  Q_OBJECT

 private slots:
  void realFolder_opensInOrder_data() {
    QTest::addColumn<QString>("folder");
    QTest::addColumn<int>("side");
    QTest::addColumn<int>("width");
    QTest::addColumn<double>("min");
    QTest::addColumn<double>("max");
    QTest::addColumn<bool>("is_reversed");
    // Ranges in px per view step as published with the data; NaN = no truth.
    const double none = std::numeric_limits<double>::quiet_NaN();
    QTest::newRow("archive") << "still_life" << 9 << 512 << -1.169 << 1.502 << false;
    QTest::newRow("benchmark") << "cotton" << 9 << 512 << -1.4647 << 1.3643 << false;
    QTest::newRow("archive excerpt")
        << "archive_excerpt_3x3" << 3 << 768 << -10.827 << 10.252 << false;
    QTest::newRow("Stanford") << "stanford_17x17" << 17 << 256 << none << none << true;
  }
  void realFolder_opensInOrder() {
    QFETCH(QString, folder);
    QFETCH(int, side);
    QFETCH(int, width);
    QFETCH(double, min);
    QFETCH(double, max);
    QFETCH(bool, is_reversed);
    const fs::path path = data_folder() / folder.toStdString();
    if (!fs::exists(path)) QSKIP("the data are not here");

    const Scene scene = io::open_scene(path, {}, Progress());

    QCOMPARE(scene.light_field->grid(), (GridShape{side, side}));
    QCOMPARE(scene.light_field->width(), width);
    QCOMPARE(scene.light_field->channels(), 3);
    QCOMPARE(scene.light_field->info().name, folder.toStdString());
    QVERIFY2(
        scene.convention.reversed_u == is_reversed && scene.convention.reversed_v == is_reversed,
        describe(scene.convention).c_str());
    QCOMPARE(scene.convention.sign, std::string("checked"));
    QVERIFY(scene.convention.order_check.starts_with("checked"));
    QCOMPARE(scene.truth->has_disparity(), !std::isnan(min));
    if (std::isnan(min)) return;
    const Interval range = range_of(scene.truth->field.view(scene.light_field->center()));
    // The published figures have three or four digits.
    QVERIFY2(std::abs(range.min - min) < 0.01 && std::abs(range.max - max) < 0.01,
             QByteArray::number(range.min) + " " + QByteArray::number(range.max));
  }
};

}  // namespace episcope::in_shared_data_test

EPISCOPE_TEST(shared_data_test, SharedDataTest)
#include "shared_data_test.moc"
