// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/sidecar_maps/map_file.h"
#include "engine/io/models/sidecar_maps/sidecar_labels.h"
#include "tests/test_main.h"

#include <algorithm>

namespace episcope::in_label_meaning_test {

class LabelMeaningTest : public QObject {
  Q_OBJECT

 private:
  using Numbers = std::vector<std::int32_t>;
  static ViewStack<std::int32_t> row(const Numbers& numbers) {
    ViewStack<std::int32_t> stack({1, 1}, 1, static_cast<int>(numbers.size()));
    std::ranges::copy(numbers, stack.data());
    return stack;
  }
  static Numbers numbers_of(const ViewStack<std::int32_t>& stack) {
    return {stack.data(), stack.data() + stack.size()};
  }
  static std::int32_t urban_color(int id) {
    return io::packed(io::urban_classes()[static_cast<std::size_t>(id - 1)].color);
  }

 private slots:
  void urbanClasses_haveIdsFromOneAndColorsOfTheirOwn() {
    const auto classes = io::urban_classes();

    QCOMPARE(classes.size(), std::size_t{14});
    for (int id = 1; id <= 14; ++id) {
      const LabelInfo& one = classes[static_cast<std::size_t>(id - 1)];
      QCOMPARE(one.id, id);
      QCOMPARE(io::urban_class_of(one.color), id);
    }
    QCOMPARE(io::urban_class_of({1, 2, 3}), 0);
  }

  void numbers_areBroughtIntoOneForm_data() {
    QTest::addColumn<Numbers>("stored");
    QTest::addColumn<bool>("is_urban");
    QTest::addColumn<Numbers>("expected");
    QTest::addColumn<bool>("raised");
    QTest::newRow("from 1") << Numbers{1, 2, 7} << false << Numbers{1, 2, 7} << false;
    QTest::newRow("0 = none") << Numbers{0, 1, 2} << false << Numbers{0, 1, 2} << false;
    QTest::newRow("255 = none") << Numbers{1, 2, 255} << false << Numbers{1, 2, 0} << false;
    QTest::newRow("−1 = none, from 0") << Numbers{0, 1, -1} << false << Numbers{1, 2, 0} << true;
    QTest::newRow("255 = none, from 0") << Numbers{0, 1, 255} << false << Numbers{1, 2, 0} << true;
    QTest::newRow("a mask of 0 and 255") << Numbers{0, 255} << false << Numbers{0, 255} << false;
    QTest::newRow("many") << Numbers{1, 255, 300} << false << Numbers{1, 255, 300} << false;
    QTest::newRow("UrbanLF 1 … 14") << Numbers{1, 14, 255} << true << Numbers{1, 14, 0} << false;
    QTest::newRow("UrbanLF 0 … 13") << Numbers{0, 13} << true << Numbers{1, 14} << true;
    QTest::newRow("UrbanLF with none") << Numbers{0, 1, 14} << true << Numbers{0, 1, 14} << false;
    QTest::newRow("a view without a map")
        << Numbers{1, io::kNoMap, 2} << false << Numbers{1, 0, 2} << false;
    QTest::newRow("from 0, a view without a map")
        << Numbers{0, io::kNoMap, 2} << true << Numbers{1, 0, 3} << true;
  }
  void numbers_areBroughtIntoOneForm() {
    QFETCH(Numbers, stored);
    QFETCH(bool, is_urban);
    QFETCH(Numbers, expected);
    QFETCH(bool, raised);
    ViewStack<std::int32_t> labels = row(stored);

    const io::LabelMeaning meaning = io::name_numbers(labels, {is_urban, false, {}});

    QCOMPARE(numbers_of(labels), expected);
    QCOMPARE(meaning.raised, raised);
  }

  void colors_tellWhetherNumbersBeginAtZero_data() {
    QTest::addColumn<int>("base");
    QTest::newRow("0 … 13") << 0;
    QTest::newRow("1 … 14") << 1;
  }
  void colors_tellWhetherNumbersBeginAtZero() {
    QFETCH(int, base);
    ViewStack<std::int32_t> labels = row({2 + base, 3 + base, 3 + base, 6 + base});
    io::LabelHints hints;
    hints.colors = row({urban_color(3), urban_color(4), urban_color(4), urban_color(7)});

    const io::LabelMeaning meaning = io::name_numbers(labels, hints);

    QCOMPARE(numbers_of(labels), (Numbers{3, 4, 4, 7}));
    QCOMPARE(meaning.raised, base == 0);
    QCOMPARE(meaning.infos.size(), std::size_t{14});
    QCOMPARE(meaning.infos[2].name, std::string("fence"));
  }

  void unknownColors_areThoseOfTheNumbers() {
    ViewStack<std::int32_t> labels = row({1, 2, 2, 0});
    io::LabelHints hints;
    hints.colors = row({0x102030, 0x405060, 0x405060, 0});

    const io::LabelMeaning meaning = io::name_numbers(labels, hints);

    QCOMPARE(numbers_of(labels), (Numbers{1, 2, 2, 0}));
    QVERIFY(!meaning.raised);
    QCOMPARE(meaning.infos, (std::vector<LabelInfo>{{1, "label 1", {0x10, 0x20, 0x30}},
                                                    {2, "label 2", {0x40, 0x50, 0x60}}}));
  }

  void urbanSize_namesTheClassesWithoutColors() {
    ViewStack<std::int32_t> labels = row({1, 2, 14});

    QCOMPARE(io::name_numbers(labels, {true, true, {}}).infos.size(), std::size_t{14});
    QVERIFY(io::name_numbers(labels, {true, false, {}}).infos.empty());
  }

  void pictures_ofUrbanColorsAreItsClasses() {
    ViewStack<std::int32_t> labels = row({urban_color(4), urban_color(14), io::kNoMap});

    const auto meaning = io::name_colors(labels);

    QVERIFY(meaning.has_value());
    QCOMPARE(numbers_of(labels), (Numbers{4, 14, 0}));
    QCOMPARE(meaning->infos.size(), std::size_t{14});
  }

  void pictures_ofOtherColorsHaveALabelForEach() {
    ViewStack<std::int32_t> labels = row({0xff0000, 0, 0x0000ff, 0xff0000});

    const auto meaning = io::name_colors(labels);

    QVERIFY(meaning.has_value());
    QCOMPARE(numbers_of(labels), (Numbers{2, 0, 1, 2}));
    QCOMPARE(meaning->infos[1].color, (Rgb{255, 0, 0}));
  }

  void photographs_areNoPicturesOfLabels() {
    Numbers many;
    for (int i = 0; i < 1000; ++i) many.push_back(1000 * i);
    ViewStack<std::int32_t> labels = row(many);

    QVERIFY(!io::name_colors(labels));
  }
};

}  // namespace episcope::in_label_meaning_test

EPISCOPE_TEST(label_meaning_test, LabelMeaningTest)

#include "label_meaning_test.moc"
