// SPDX-License-Identifier: BSD-3-Clause
#include "tests/accuracy/strokes.h"

#include "engine/core/error.h"
#include "engine/scenes/builtin.h"
#include "tests/accuracy/scene_sets.h"
#include "tests/test_main.h"

#include <algorithm>
#include <set>

namespace episcope::in_strokes_test {

using accuracy::StrokeStyle;

namespace {

constexpr int kSize = 192;

// A disc of label 2 in label 1, and a speck of label 3.
Image<std::int32_t> disc() {
  Image<std::int32_t> labels(kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const int dx = x - 60, dy = y - 70;
      labels.at(y, x) = dx * dx + dy * dy < 40 * 40 ? 2 : 1;
      if (x > 182 && y > 182) labels.at(y, x) = 3;
    }
  }
  return labels;
}

}  // namespace

class StrokesTest : public QObject {
  Q_OBJECT

 private slots:
  void strokes_stayInsideOfLargeLabels_data() {
    QTest::addColumn<QString>("style");
    for (const char* style : {"cross", "line", "dots"}) QTest::newRow(style) << style;
  }
  void strokes_stayInsideOfLargeLabels() {
    QFETCH(QString, style);
    const auto truth = disc();
    const auto kind = accuracy::stroke_style(style.toStdString());

    const auto strokes = accuracy::simulated_strokes(truth.view(), kind);

    std::set<std::int32_t> painted;
    int count = 0;
    for (std::size_t i = 0; i < strokes.size(); ++i) {
      const std::int32_t label = strokes.data()[i];
      if (label == 0) continue;
      QCOMPARE(label, truth.data()[i]);
      painted.insert(label);
      ++count;
    }
    QCOMPARE(painted, (std::set<std::int32_t>{1, 2}));
    QVERIFY(count > kSize * kSize / 1000 && count < kSize * kSize / 20);
    const auto again = accuracy::simulated_strokes(truth.view(), kind);
    QVERIFY(std::equal(strokes.begin(), strokes.end(), again.begin()));
  }

  void corrections_endWhenAllIsRight() {
    const auto truth = disc();
    Image<std::int32_t> labels(kSize, kSize);
    std::fill(labels.begin(), labels.end(), 1);
    Image<std::int32_t> strokes(kSize, kSize);

    // The disc is the largest wrong region; its middle is painted first.
    QVERIFY(accuracy::add_correction(labels.view(), truth.view(), strokes.view()));
    QCOMPARE(strokes.at(70, 60), 2);
    QVERIFY(std::ranges::count(strokes, 1) == 0 && std::ranges::count(strokes, 3) == 0);
    QVERIFY(std::ranges::count(strokes, 2) <= 8 * 40 + 60);
    QVERIFY(!accuracy::add_correction(truth.view(), truth.view(), strokes.view()));
  }

  void sets_chooseOnOddSeedsOnly() {
    for (const auto& set : accuracy::read_scene_sets(EPISCOPE_LABEL_SCENES)) {
      for (const auto& group : set.groups) {
        const StrokeStyle style = accuracy::stroke_style(group.name);
        for (const std::string& name : group.scenes) {
          QCOMPARE(name.starts_with("demo:"), style != StrokeStyle::Stored);
          if (style == StrokeStyle::Stored) continue;
          const auto request = scenes::read_request(name.substr(5));
          QCOMPARE(request.options.seed % 2 == 1, set.name != "reporting");
        }
      }
    }
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)accuracy::stroke_style("dot"));
  }
};

}  // namespace episcope::in_strokes_test

EPISCOPE_TEST(strokes_test, StrokesTest)
#include "strokes_test.moc"
