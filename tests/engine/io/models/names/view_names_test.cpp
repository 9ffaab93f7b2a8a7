// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/names/view_names.h"
#include "engine/core/error.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>

namespace episcope::in_view_names_test {

namespace fs = std::filesystem;

namespace {

using Name = std::function<std::string(int row, int column)>;
using Filled = std::function<bool(int row, int column)>;

template <class... Values>
std::string print(const char* form, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, form, values...);
  return text;
}

/// A folder of names without files, sorted as in a folder.
std::vector<fs::path> names_of(GridShape grid, const Name& name) {
  std::vector<fs::path> names;
  for (int row = 0; row < grid.v; ++row) {
    for (int column = 0; column < grid.u; ++column) names.emplace_back(name(row, column));
  }
  std::ranges::sort(names);
  return names;
}

struct Form {
  const char* pattern;  ///< That is to be found.
  GridShape grid;
  Name name;
};

/// Names of full grids in many forms.
std::vector<Form> grid_forms() {
  return {
      {"Original Camera_{row}_{col}_{y}_{x}_30_36.jpg",
       {27, 27},
       [](int r, int c) {
         return print("Original Camera_%02d_%02d_%f_%f_30_36.jpg", r, c, 400 - r * 92.307692 / 3,
                      -369.230769 + c * 92.307692 / 3);
       }},
      {"out_{row}_{col}__{y}_{x}_.png",
       {3, 4},
       [](int r, int c) { return print("out_%d_%d__%f_%f_.png", r, c, 5.5 * r, -0.5 * c); }},
      {"out_{row}_{col}_{y}_{x}.png",
       {4, 3},
       [](int r, int c) { return print("out_%02d_%02d_%g_%g.png", r, c, -1e-7 * r, 2.5 * c); }},
      {"toys.{row}.{col}.png", {5, 4}, [](int r, int c) { return print("toys.%d.%d.png", r, c); }},
      {"{row}_{col}.png", {3, 5}, [](int r, int c) { return print("%d_%d.png", r, c); }},
      {"{row}_{col}.png", {3, 12}, [](int r, int c) { return print("%d_%d.png", r + 1, c + 1); }},
      {"scene7_view_{row}-{col}.tif",
       {3, 3},
       [](int r, int c) { return print("scene7_view_%03d-%d.tif", r, c); }},
      {"2067_{row}_{col}.png",
       {9, 9},
       [](int r, int c) { return print("2067_%02d_%02d.png", r + 1, c + 1); }},
      {"view-{row}-{col}.png", {3, 4}, [](int r, int c) { return print("view-%d-%d.png", r, c); }},
      {"*_{row}_{col}.png",
       {4, 6},
       [](int r, int c) { return print("%04d_%d_%d.png", 6 * r + c, r, c); }},
      {"{row}_{col}_*.png",
       {5, 5},
       [](int r, int c) { return print("%d_%d_%d.png", r, c, 5 * r + c + 1); }},
      {"im_{row}_{col}_*_*.png",
       {3, 4},
       [](int r, int c) { return print("im_%d_%d_%d_%d.png", r, c, 120 * c, 90 * r); }},
      {"out_{row}_{col}_*_*.png",
       {3, 3},
       [](int r, int c) { return print("out_%02d_%02d_%d_%d.png", r, c, 2 - r, 2 - c); }},
      {"view_u{col}_v{row}.png",
       {3, 5},
       [](int r, int c) { return print("view_u%02d_v%02d.png", c, r); }},
      {"x{col}_y{row}.png", {3, 5}, [](int r, int c) { return print("x%d_y%d.png", c, r); }},
      {"r{row}_c{col}.png",
       {3, 5},
       [](int r, int c) { return print("r%d_c%d.png", r + 1, c + 1); }},
      {"viewCol{col}Row{row}.png",
       {3, 5},
       [](int r, int c) { return print("viewCol%dRow%d.png", c, r); }},
      {"{row}row_{col}col.png",
       {3, 5},
       [](int r, int c) { return print("%drow_%dcol.png", r, c); }},
      {"{col}s_{row}t.png", {3, 5}, [](int r, int c) { return print("%ds_%dt.png", c, r); }},
      {"Cam{row}{col}.png",
       {9, 9},
       [](int r, int c) { return print("Cam%d%d.png", r + 1, c + 1); }},
      {"a{row}{col}_b.png", {5, 7}, [](int r, int c) { return print("a%d%d_b.png", r, c); }},
      {"{row}{col}.png", {17, 17}, [](int r, int c) { return print("%02d%02d.png", r, c); }},
      {"s3_{row}_{col}.png",
       {5, 7},
       [](int r, int c) { return print("s3_%d_%d.png", r - 2, c - 3); }},
      {"u{col}_v{row}.png",
       {3, 5},
       [](int r, int c) { return print("u%d_v%d.png", c - 2, r - 1); }},
      {"{y}_{x}.png",
       {5, 3},
       [](int r, int c) { return print("%.1f_%.1f.png", -25 + 12.5 * r, 7.5 * c); }},
      {"cam_x{x}_y{y}.png",
       {3, 5},
       [](int r, int c) { return print("cam_x%g_y%g.png", -5 + 2.5 * c, 0.25 * r); }},
      {"cam_x{x}mm_y{y}mm.png",
       {3, 5},
       [](int r, int c) {
         return print("cam_x%+.1fmm_y%+.1fmm.png", -5 + 2.5 * c, 2.5 * r - 2.5);
       }},
      {"f_{row}_{col}.png", {1, 7}, [](int, int c) { return print("f_00_%02d.png", c); }},
      {"f_{row}_{col}.png", {7, 1}, [](int r, int) { return print("f_%d_1.png", r + 1); }},
  };
}

QString refusal_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const IoError& error) {
    return error.what();
  }
  return {};
}

