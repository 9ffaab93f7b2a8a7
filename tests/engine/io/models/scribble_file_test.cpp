// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/scribble_file.h"
#include "engine/core/error.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/open.h"
#include "tests/engine/io/archive_files.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <fstream>

namespace episcope::in_scribble_file_test {

using namespace episcope::test;

namespace {

constexpr int kHeight = 64;
constexpr int kWidth = 80;

ViewScribbles painted_view(ViewIndex view, PixelIndex pixel, int id) {
  ViewScribbles painted{view, Image<std::int32_t>(kHeight, kWidth)};
  painted.labels.at(pixel.y, pixel.x) = id;
  return painted;
}

Scribbles some_scribbles() {
  Scribbles scribbles;
  scribbles.views.push_back(painted_view({0, 3}, {5, 6}, 255));
  scribbles.views.push_back(painted_view({2, 2}, {7, 8}, 1));
  scribbles.labels = {{1, "Löwe; \"groß\"", {1, 2, 3}},
                      {9, "unused", {250, 128, 0}},
                      {255, "last", {255, 255, 255}}};
  return scribbles;
}

void compare(const Scribbles& a, const Scribbles& b) {
  QCOMPARE(a.views.size(), b.views.size());
  for (std::size_t i = 0; i < a.views.size(); ++i) {
    QCOMPARE(a.views[i].view, b.views[i].view);
    QVERIFY(std::ranges::equal(a.views[i].labels, b.views[i].labels));
  }
  QVERIFY(a.labels == b.labels);
}

std::vector<std::uint8_t> bytes_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::size_t count_files(const std::filesystem::path& folder) {
  const std::filesystem::directory_iterator all(folder);
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

}  // namespace

class ScribbleFileTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  std::filesystem::path path(const char* name) const {
    return std::filesystem::path(folder_->path().toStdString()) / name;
  }
  // A scene of another program: raw order, with true labels that begin at 0 in labels.h5.
  Scene foreign_scene(io::ViewFlip flip) {
    RawArchive form;
    form.flip = flip;
    write_raw_archive(path("lf.h5"), plane_scene(), form);
    io::AtomicFile target(path("labels.h5"));
    io::Hdf5Output file(target);
    std::vector<std::uint8_t> labels(5 * 5 * kHeight * kWidth, 1);
    std::fill_n(labels.begin(), kHeight * kWidth, 0);  // view (0, 0) as stored
    add_bytes(file, "GT_LABELS", {5, 5, kHeight, kWidth}, labels);
    std::vector<std::int32_t> scribbles(kHeight * kWidth, -1);
    scribbles[5] = 0;
    file.add_dataset<std::int32_t>("SCRIBBLES", {kHeight, kWidth}, "", "");
    file.write("SCRIBBLES", {{0, 0}, {kHeight, kWidth}}, scribbles.data());
    file.set_numbers("/", "hRes", {5});
    file.set_text("/", "author", "somebody");
    file.add_group("more");
    add_bytes(file, "more/data", {3}, {1, 2, 3});
    file.close();
    target.commit();
    return io::open_scene(path("lf.h5"), {}, Progress(1));
  }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void scribblesSavedBeside_goBeforeThoseOfTheFileItself() {
    RawArchive form;
    form.more = [](io::Hdf5Output& file) {
      add_bytes(file, "GT_LABELS", {5, 5, kHeight, kWidth},
                std::vector<std::uint8_t>(5 * 5 * kHeight * kWidth, 3));
      std::vector<std::uint8_t> scribbles(kHeight * kWidth, 0);
      scribbles[5] = 7;
      add_bytes(file, "SCRIBBLES", {kHeight, kWidth}, scribbles);
    };
    write_raw_archive(path("lf.h5"), plane_scene(), form);
    const Scene scene = io::open_scene(path("lf.h5"), {}, Progress(1));
    QCOMPARE(scene.scribbles.views.size(), std::size_t{1});

    io::write_scribbles(path("labels.h5"), some_scribbles(), scene, Progress(1));

    const Scene again = io::open_scene(path("lf.h5"), {}, Progress(1));
    compare(again.scribbles, some_scribbles());
    QVERIFY(!again.truth->labels.empty());
  }

  void scribbles_comeBack_data() {
    QTest::addColumn<bool>("has_many_views");
    QTest::newRow("one view") << false;
    QTest::newRow("several views") << true;
  }
  void scribbles_comeBack() {
    QFETCH(bool, has_many_views);
    const Scene scene = plane_scene();
    Scribbles scribbles = some_scribbles();
    if (!has_many_views) scribbles.views.pop_back();

    io::write_scribbles(path("mine.h5"), scribbles, scene, Progress(1));

    compare(io::read_scribbles(path("mine.h5"), scene, Progress(1)), scribbles);
    const io::Hdf5Shape view{kHeight, kWidth};
    const io::Hdf5Shape all{5, 5, kHeight, kWidth};
    QCOMPARE(io::Hdf5Input(path("mine.h5")).dataset("SCRIBBLES").shape,
             has_many_views ? all : view);
  }

