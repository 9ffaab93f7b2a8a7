// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/formats/write_scene.h"
#include "tests/engine/io/archive_files.h"
#include "tests/engine/io/archive_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

namespace episcope::in_archive_labels_test {

using namespace episcope::test;

// Labels and scribbles, which have a file of their own beside the light field.
class ArchiveLabelsTest : public QObject, private ArchiveFolder {
  Q_OBJECT

 private slots:
  void init() { renew(); }

  void labelsOfOthers_areNeverWrittenOver() {
    const Scene scene = plane_scene();
    {
      io::AtomicFile target(path("labels.h5"));
      io::Hdf5Output file(target);
      add_bytes(file, "GT_LABELS", {1}, {7});
      file.close();
      target.commit();
    }

    io::write_archive(path("mine.h5"), scene, Progress(1));

    QCOMPARE(io::Hdf5Input(path("labels.h5")).dataset("GT_LABELS").shape, io::Hdf5Shape{1});
    QCOMPARE(open(path("mine.h5")).truth->labels.size(), scene.truth->labels.size());
  }

  void labelsAndScribbles_moveWithTheirViews() {
    const Scene scene = plane_scene();
    RawArchive form;
    form.flip = {true, false};
    form.more = [](io::Hdf5Output& file) {
      std::vector<std::uint8_t> labels(5 * 5 * 64 * 80, 3);
      std::fill_n(labels.begin(), 64 * 80, 9);  // view (0, 0) as stored
      add_bytes(file, "GT_LABELS", {5, 5, 64, 80}, labels);
      std::vector<std::uint8_t> scribbles(5 * 5 * 64 * 80, 255);
      scribbles[(1 * 5 + 0) * 64 * 80 + 17] = 4;
      add_bytes(file, "SCRIBBLES", {5, 5, 64, 80}, scribbles);
    };
    write_raw_archive(path("lf.h5"), scene, form);

    const Scene read = open(path("lf.h5"));

    QCOMPARE(read.truth->labels.view({0, 4}).at(0, 0), 9);
    QCOMPARE(read.truth->labels.view({0, 0}).at(0, 0), 3);
    QCOMPARE(read.scribbles.views.at(0).view, (ViewIndex{1, 4}));
    QCOMPARE(read.scribbles.views.at(0).labels.at(0, 17), 4);
    QCOMPARE(read.scribbles.views.at(0).labels.at(0, 16), 0);
  }

  void scribbles_acceptEveryNone_data() {
    QTest::addColumn<int>("none");
    QTest::newRow("0") << 0;
    QTest::newRow("-1") << -1;
    QTest::newRow("255") << 255;
  }
  void scribbles_acceptEveryNone() {
    QFETCH(int, none);
    RawArchive form;
    form.more = [none](io::Hdf5Output& file) {
      std::vector<std::int32_t> scribbles(64 * 80, none);
      scribbles[80 + 2] = 6;
      file.add_dataset<std::int32_t>("SCRIBBLES", {64, 80}, "", "");
      file.write("SCRIBBLES", {{0, 0}, {64, 80}}, scribbles.data());
    };
    write_raw_archive(path("lf.h5"), plane_scene(), form);

    const Scribbles scribbles = open(path("lf.h5")).scribbles;

    QCOMPARE(scribbles.views.at(0).view, (ViewIndex{2, 2}));
    QCOMPARE(scribbles.views.at(0).labels.at(1, 2), 6);
    QCOMPARE(scribbles.views.at(0).labels.at(0, 0), 0);
  }

  void labelZero_isRaisedWhereNoneIsMarkedOtherwise() {
    RawArchive form;
    form.more = [](io::Hdf5Output& file) {
      std::vector<std::int32_t> scribbles(64 * 80, -1);
      scribbles[5] = 0;
      scribbles[6] = 1;
      file.add_dataset<std::int32_t>("SCRIBBLES", {64, 80}, "", "");
      file.write("SCRIBBLES", {{0, 0}, {64, 80}}, scribbles.data());
      std::vector<std::uint8_t> labels(5 * 5 * 64 * 80, 0);
      labels[1] = 1;
      add_bytes(file, "GT_LABELS", {5, 5, 64, 80}, labels);
    };
    write_raw_archive(path("lf.h5"), plane_scene(), form);

    const Scene read = open(path("lf.h5"));

    QCOMPARE(read.scribbles.views.at(0).labels.at(0, 5), 1);
    QCOMPARE(read.scribbles.views.at(0).labels.at(0, 6), 2);
    QCOMPARE(read.scribbles.views.at(0).labels.at(0, 7), 0);
    QCOMPARE(read.truth->labels.view({0, 0}).at(0, 0), 1);
    QVERIFY(QString::fromStdString(describe(read.convention)).contains("raised by one"));
  }

  void failingLabels_bringTheOldLightFieldBack_data() {
    QTest::addColumn<bool>("was_there");
    QTest::newRow("new file") << false;
    QTest::newRow("over an old one") << true;
  }
  void failingLabels_bringTheOldLightFieldBack() {
    QFETCH(bool, was_there);
    PlaneOptions options;
    options.d0 = 0.5;
    const Scene former = plane_scene(options);
    if (was_there) io::write_archive(path("lf.h5"), former, Progress(2));
    // A folder in the place of the labels, made when they are being written, cannot be replaced.
    const std::stop_source stop;
    const Progress progress(stop.get_token(), [&](const ProgressState& state) {
      if (state.fraction < 0.9) return;
      std::filesystem::remove(path("labels.h5"));
      std::filesystem::create_directories(path("labels.h5"));
    });

    QVERIFY_THROWS_EXCEPTION(IoError, io::write_archive(path("lf.h5"), plane_scene(), progress));

    const std::size_t files =
        static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path("")), {}));
    QCOMPARE(files, std::size_t{was_there ? 2U : 1U});
    if (!was_there) return;
    std::filesystem::remove(path("labels.h5"));
    QVERIFY(has_same_samples(former, open(path("lf.h5"))));
  }
};

}  // namespace episcope::in_archive_labels_test

EPISCOPE_TEST(archive_labels_test, ArchiveLabelsTest)
#include "archive_labels_test.moc"