io::PlacedViews place(const std::vector<fs::path>& names) {
  return io::place_views("folder", io::find_view_names("folder", names));
}

}  // namespace

/// Rows and columns from names alone; none of the files exists.
class ViewNamesTest : public QObject {
  Q_OBJECT

 private slots:
  void formOfNames_isFound_data();
  void formOfNames_isFound();
  void positions_areKept();
  void singleIndex_isAList_data();
  void singleIndex_isAList();
  void missingViews_leaveALargestPart_data();
  void missingViews_leaveALargestPart();
  void scatteredViews_areRefused();
  void everySecondView_isAGridAndSaid();
  void unclearNumbers_needAPattern_data();
  void unclearNumbers_needAPattern();
  void viewsComeBeforeWhatBelongsToThem();
  void oneViewTwice_isRefused();
  void hundredThousandNames_takeSeconds();
};

void ViewNamesTest::formOfNames_isFound_data() {
  QTest::addColumn<int>("form");
  const std::vector<Form> forms = grid_forms();
  for (std::size_t i = 0; i < forms.size(); ++i) {
    const std::string grid = print(" %dx%d", forms[i].grid.v, forms[i].grid.u);
    QTest::newRow((forms[i].pattern + grid).c_str()) << static_cast<int>(i);
  }
}

void ViewNamesTest::formOfNames_isFound() {
  QFETCH(int, form);
  const Form expected = grid_forms()[static_cast<std::size_t>(form)];

  const std::vector<fs::path> names = names_of(expected.grid, expected.name);
  const io::ViewNames found = io::find_view_names("folder", names);
  const io::PlacedViews placed = io::place_views("folder", found);

  QCOMPARE(QString::fromStdString(found.pattern), QString(expected.pattern));
  QCOMPARE(placed.views.grid, expected.grid);
  QVERIFY(!placed.is_list && placed.warnings.empty());
  for (int i = 0; i < expected.grid.count(); ++i) {
    const ViewIndex view = expected.grid.view_at(i);
    QCOMPARE(placed.views.files[static_cast<std::size_t>(i)].string(),
             expected.name(view.v, view.u));
  }
  // The pattern that was found finds the same when it is given.
  const io::PlacedViews again =
      io::place_views("folder", io::match_view_names(names, found.pattern));
  QVERIFY(again.views.files == placed.views.files);
}

void ViewNamesTest::positions_areKept() {
  const auto placed = place(names_of({3, 3}, [](int r, int c) {
    return print("Cam 2_%d_%d_%g_%g.png", r, c, 100.0 - 12.5 * r, -1.5 * c);
  }));

  QCOMPARE(placed.positions.size(), std::size_t{9});
  QCOMPARE(placed.positions[5].y, 87.5);
  QCOMPARE(placed.positions[5].x, -3.0);

  const auto words = place(names_of({3, 3}, [](int r, int c) {
    return print("%d_%d_x%.2f_y%.2f.png", r, c, 0.25 * c, 0.5 * r);
  }));

  QCOMPARE(words.positions[5].x, 0.5);
  QCOMPARE(words.positions[5].y, 0.5);
}