  void labelsWithoutPaint_comeBack() {
    const Scene scene = plane_scene();
    Scribbles scribbles = some_scribbles();
    scribbles.views.clear();

    io::write_scribbles(path("mine.h5"), scribbles, scene, Progress(1));

    compare(io::read_scribbles(path("mine.h5"), scene, Progress(1)), scribbles);
  }

  void savedBesideALightField_theyAreOpenedWithIt() {
    Scene scene = plane_scene();
    scene.scribbles = {};
    scene.truth = std::make_shared<GroundTruth>();
    io::write_archive(path("lf.h5"), scene, Progress(1));
    const Scene opened = io::open_scene(path("lf.h5"), {}, Progress(1));
    QVERIFY(opened.scribbles.empty());

    io::write_scribbles(path("labels.h5"), some_scribbles(), opened, Progress(1));

    compare(io::open_scene(path("lf.h5"), {}, Progress(1)).scribbles, some_scribbles());
  }

  void scribblesOfAScene_keepNamesAndViewsInTheArchive() {
    Scene scene = plane_scene();
    scene.scribbles = some_scribbles();

    io::write_archive(path("lf.h5"), scene, Progress(1));

    compare(io::open_scene(path("lf.h5"), {}, Progress(1)).scribbles, some_scribbles());
  }

  void filesOfOthers_keepEverythingElse_data() {
    QTest::addColumn<bool>("is_reversed");
    QTest::newRow("as stored") << false;
    QTest::newRow("u reversed") << true;
  }
  void filesOfOthers_keepEverythingElse() {
    QFETCH(bool, is_reversed);
    const Scene scene = foreign_scene({is_reversed, false});
    const ViewIndex corner{0, is_reversed ? 4 : 0};
    QVERIFY(scene.convention.raised_labels);
    QCOMPARE(scene.truth->labels.view(corner).at(3, 3), 1);
    QCOMPARE(scene.scribbles.views.at(0).labels.at(0, 5), 1);

    for (int i = 0; i < 2; ++i) {  // over the file of the others, then over our own
      io::write_scribbles(path("labels.h5"), some_scribbles(), scene, Progress(1));

      const Scene again = io::open_scene(path("lf.h5"), {}, Progress(1));
      compare(again.scribbles, some_scribbles());
      const auto& was = scene.truth->labels;
      QVERIFY(std::equal(was.data(), was.data() + was.size(), again.truth->labels.data()));
      const auto read = io::read_true_labels(path("labels.h5"), again, Progress(1));
      QVERIFY(std::equal(was.data(), was.data() + was.size(), read.data()));
    }

    const io::Hdf5Input file(path("labels.h5"));
    QCOMPARE(file.text("/", "author"), std::optional<std::string>("somebody"));
    QCOMPARE(file.numbers("/", "hRes"), std::vector{5.0});
    QCOMPARE(file.dataset("GT_LABELS").type, io::Hdf5Type::UInt8);
    std::vector<std::uint8_t> stored(kHeight * kWidth);
    file.read("GT_LABELS", {{0, 0, 0, 0}, {1, 1, kHeight, kWidth}}, stored.data());
    QCOMPARE(int{stored[7]}, 0);  // not raised in the file
    std::uint8_t more[3] = {};
    file.read("more/data", {{0}, {3}}, more);
    QCOMPARE(int{more[2]}, 3);
    // In the order of the file: the canonical view (0, 3) is its (0, 1) if reversed.
    std::vector<std::int32_t> view(kHeight * kWidth);
    file.read("SCRIBBLES", {{0, is_reversed ? 1U : 3U, 0, 0}, {1, 1, kHeight, kWidth}},
              view.data());
    QCOMPARE(view[5 * kWidth + 6], 255);
  }

  void readersOfTheArchive_findWhatTheyKnow() {
    const Scene scene = plane_scene();
    Scribbles scribbles = some_scribbles();
    scribbles.views.erase(scribbles.views.begin());

    io::write_scribbles(path("labels.h5"), scribbles, scene, Progress(1));

    // One view, integers, 0 = unpainted, nothing else in the file.
    const io::Hdf5Input file(path("labels.h5"));
    QCOMPARE(file.datasets().size(), std::size_t{1});
    std::vector<std::int32_t> view(kHeight * kWidth);
    file.read("SCRIBBLES", {{0, 0}, {kHeight, kWidth}}, view.data());
    QCOMPARE(view[7 * kWidth + 8], 1);
    QCOMPARE(std::ranges::count(view, 0), std::ptrdiff_t{kHeight * kWidth - 1});
  }

