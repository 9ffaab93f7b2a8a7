// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/image_file.h"
#include "engine/io/formats/sequence_reader.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/models/reader.h"
#include "engine/io/open.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>
#include <fmt/format.h>

namespace episcope::in_sequence_test {

namespace fs = std::filesystem;
using namespace episcope::test;

class SequenceTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  fs::path root() const { return fs::path(folder_->path().toStdString()) / "shot"; }

  static Scene scene_of(double d0, int width = 32) {
    return plane_scene({.grid = {3, 3}, .height = 24, .width = width, .d0 = d0});
  }
  void write_frame(const std::string& name, double d0, int width = 32) const {
    const bool is_file = name.ends_with(".h5");
    fs::create_directories(is_file ? root() : root() / name);
    io::write_archive(is_file ? root() / name : root() / name / "lf.h5", scene_of(d0, width),
                      Progress(1));
    if (is_file) fs::remove(root() / "labels.h5");
  }
  std::string reader() const {
    const io::Reader* found = io::find_reader(root(), {}).reader;
    return found ? found->id : "";
  }
  Scene open(int frame) const {
    io::OpenOptions options;
    options.frame = frame;
    return io::open_scene(root(), options, Progress(1));
  }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void camerasAndFramesInOneFolder_areASequence_data() {
    QTest::addColumn<QString>("form");
    for (const char* form : {"cam{0}{1}_frame{2:03}.png", "frame_{2}_row_{0}_col_{1}.png"}) {
      QTest::newRow(form) << form;
    }
  }
  void camerasAndFramesInOneFolder_areASequence() {
    QFETCH(QString, form);
    fs::create_directories(root());
    const auto scene_at = [](int frame) { return scene_of(0.3 + 0.4 * frame); };
    for (int frame = 0; frame < 3; ++frame) {
      const Scene scene = scene_at(frame);
      for (int i = 0; i < 9; ++i) {
        const fs::path file =
            root() / fmt::format(fmt::runtime(form.toStdString()), i / 3, i % 3, 5 + frame);
        io::write_png(file, scene.light_field->view<std::uint8_t>({i / 3, i % 3}));
      }
    }

    const Scene scene = open(2);

    QCOMPARE(reader(), std::string("sequence"));
    QCOMPARE(scene.sequence.count, 3);
    QVERIFY(scene.convention.warnings.empty());
    QVERIFY2(has_same_samples(scene, scene_at(2)), describe(scene.convention).c_str());
    QVERIFY(scene.convention.format.starts_with("sequence, frame_7: image grid ("));
    QCOMPARE(io::frame_path(scene.light_field->info()), root() / "frame_7");
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)open(3));
  }

  void folderOfEachCamera_isASequenceOfItsFrames_data() {
    QTest::addColumn<QString>("form");
    QTest::addColumn<QString>("pattern");
    QTest::newRow("rows and columns") << "{0:02}_{1:02}/{2:04}.png"
                                      << "{row}_{col}/0007.png";
    QTest::newRow("counted cameras") << "cam_{3:02}/frame_{2}.png"
                                     << "cam_{index}/frame_7.png";
  }
  void folderOfEachCamera_isASequenceOfItsFrames() {
    QFETCH(QString, form);
    QFETCH(QString, pattern);
    const auto scene_at = [](int frame) { return scene_of(0.3 + 0.4 * frame); };
    for (int frame = 0; frame < 3; ++frame) {
      const Scene scene = scene_at(frame);
      for (int i = 0; i < 9; ++i) {
        const fs::path file =
            root() / fmt::format(fmt::runtime(form.toStdString()), i / 3, i % 3, 5 + frame, i);
        fs::create_directories(file.parent_path());
        io::write_png(file, scene.light_field->view<std::uint8_t>({i / 3, i % 3}));
      }
    }
    io::OpenOptions options;
    options.grid = "3x3";
    options.frame = 2;
    io::OpenOptions named;
    named.grid = "3x3";
    named.pattern = pattern.toStdString();

    const Scene scene = io::open_scene(root(), options, Progress(1));
    const Scene alone = io::open_scene(root(), named, Progress(1));

    QCOMPARE(scene.sequence.count, 3);
    QVERIFY2(has_same_samples(scene, scene_at(2)), describe(scene.convention).c_str());
    QVERIFY2(has_same_samples(alone, scene_at(2)), describe(alone.convention).c_str());
  }

  void numberedNames_areASequence_data() {
    QTest::addColumn<QStringList>("names");
    QTest::addColumn<bool>("is_sequence");
    QTest::newRow("frame") << QStringList{"frame_000", "frame_001", "frame_002"} << true;
    QTest::newRow("no zeros") << QStringList{"frame9", "frame10"} << true;
    QTest::newRow("digits") << QStringList{"0001", "0002"} << true;
    QTest::newRow("f") << QStringList{"f1", "f2"} << true;
    QTest::newRow("time") << QStringList{"t=0", "t=1"} << true;
    QTest::newRow("files") << QStringList{"frame_0.h5", "frame_1.h5"} << true;
    QTest::newRow("files and labels") << QStringList{"t0.h5", "t1.h5", "labels_t0.h5"} << true;
    QTest::newRow("one") << QStringList{"frame_000"} << false;
    QTest::newRow("another word") << QStringList{"scene_1", "scene_2"} << false;
    QTest::newRow("two numbers") << QStringList{"frame_1_2", "frame_2_2"} << false;
    QTest::newRow("different words") << QStringList{"frame_1", "time_2"} << false;
    QTest::newRow("same number") << QStringList{"frame_1", "frame_01"} << false;
    QTest::newRow("digits and a scene") << QStringList{"1", "2", "cotton"} << false;
  }
  void numberedNames_areASequence() {
    QFETCH(QStringList, names);
    QFETCH(bool, is_sequence);
    for (const QString& name : names) write_frame(name.toStdString(), 0.3);

    QCOMPARE(reader() == "sequence", is_sequence);
  }

  void anotherShape_isNoSequence() {
    write_frame("frame_0", 0.3);
    write_frame("frame_1", 0.3, 40);

    QCOMPARE(reader(), std::string());
  }

  void frame_isOpenedByItsPlace() {
    for (int i = 0; i < 12; ++i) write_frame("frame" + std::to_string(i), 0.1 * i);

    const Scene scene = open(10);

    QVERIFY(has_same_samples(scene, scene_of(1.0)));
    QCOMPARE(scene.sequence.frame, 10);
    QCOMPARE(scene.sequence.count, 12);
    const LightFieldInfo& info = scene.light_field->info();
    QCOMPARE(info.source, root().string());
    QCOMPARE(info.name, std::string("shot"));
    QCOMPARE(info.reading.reader, std::string("sequence"));
    QVERIFY(info.reading.find("frame") != nullptr);
    QCOMPARE(io::frame_path(info), root() / "frame10");
  }

  void result_ofItsReading_opensTheSameFrame() {
    for (int i = 0; i < 3; ++i) write_frame(std::to_string(i), 0.2 * i);
    const Scene first = open(2);

    const io::OpenOptions again =
        io::open_schema().parse(first.light_field->info().reading.options);

    QVERIFY(has_same_samples(io::open_scene(root(), again, Progress(1)), first));
  }

  void missingNumber_isTold() {
    for (const char* name : {"frame_1", "frame_2", "frame_4"}) write_frame(name, 0.3);

    const Scene scene = open(2);

    QCOMPARE(scene.convention.warnings.size(), std::size_t{1});
    QVERIFY(scene.convention.warnings[0].find("number 3") != std::string::npos);
  }

  void frameBeyondTheEnd_isAnError() {
    write_frame("frame_0", 0.3);
    write_frame("frame_1", 0.3);

    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)open(2));
  }

  void linksInALoop_doNoHarm() {
    fs::create_directories(root());
    fs::create_directory_symlink(root(), root() / "1");
    fs::create_directory_symlink(root(), root() / "2");

    QCOMPARE(reader(), std::string());
  }
};

}  // namespace episcope::in_sequence_test

EPISCOPE_TEST(sequence_test, SequenceTest)

#include "sequence_test.moc"