void ViewNamesTest::singleIndex_isAList_data() {
  QTest::addColumn<QString>("form");
  QTest::addColumn<int>("first");
  QTest::addColumn<QString>("pattern");
  QTest::newRow("plain") << "%d.png" << 0 << "{index}.png";
  QTest::newRow("padded") << "img_%04d.png" << 1 << "img_{index}.png";
  QTest::newRow("from 100") << "shot%d.png" << 100 << "shot{index}.png";
  QTest::newRow("other number") << "scene1_%03d.png" << 0 << "scene1_{index}.png";
  QTest::newRow("constant row") << "f_08_%02d.png" << 0 << "f_08_{index}.png";
}

void ViewNamesTest::singleIndex_isAList() {
  QFETCH(QString, form);
  QFETCH(int, first);
  QFETCH(QString, pattern);

  const auto names =
      names_of({1, 12}, [&](int, int column) { return print(qPrintable(form), first + column); });
  const io::ViewNames found = io::find_view_names("folder", names);
  const io::PlacedViews placed = io::place_views("folder", found);

  QCOMPARE(QString::fromStdString(found.pattern), pattern);
  QVERIFY(placed.is_list);
  QCOMPARE(placed.views.grid, (GridShape{1, 12}));
  QCOMPARE(placed.views.files.back().string(), print(qPrintable(form), first + 11));
}

void ViewNamesTest::missingViews_leaveALargestPart_data() {
  QTest::addColumn<Filled>("is_there");
  QTest::addColumn<QString>("first");
  QTest::addColumn<QString>("last");
  QTest::addColumn<int>("count");
  QTest::addColumn<QString>("sentence");
  const auto row = [](const char* name, Filled is_there, const char* first, const char* last,
                      int count, const char* sentence) {
    QTest::newRow(name) << is_there << first << last << count << sentence;
  };
  row(
      "one", [](int r, int c) { return r != 3 || c != 5; }, "v_0_0.png", "v_6_4.png", 35,
      "view 3,5 is missing");
  row(
      "two corners", [](int r, int c) { return (r != 0 || c != 1) && (r != 6 || c != 6); },
      "v_1_0.png", "v_6_5.png", 36, "2 views are missing: 0,1 6,6 (");
  row(
      "a row", [](int r, int) { return r != 2; }, "v_3_0.png", "v_6_6.png", 28,
      "7 views are missing: 2,0 2,1 2,2 2,3 2,4 … (");
  row(
      "every second", [](int r, int c) { return (r + c) % 2 == 0; }, "v_0_0.png", "v_6_6.png", 16,
      "rows 0, 2 … 6 and columns 0, 2 … 6");
  row(
      "a cross", [](int r, int c) { return r == 3 || c == 3; }, "v_3_0.png", "v_3_6.png", 7,
      "a cross of row 3 and column 3");
}

void ViewNamesTest::missingViews_leaveALargestPart() {
  QFETCH(Filled, is_there);
  QFETCH(QString, first);
  QFETCH(QString, last);
  QFETCH(int, count);
  QFETCH(QString, sentence);
  std::vector<fs::path> names = names_of({7, 7}, [&](int r, int c) {
    return is_there(r, c) ? print("v_%d_%d.png", r, c) : std::string();
  });
  std::erase(names, fs::path());

  const io::PlacedViews placed = place(names);

  QCOMPARE(placed.views.grid.count(), count);
  QCOMPARE(QString::fromStdString(placed.views.files.front().string()), first);
  QCOMPARE(QString::fromStdString(placed.views.files.back().string()), last);
  QCOMPARE(placed.views.left_out.size(), names.size() - placed.views.files.size());
  QVERIFY2(placed.warnings.front().find(sentence.toStdString()) != std::string::npos,
           placed.warnings.front().c_str());
}

void ViewNamesTest::scatteredViews_areRefused() {
  std::vector<fs::path> names = names_of({9, 9}, [&](int r, int c) {
    return (7 * r + 5 * c) % 11 < 3 ? print("v_%d_%d.png", r, c) : std::string();
  });
  std::erase(names, fs::path());

  const QString sentence = refusal_of([&] { (void)place(names); });

  QVERIFY2(sentence.contains("views are missing: 0,1 0,2 0,3") && sentence.contains("--pattern"),
           qPrintable(sentence));
}

