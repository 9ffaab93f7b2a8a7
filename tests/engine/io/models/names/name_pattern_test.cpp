// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/names/name_pattern.h"
#include "engine/core/error.h"
#include "engine/io/models/names/view_folders.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <ctime>
#include <fstream>

namespace episcope::in_name_pattern_test {

namespace fs = std::filesystem;

namespace {

/// "2,3", "7", "2,3 at 1.5,-2"; "no" for a name that does not match.
QString text_of(const std::optional<io::NamedView>& view) {
  if (!view) return "no";
  QStringList place;
  for (const auto& number : {view->row, view->column, view->index}) {
    if (number) place << QString::number(*number);
  }
  if (!view->y) return place.join(',');
  return QString("%1 at %2,%3").arg(place.join(',')).arg(*view->y).arg(view->x.value_or(0));
}

QString refusal_of(const std::string& pattern) {
  try {
    (void)io::NamePattern(pattern);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

/// A folder of empty files; names are all that is looked at.
class Files {
 public:
  explicit Files(const QStringList& names) {
    for (const QString& name : names) std::ofstream(path() / name.toStdString()) << "x";
  }
  fs::path path() const { return folder_.path().toStdString(); }

 private:
  QTemporaryDir folder_;
};

}  // namespace

/// Patterns that users give for names of views.
class NamePatternTest : public QObject {
  Q_OBJECT

 private slots:
  void pattern_readsTheName_data();
  void pattern_readsTheName();
  void wrongPattern_isExplained_data();
  void wrongPattern_isExplained();
  void cunningPattern_takesNoTime_data();
  void cunningPattern_takesNoTime();
  void preview_showsWhatMatches();
  void preview_saysWhyNot_data();
  void preview_saysWhyNot();
  void preview_showsThePartWithoutGaps();
  void preview_turnsRowsOfASnake();
};

void NamePatternTest::pattern_readsTheName_data() {
  QTest::addColumn<QString>("pattern");
  QTest::addColumn<QString>("name");
  QTest::addColumn<QString>("expected");
  const auto row = [](const char* pattern, const char* name, const char* expected) {
    QTest::newRow((std::string(pattern) + " of " + name).c_str()) << pattern << name << expected;
  };
  row("view_{row}_{col}.png", "view_02_3.png", "2,3");
  row("view_{row}_{col}.png", "VIEW_02_3.PNG", "2,3");
  row("view_{row}_{col}.png", "view_02_3.png.bak", "no");
  row("view_{row}_{col}.png", "view_02_ab.png", "no");
  row("view_{row}{col}.png", "view_C4.png", "3,4");
  row("{index}.png", "c.png", "no");
  row("c{col}r{row}_*.png", "c2r3_t17.png", "3,2");
  row("{row}_{col}.*", "-4_+2.tif", "-4,2");
  row("*{index}.png", "take 7 of 12.png", "12");
  row("* {index} of *.png", "take 7 of 12.png", "7");
  row("?{index}?.png", "é12x.png", "12");
  row("out_{row}_{col}_{y}_{x}.png", "out_02_03_1.5_-2e1.png", "2,3 at 1.5,-20");
  row("o_{index}_{x}_*", "o_5_1.25_.png", "5");
  row("scan_{col}.jpg", "scan_012.jpg", "12");
  row("a[{index}].png", "a[3].png", "3");
  row("{index}.png", "12345678901234567890.png", "no");
  row("re:view(?<row>[0-9]+)of(?<col>\\d+).*", "view2of03.png", "2,3");
  row("re:v(?<row>.)(?<col>.)\\.jpg", "v53.jpg", "5,3");
  row("re:(a|(b))[(](?P<index>\\d+)\\)(?:x)?.png", "b(6).png", "6");
  row("re:(?<row>\\d)_(?<col>\\d)_(?<y>[-.0-9]+)_(?<x>[-.0-9]+)", "1_2_-1.5_.25",
      "1,2 at -1.5,0.25");
  row("re:(?<row>\\d)_(?<col>\\d)", "1_2.png", "no");
  row("re:(?<row>\\w+)_(?<col>\\d).png", "a_2.png", "1,2");
  row("re:(?<row>\\w+)_(?<col>\\d).png", "ab_2.png", "no");
}

void NamePatternTest::pattern_readsTheName() {
  QFETCH(QString, pattern);
  QFETCH(QString, name);
  QFETCH(QString, expected);

  const io::NamePattern compiled(pattern.toStdString());

  QCOMPARE(text_of(compiled.match("folder/" + name.toStdString())), expected);
}

void NamePatternTest::wrongPattern_isExplained_data() {
  QTest::addColumn<QString>("pattern");
  QTest::addColumn<QString>("expected");
  const auto row = [](const char* pattern, const char* expected) {
    QTest::newRow(pattern) << pattern << expected;
  };
  row("view.png", "must contain {row} and {col}, or {index}");
  row("{row}_{index}.png", "must contain {row} and {col}, or {index}");
  row("{row}_{row}_{col}.png", "the field row twice");
  row("{row}_{column}.png", "unknown field '{column}'");
  row("{row}_{col", "unknown field '{col'");
  row("re:a(b)", "the groups (?<row>");
  row("re:(?<row>.)(?<col>.)(b", "lacks a ) or a (");
  row("re:(?<row>.)(?<col>.)[a", "lacks a ] or a [");
  row("re:*(?<index>.)", "repeats nothing");
  row("re:(?<line>.)", "unknown group 'line'; there are row, col, index, y and x");
  row("re:(?<index>.)\\1", "refers back");
  row("re:(?<index>.)\\99999999999999999999", "refers back");
  row("re:(?<index>.){1,99999999999999999999}", "too large");
  QTest::newRow("long") << QString("{index}") + QString(300, 'a') << "longer than 250";
}

void NamePatternTest::wrongPattern_isExplained() {
  QFETCH(QString, pattern);
  QFETCH(QString, expected);

  const QString sentence = refusal_of(pattern.toStdString());

  QVERIFY2(sentence.contains(expected), qPrintable(sentence));
}

void NamePatternTest::cunningPattern_takesNoTime_data() {
  QTest::addColumn<QString>("pattern");
  QTest::newRow("wildcards") << QString("*a").repeated(60) + "{index}";
  QTest::newRow("nested repeats") << "re:(?<index>[0-9]+)(a+)+$";
  QTest::newRow("alternatives") << "re:(?<index>[0-9]+)(a|aa|a?)*b";
  QTest::newRow("counted") << "re:(?<index>[0-9]+)((a{1,9}){1,9}){1,9}b";
}

void NamePatternTest::cunningPattern_takesNoTime() {
  QFETCH(QString, pattern);
  const std::string name = "1" + std::string(240, 'a') + ".png";
  const std::clock_t begin = std::clock();

  const auto view = io::NamePattern(pattern.toStdString()).match(name);

  // Backtracking would take years.
  QVERIFY(!view);
  QVERIFY(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC < 20);
}

void NamePatternTest::preview_showsWhatMatches() {
  const Files files({"take-1of1.png", "take-2of1.png", "take-1of2.png", "take-2of2.png",
                     "take-1of3.png", "take-2of3.png", "thumb.png", "note.txt"});

  const io::PatternPreview preview =
      io::preview_pattern(files.path(), "take-{col}of{row}.png", false);

  QVERIFY2(preview.problem.empty(), preview.problem.c_str());
  QCOMPARE(preview.detected, std::string("take-{row}of{col}.png"));
  QCOMPARE(preview.grid, (GridShape{3, 2}));
  QCOMPARE(preview.images, 7);
  QCOMPARE(preview.matches, 6);
  QCOMPARE(preview.names.size(), std::size_t{7});
  QCOMPARE(preview.names[4].name, std::string("take-2of2.png"));
  QCOMPARE(*preview.names[4].row, 2LL);
  QCOMPARE(*preview.names[4].view, (ViewIndex{1, 1}));
  QVERIFY(!preview.names[6].is_match && !preview.names[6].view);

  const io::PatternPreview detected = io::preview_pattern(files.path(), "", false);
  QCOMPARE(detected.grid, (GridShape{2, 3}));
}

void NamePatternTest::preview_saysWhyNot_data() {
  QTest::addColumn<QString>("pattern");
  QTest::addColumn<QString>("expected");
  QTest::newRow("wrong") << "{row}{"
                         << "unknown field";
  QTest::newRow("none") << "view_{row}_{col}.png"
                        << "0 of 5 images match";
  QTest::newRow("regex") << "re:(?<row>."
                         << "lacks a )";
}

void NamePatternTest::preview_saysWhyNot() {
  QFETCH(QString, pattern);
  QFETCH(QString, expected);
  const Files files({"v0_0.png", "v0_1.png", "v0_2.png", "v1_0.png", "v1_1.png"});

  const io::PatternPreview preview =
      io::preview_pattern(files.path(), pattern.toStdString(), false);

  QVERIFY2(QString::fromStdString(preview.problem).contains(expected), preview.problem.c_str());
  QCOMPARE(preview.names.size(), std::size_t{5});
}

void NamePatternTest::preview_showsThePartWithoutGaps() {
  const Files files({"v0_0.png", "v0_1.png", "v0_2.png", "v1_0.png", "v1_1.png"});

  const io::PatternPreview preview = io::preview_pattern(files.path(), "", false);

  QVERIFY2(preview.problem.empty(), preview.problem.c_str());
  QCOMPARE(preview.grid, (GridShape{2, 2}));
  QVERIFY(!preview.names[2].view && *preview.names[4].view == (ViewIndex{1, 1}));
}

void NamePatternTest::preview_turnsRowsOfASnake() {
  const Files files({"0_0.png", "0_1.png", "0_2.png", "1_0.png", "1_1.png", "1_2.png"});

  const io::PatternPreview preview = io::preview_pattern(files.path(), "", true);

  QCOMPARE(*preview.names[2].view, (ViewIndex{0, 2}));
  QCOMPARE(*preview.names[3].view, (ViewIndex{1, 2}));
}

}  // namespace episcope::in_name_pattern_test

EPISCOPE_TEST(name_pattern_test, NamePatternTest)
#include "name_pattern_test.moc"
