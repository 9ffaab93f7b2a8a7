// SPDX-License-Identifier: BSD-3-Clause
#include "tests/accuracy/ranges.h"

#include "engine/disparity/registry.h"
#include "tests/accuracy/scene_sets.h"
#include "tests/test_main.h"

#include <cmath>

namespace episcope::in_ranges_test {

using accuracy::FoundRange;
using accuracy::TwiceRange;

namespace {

constexpr int kSize = 128;

FoundRange range_of(Interval found, Interval truth, double covered) {
  FoundRange range;
  range.found = found;
  range.truth = truth;
  range.covered = covered;
  return range;
}

TwiceRange errors_of(const char* method, double once, double twice) {
  TwiceRange errors;
  errors.once.method = method;
  errors.once.mse_100 = once;
  errors.twice.mse_100 = twice;
  return errors;
}

Scene open(const std::string& name) {
  return *accuracy::open_scene_of_set("demo:" + name, kSize, {}, Progress());
}

}  // namespace

class RangesTest : public QObject {
  Q_OBJECT

 private slots:
  void ranges_mayBeAQuarterWiderAndALittle() {
    QVERIFY(range_of({-1.3, 1.4}, {-1, 1}, 1).is_narrow());
    QVERIFY(!range_of({-1.5, 1.4}, {-1, 1}, 1).is_narrow());
    QVERIFY(range_of({0.3, 0.55}, {0.4, 0.4}, 1).is_narrow());
    QVERIFY(range_of({}, {}, 0.995).covers());
    QVERIFY(!range_of({}, {}, 0.994).covers());
  }

  void summary_countsTheRangesThatPass() {
    const std::string text =
        accuracy::ranges_summary({range_of({-1, 1}, {-1, 1}, 1), range_of({-9, 9}, {-1, 1}, 1),
                                  range_of({0, 1}, {-1, 1}, 0.5)});

    QVERIFY2(text.starts_with("Of 3 ranges found 2 are") && text.find("and 2 hold") != text.npos,
             text.c_str());
  }

  void ratios_areAveragedByTheirLogarithms() {
    const std::string text = accuracy::twice_summary(
        {errors_of("A", 1, 4), errors_of("A", 4, 1), errors_of("B", 0, 0.0005)});

    QVERIFY2(text.find("| A | 2 | 1.00 | 4.00 | 1 |") != text.npos, text.c_str());
    QVERIFY2(text.find("| B | 1 | 1.00 | 1.00 | 1 |") != text.npos, text.c_str());
  }

  void twiceTheRange_hasTheSameMiddle() {
    const Scene scene = open("edge?size=48&grid=5x5");

    const TwiceRange errors = accuracy::measure_twice("edge", scene, find_estimator("epi_l"), {},
                                                      ViewSelection::Center, Progress());

    const Interval truth = errors.once.truth, once = errors.once.range, twice = errors.twice.range;
    QVERIFY(std::fabs(once.min - truth.min) < 1e-6 && std::fabs(once.max - truth.max) < 1e-6);
    QVERIFY(std::fabs(twice.length() - 2 * truth.length()) < 1e-6);
    QVERIFY(std::fabs(twice.min + twice.max - once.min - once.max) < 1e-6);
  }

  // Scenes of the choosing set; the table of the program has all.
  void rangesFound_areNarrowAndCover_data() {
    QTest::addColumn<QString>("name");
    for (const char* name :
         {"slant", "edge", "bars", "objects", "demo", "random?seed=1",
          "random?seed=3&kind=occlusion", "random?seed=1&kind=dark", "random?seed=3&kind=plain"}) {
      QTest::newRow(name) << name;
    }
  }
  void rangesFound_areNarrowAndCover() {
    QFETCH(QString, name);

    const FoundRange range = accuracy::find_range(open(name.toStdString()), Progress());

    QVERIFY2(range.is_narrow() && range.covers(), accuracy::ranges_row(range).c_str());
  }
};

}  // namespace episcope::in_ranges_test

EPISCOPE_TEST(ranges_test, RangesTest)
#include "ranges_test.moc"