void ViewNamesTest::everySecondView_isAGridAndSaid() {
  const auto even =
      place(names_of({4, 5}, [](int r, int c) { return print("%02d_%02d.png", 2 * r, 2 * c); }));
  QCOMPARE(even.views.grid, (GridShape{4, 5}));
  QCOMPARE(even.warnings.size(), std::size_t{2});
  QVERIFY(even.warnings[0].find("rows 0, 2 … 6: the grid is subsampled") != std::string::npos);

  const auto part =
      place(names_of({3, 3}, [](int r, int c) { return print("%d_%d.png", r + 2, c + 2); }));
  QCOMPARE(part.views.grid, (GridShape{3, 3}));

  const auto shifted =
      place(names_of({3, 3}, [](int r, int c) { return print("%d_%d.png", r, c + 1); }));
  QCOMPARE(shifted.warnings.size(), std::size_t{1});
}

void ViewNamesTest::unclearNumbers_needAPattern_data() {
  QTest::addColumn<int>("kind");
  QTest::newRow("three indices") << 0;
  QTest::newRow("two pairs of equal right") << 1;
  QTest::newRow("negative, in unequal steps") << 2;
  QTest::newRow("frames of cameras") << 3;
  QTest::newRow("no numbers") << 4;
}

void ViewNamesTest::unclearNumbers_needAPattern() {
  QFETCH(int, kind);
  const auto names = names_of({8, 4}, [&](int r, int c) {
    if (kind == 0) return print("%d_%d_%d.png", r / 4, r % 4, c);
    if (kind == 1) return print("%d_%d_%d.png", r % 4, c, (r % 4 + c) % 4);
    if (kind == 2) return print("view_%d_%d.png", r * r - 4, c - 2);
    if (kind == 3) return print("cam%d_frame%d.png", r, c);
    return std::string(1, static_cast<char>('a' + r)) + static_cast<char>('a' + c) + ".png";
  });
  auto unique = names;
  unique.erase(std::unique(unique.begin(), unique.end()), unique.end());

  const QString sentence = refusal_of([&] { (void)place(unique); });

  QVERIFY2(sentence.contains("--pattern"), qPrintable(sentence));
}

void ViewNamesTest::viewsComeBeforeWhatBelongsToThem() {
  std::vector<fs::path> names;
  for (const char* form : {"%d_%d_label.png", "depth_%d_%d.png", "%d_%d.png", "gt/%d_%d.txt.png",
                           "sceneMask%d_%d.png", "view%dthumb%d.png"}) {
    const auto more = names_of(
        {3, 3}, [&](int r, int c) { return fs::path(print(form, r, c)).filename().string(); });
    names.insert(names.end(), more.begin(), more.end());
  }
  // More labels than views do not matter.
  names.emplace_back("4_4_label.png");
  std::erase_if(names, [](const fs::path& name) { return name.string().ends_with(".txt.png"); });

  QCOMPARE(io::find_view_names("folder", names).pattern, std::string("{row}_{col}.png"));
}

void ViewNamesTest::oneViewTwice_isRefused() {
  auto names = names_of({2, 2}, [](int r, int c) { return print("%d_%d.png", r, c); });
  names.emplace_back("01_1.png");

  const QString sentence = refusal_of([&] { (void)place(names); });

  QVERIFY2(sentence.contains("same place"), qPrintable(sentence));
}

// Measured: below a second, in computing time; the rest is for slow machines and sanitizers.
void ViewNamesTest::hundredThousandNames_takeSeconds() {
  const std::clock_t begin = std::clock();
  const auto grid = names_of({250, 400}, [](int r, int c) { return print("f_%d_%d.png", r, c); });
  QCOMPARE(place(grid).views.grid, (GridShape{250, 400}));
  const auto odd = names_of({100000, 1}, [](int r, int) {
    return print("f_%lld_%lld_%d.png", r * 7919LL % 1000003, r * 104729LL % 1000003, r % 7);
  });
  QVERIFY(refusal_of([&] { (void)place(odd); }).contains("--pattern"));
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  QVERIFY2(seconds < 30, QByteArray::number(seconds));
}

}  // namespace episcope::in_view_names_test

EPISCOPE_TEST(view_names_test, ViewNamesTest)
#include "view_names_test.moc"
