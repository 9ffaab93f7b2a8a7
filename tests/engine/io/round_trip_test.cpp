// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/formats/quilt.h"
#include "engine/io/open.h"
#include "engine/io/write.h"
#include "tests/engine/io/round_trip_scenes.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

namespace episcope::in_round_trip_test {

using namespace episcope::test;

namespace fs = std::filesystem;

/// Every writer, and the reader that its files go to.
class RoundTripTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;

  /// A place of its own for each file, since some forms look at what lies beside them.
  Scene through(const io::Writer& writer, const Scene& scene, const std::string& place) const {
    const fs::path folder = fs::path(folder_->path().toStdString()) / place;
    fs::create_directory(folder);
    const fs::path path =
        folder / (writer.writes_folder() ? "scene" : std::string("scene") + writer.suffixes[0]);
    writer.write(path, scene, Progress(2));
    io::OpenOptions options;
    if (writer.id == std::string("eslf")) {  // no picture says how many views lie under a lenslet
      const GridShape grid = scene.light_field->grid();
      options.mosaic = io::Mosaic::Lenslets;
      options.grid = std::to_string(grid.v) + "x" + std::to_string(grid.u);
    }
    if (writer.id == std::string("quilt")) {  // and this name says nothing of tiles
      const GridShape tiles = io::quilt_tiles_of(*scene.light_field);
      options.mosaic = io::Mosaic::Quilt;
      options.grid = std::to_string(tiles.v) + "x" + std::to_string(tiles.u);
    }
    return io::open_scene(path, options, Progress(2));
  }

  static bool can_write(const io::Writer& writer, const Scene& scene) {
    return (scene.light_field->sample_type() != SampleType::Float32 ||
            writer.holds.floats != io::FloatsHeld::None) &&
           (scene.light_field->grid().u > 1 || writer.holds.has_rows);
  }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void everyWriter_isReadBackAsItSays_data() {
    QTest::addColumn<std::size_t>("form");
    QTest::addColumn<std::size_t>("index");
    const auto scenes = round_trip_scenes();
    for (std::size_t form = 0; form < io::writers().size(); ++form) {
      for (std::size_t i = 0; i < scenes.size(); ++i) {
        QTest::addRow("%s: %s", io::writers()[form].id, scenes[i].name) << form << i;
      }
    }
  }
  void everyWriter_isReadBackAsItSays() {
    try {
      QFETCH(std::size_t, form);
      QFETCH(std::size_t, index);
      const io::Writer& writer = io::writers()[form];
      const Scene scene = round_trip_scenes()[index].make();
      if (!can_write(writer, scene)) {
        QVERIFY_THROWS_EXCEPTION(IoError, (void)through(writer, scene, "a"));
        return;
      }

      const Scene read = through(writer, scene, "a");

      const std::string found = difference(scene, writer.holds, read);
      QVERIFY2(found.empty(), (found + " | " + describe(read.convention)).c_str());
      // What is read back, the form holds: nothing more is left out.
      QCOMPARE(io::unsupported_parts(writer, read).size(), std::size_t{0});
    } catch (const Error& error) {
      QFAIL(error.what());
    }
  }

  void everyPairOfForms_keepsWhatBothHold_data() {
    QTest::addColumn<std::size_t>("from");
    QTest::addColumn<std::size_t>("to");
    QTest::addColumn<std::size_t>("index");
    const auto scenes = round_trip_scenes();
    const auto forms = io::writers();
    for (std::size_t i = 0; i < forms.size() * forms.size(); ++i) {
      const std::size_t from = i / forms.size();
      const std::size_t to = i % forms.size();
      if (from == to) continue;
      // One scene of each sample type: the others are compared form by form.
      for (const std::size_t scene : {0, 1, 4}) {
        QTest::addRow("%s to %s: %s", forms[from].id, forms[to].id, scenes[scene].name)
            << from << to << scene;
      }
    }
  }
  void everyPairOfForms_keepsWhatBothHold() {
    try {
      QFETCH(std::size_t, from);
      QFETCH(std::size_t, to);
      QFETCH(std::size_t, index);
      const io::Writer& a = io::writers()[from];
      const io::Writer& b = io::writers()[to];
      const Scene scene = round_trip_scenes()[index].make();
      if (!can_write(a, scene) || !can_write(b, scene)) return;
      const Scene first = through(a, scene, "first");

      const Scene other = through(b, first, "other");
      const Scene back = through(a, other, "back");

      const std::string found = difference(first, common_contents(a.holds, b.holds), back);
      QVERIFY2(found.empty(), (found + " | " + describe(back.convention)).c_str());
    } catch (const Error& error) {
      QFAIL(error.what());
    }
  }

  void whatAFormCannotHold_isSaidOncePerKind() {
    Scene scene = round_trip_scenes()[4].make();  // float, with a mask

    const auto sentences = io::unsupported_parts(*io::writer_named("benchmark"), scene);

    QCOMPARE(sentences.size(), std::size_t{4});
    const char* expected[] = {"The benchmark form holds no float samples; they are rounded",
                              "labels of the center view only; those of the others are left out.",
                              "The benchmark form holds no scribbles; they are left out.",
                              "The benchmark form holds no masks of valid pixels"};
    for (std::size_t i = 0; i < sentences.size(); ++i) {
      QVERIFY2(sentences[i].find(expected[i]) != std::string::npos, sentences[i].c_str());
    }
  }
};

}  // namespace episcope::in_round_trip_test

EPISCOPE_TEST(round_trip_test, RoundTripTest)
#include "round_trip_test.moc"