  void wrongTargets_areRefusedAndStayAsTheyAre_data() {
    QTest::addColumn<QString>("kind");
    QTest::addColumn<QString>("complaint");
    QTest::newRow("light field") << "lf"
                                 << "holds a light field";
    QTest::newRow("text") << "text"
                          << "not an HDF5 file";
    QTest::newRow("labels of another") << "other"
                                       << "belong to the light field other.h5";
  }
  void wrongTargets_areRefusedAndStayAsTheyAre() {
    QFETCH(QString, kind);
    QFETCH(QString, complaint);
    const Scene made = plane_scene();
    io::write_archive(path("lf.h5"), made, Progress(1));
    const Scene scene = io::open_scene(path("lf.h5"), {}, Progress(1));
    std::filesystem::path target = path("lf.h5");
    if (kind == "text") {
      target = path("notes.h5");
      std::ofstream(target) << "milk, bread";
    } else if (kind == "other") {
      target = path("theirs.h5");
      std::filesystem::copy_file(path("lf.h5"), path("other.h5"));
      Scene other = io::open_scene(path("other.h5"), {}, Progress(1));
      io::write_scribbles(target, some_scribbles(), other, Progress(1));
    }
    const auto before = bytes_of_file(target);
    const std::size_t files = count_files(folder_->path().toStdString());

    try {
      io::write_scribbles(target, some_scribbles(), scene, Progress(1));
      QFAIL("it was written");
    } catch (const IoError& error) {
      QVERIFY2(QString(error.what()).contains(complaint), error.what());
    }

    QVERIFY(bytes_of_file(target) == before);
    QCOMPARE(count_files(folder_->path().toStdString()), files);
  }

  void misfits_areRefused() {
    const Scene scene = plane_scene();
    Scribbles outside;
    outside.views.push_back(painted_view({9, 9}, {0, 0}, 1));
    PlaneOptions options;
    options.width = 48;
    const Scene other = plane_scene(options);
    io::write_scribbles(path("mine.h5"), some_scribbles(), scene, Progress(1));

    QVERIFY_THROWS_EXCEPTION(IoError,
                             io::write_scribbles(path("out.h5"), outside, scene, Progress(1)));
    QVERIFY_THROWS_EXCEPTION(
        IoError, io::write_scribbles(path("out.h5"), some_scribbles(), other, Progress(1)));
    QVERIFY_THROWS_EXCEPTION(IoError,
                             (void)io::read_scribbles(path("mine.h5"), other, Progress(1)));
    QVERIFY_THROWS_EXCEPTION(IoError,
                             (void)io::read_true_labels(path("mine.h5"), scene, Progress(1)));
    QVERIFY(!std::filesystem::exists(path("out.h5")));
  }

  void scribblesOfAFocusPlane_areThoseOfTheStoredViews() {
    const Scene scene = plane_scene();
    io::write_archive(path("lf.h5"), scene, Progress());
    io::OpenOptions at_plane;
    at_plane.focus_px = 1;
    const Scene moved = io::open_scene(path("lf.h5"), at_plane, Progress());
    Scribbles painted;
    painted.labels = {{1, "one", {}}, {7, "seven", {}}};
    painted.views.push_back(painted_view({0, 1}, {10, 20}, 7));

    io::write_scribbles(path("labels.h5"), painted, moved, Progress());

    // View (0, 1) of 5×5 was fetched 2 rows further down and 1 column further right.
    const Scene stored = io::open_scene(path("lf.h5"), {}, Progress());
    compare(stored.scribbles.views.size() == 1 ? stored.scribbles : Scribbles(),
            {{painted_view({0, 1}, {12, 21}, 7)}, painted.labels});
    compare(io::read_scribbles(path("labels.h5"), moved, Progress()), painted);
    compare(io::open_scene(path("lf.h5"), at_plane, Progress()).scribbles, painted);
  }

  void scribblesOutOfSightOfAFocusPlane_stayInTheFile() {
    const Scene scene = plane_scene();
    Scribbles before;
    before.labels = {{1, "one", {}}};
    before.views.push_back(painted_view({0, 1}, {0, 40}, 1));
    io::write_archive(path("lf.h5"), scene, Progress());
    io::write_scribbles(path("labels.h5"), before, scene, Progress());
    io::OpenOptions at_plane;
    at_plane.focus_px = 1;
    const Scene moved = io::open_scene(path("lf.h5"), at_plane, Progress());

    io::write_scribbles(path("labels.h5"), moved.scribbles, moved, Progress());

    compare(io::read_scribbles(path("labels.h5"), scene, Progress()), before);
  }
};

}  // namespace episcope::in_scribble_file_test

EPISCOPE_TEST(scribble_file_test, ScribbleFileTest)
#include "scribble_file_test.moc"
