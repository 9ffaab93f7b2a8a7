// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/image_file.h"
#include "engine/io/open.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <fmt/format.h>
#include <QTemporaryDir>

namespace episcope::in_row_folders_test {

using namespace episcope::test;

namespace fs = std::filesystem;

/// A folder for each row of views, or column.
class RowFoldersTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  fs::path path() const { return fs::path(folder_->path().toStdString()); }
  void write(const Scene& scene, const std::string& form) const {
    const GridShape grid = scene.light_field->grid();
    for (int i = 0; i < grid.count(); ++i) {
      const ViewIndex view = grid.view_at(i);
      const fs::path file = path() / fmt::format(fmt::runtime(form), view.v, view.u, i,
                                                 static_cast<char>('A' + view.v));
      fs::create_directory(file.parent_path());
      io::write_png(file, scene.light_field->view<std::uint8_t>(view));
    }
  }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void foldersOfRows_areAGrid_data() {
    QTest::addColumn<QString>("form");
    for (const char* form : {"row_{0:02}/view_{1:03}.png", "{0}/{1}.png", "Row{0}/IMG_{2:04}.PNG",
                             "u{1}/v{0}.png", "row {0}/view_{0}_{1}.png"}) {
      QTest::newRow(form) << form;
    }
  }
  void foldersOfRows_areAGrid() {
    QFETCH(QString, form);
    const Scene scene = plane_scene({.grid = {5, 7}});
    write(scene, form.toStdString());

    const Scene read = io::open_scene(path(), {}, Progress(1));

    QCOMPARE(read.light_field->info().reading.reader, std::string("image_grid"));
    QVERIFY2(has_same_samples(read, scene), describe(read.convention).c_str());
    QCOMPARE(read.convention.files.front().count, 35);
  }

  void letteredRows_areAskedFor_data() {
    QTest::addColumn<QString>("form");
    QTest::addColumn<QString>("pattern");
    QTest::newRow("letter and digit") << "{3}{1}.png"
                                      << "{row}{col}.png";
    QTest::newRow("apart") << "cam_{3}_{1:02}.png"
                           << "cam_{row}_{col}.png";
  }
  void letteredRows_areAskedFor() {
    QFETCH(QString, form);
    QFETCH(QString, pattern);
    const Scene scene = plane_scene({.grid = {5, 7}});
    write(scene, form.toStdString());

    try {
      (void)io::open_scene(path(), {}, Progress(1));
      QFAIL("it was read");
    } catch (const IoError& error) {
      QVERIFY2(QString(error.what()).contains("--pattern, in which a letter may be a {row}"),
               error.what());
    }
    const Scene read = io::open_scene(path(), {.pattern = pattern.toStdString()}, Progress(1));
    QVERIFY2(has_same_samples(read, scene), describe(read.convention).c_str());
  }

  void mapsBesideRows_areNoViews() {
    const Scene scene = plane_scene({.grid = {5, 7}});
    write(scene, "row_{0}/view_{1}.png");
    write(scene, "row_{0}/view_{1}_valid.png");
    fs::create_directory(path() / "disparity");

    const Scene read = io::open_scene(path(), {}, Progress(1));

    QVERIFY2(has_same_samples(read, scene), describe(read.convention).c_str());
    QCOMPARE(read.convention.files.front().count, 35);
  }

  void asManyFoldersAsImages_areAGrid() {
    const Scene scene = plane_scene({.grid = {9, 9}});
    write(scene, "{0}/{1}.png");

    QVERIFY(has_same_samples(io::open_scene(path(), {}, Progress(1)), scene));
  }

  void foldersOfGrids_areASequence() {
    const Scene scene = plane_scene({.grid = {3, 3}});
    for (const int frame : {0, 1}) write(scene, fmt::format("{}/{{0}}_{{1}}.png", frame));

    const Scene read = io::open_scene(path(), {}, Progress(1));

    QCOMPARE(read.sequence.count, 2);
    QCOMPARE(read.light_field->grid(), (GridShape{3, 3}));
  }

  void missingView_leavesTheRestOfTheGrid() {
    const Scene scene = plane_scene({.grid = {5, 7}});
    write(scene, "row_{0}/{1}.png");
    fs::remove(path() / "row_3" / "6.png");

    const Scene read = io::open_scene(path(), {}, Progress(1));

    QCOMPARE(read.light_field->grid(), (GridShape{5, 6}));
    QVERIFY2(describe(read.convention).find("view 3,6 is missing") != std::string::npos,
             describe(read.convention).c_str());
  }

  void missingViewInSnakeOrder_isWhereItWasTaken() {
    const Scene scene = plane_scene({.grid = {5, 7}});
    for (int i = 0; i < 35; ++i) {
      const ViewIndex view = scene.light_field->grid().view_at(i);
      const int taken = view.v % 2 == 0 ? view.u : 6 - view.u;
      const fs::path file = path() / fmt::format("row_{}/{}.png", view.v, taken);
      fs::create_directory(file.parent_path());
      if (i != 21) io::write_png(file, scene.light_field->view<std::uint8_t>(view));
    }

    const Scene read = io::open_scene(path(), {.snake = true}, Progress(1));

    QCOMPARE(read.light_field->grid(), (GridShape{5, 6}));
    QVERIFY2(describe(read.convention).find("view 3,0 is missing") != std::string::npos,
             describe(read.convention).c_str());
    const auto found = read.light_field->view<std::uint8_t>({3, 0});
    const auto wanted = scene.light_field->view<std::uint8_t>({3, 1});
    QVERIFY(std::equal(wanted.data, wanted.data + wanted.size(), found.data));
  }

  void missingView_namesItsFolderWhereImagesAreNumberedOn() {
    write(plane_scene({.grid = {5, 7}}), "row_{0}/{2}.png");
    fs::remove(path() / "row_3" / "27.png");

    try {
      (void)io::open_scene(path(), {}, Progress(1));
      QFAIL("it was read");
    } catch (const IoError& error) {
      QVERIFY2(std::string(error.what()).find("row_3 holds 6 images") != std::string::npos,
               error.what());
    }
  }
};

}  // namespace episcope::in_row_folders_test

EPISCOPE_TEST(row_folders_test, RowFoldersTest)
#include "row_folders_test.moc"
