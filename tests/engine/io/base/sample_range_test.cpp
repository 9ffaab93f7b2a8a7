// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/npy.h"
#include "engine/io/base/sample_range.h"
#include "engine/io/open.h"
#include "tests/engine/io/formats/array_files.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>
#include <cmath>

namespace episcope::in_sample_range_test {

using namespace episcope::test;

namespace fs = std::filesystem;

namespace {

Scene reference() {
  return plane_scene({.grid = {5, 7}});
}

/// The bytes of the reference as other numbers.
template <class T>
std::vector<T> numbers(const Scene& scene, const auto& number_of) {
  const ViewStack<std::uint8_t>& views = bytes_of(scene);
  std::vector<T> all(views.size());
  std::transform(views.data(), views.data() + views.size(), all.begin(),
                 [&](std::uint8_t byte) { return static_cast<T>(number_of(byte)); });
  return all;
}

/// Largest difference of what estimators see from the bytes, in grey levels.
double largest_error(const Scene& read, const Scene& scene) {
  double largest = 0;
  for (int i = 0; i < scene.light_field->grid().count(); ++i) {
    const ViewIndex view = scene.light_field->grid().view_at(i);
    const Image<float> a = read.light_field->view_as_float(view);
    const Image<float> b = scene.light_field->view_as_float(view);
    for (std::size_t k = 0; k < a.size(); ++k) {
      largest = std::max(largest, 255.0 * std::abs(a.data()[k] - b.data()[k]));
    }
  }
  return largest;
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

/// Samples that do not fill the range of their type, or are not in that of the engine.
class SampleRangeTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  Scene scene_ = reference();
  fs::path path() const { return fs::path(folder_->path().toStdString()) / "lf.npy"; }
  template <class T>
  Scene opened(const auto& number_of, const std::string& levels = {}) {
    io::write_npy<T>(path(), lengths_of(bytes_of(scene_), "vuyxc"), numbers<T>(scene_, number_of));
    io::OpenOptions options;
    options.levels = levels;
    return io::open_scene(path(), options, Progress(1));
  }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void wordsOfFewerBits_fillTheirRange_data() {
    QTest::addColumn<int>("factor");
    QTest::addColumn<QString>("bits");
    QTest::newRow("8") << 1 << "8 bits";
    QTest::newRow("10") << 4 << "10 bits";
    QTest::newRow("12") << 16 << "12 bits";
    QTest::newRow("14") << 64 << "14 bits";
  }
  void wordsOfFewerBits_fillTheirRange() {
    QFETCH(int, factor);
    QFETCH(QString, bits);

    const Scene read = opened<std::uint16_t>([=](int byte) { return byte * factor; });

    // White of the file is up to 3 of 1023 above 255 times the factor.
    QVERIFY2(largest_error(read, scene_) < 1, qPrintable(bits));
    QVERIFY2(says(read.convention.samples, bits.toStdString()), read.convention.samples.c_str());
    QCOMPARE(read.convention.warnings.size(), std::size_t{1});
  }

  void wordsThatFillTheirRange_stay() {
    const Scene read = opened<std::uint16_t>([](int byte) { return byte * 257; });

    QVERIFY(largest_error(read, scene_) < 1e-3);
    QVERIFY(says(read.convention.samples, "as stored"));
    QVERIFY(read.convention.warnings.empty());
  }

  void floatsAroundZero_areBroughtAbove() {
    const Scene read = opened<float>([](int byte) { return byte / 127.5 - 1; });

    QVERIFY(largest_error(read, scene_) < 1e-3);
    QVERIFY2(says(read.convention.samples, "around 0"), read.convention.samples.c_str());
    QVERIFY2(says(read.convention.warnings.front(), "-1 for black"),
             read.convention.warnings.front().c_str());
  }

  void normalisedFloats_areBroughtToTheirExtent() {
    const Scene read = opened<float>([](int byte) { return (byte / 255.0 - 0.45) / 0.225; });

    const auto& views = std::get<ViewStack<float>>(read.light_field->samples());
    const auto [least, most] = std::minmax_element(views.data(), views.data() + views.size());
    // One in a thousand may lie outside.
    QVERIFY(*least > -0.05F && *least < 0.05F && *most > 0.95F && *most < 1.05F);
    QVERIFY2(says(read.convention.warnings.front(), "normalized"),
             read.convention.warnings.front().c_str());
  }

  void fewNegativeSamples_stay() {
    // Overshoots of a filter.
    const Scene read = opened<float>([](int byte) { return byte < 20 ? -0.01 : byte / 255.0; });

    QVERIFY(says(read.convention.samples, "as stored"));
  }

  void negativeIntegers_areNotCut() {
    const Scene read = opened<std::int32_t>([](int byte) { return byte - 128; });

    QVERIFY(largest_error(read, scene_) < 1e-3);
  }

  void wholeFloats_areOfAsManyBitsAsTheyNeed() {
    const Scene read = opened<float>([](int byte) { return byte * 4; });

    QVERIFY(largest_error(read, scene_) < 1);
    QVERIFY2(says(read.convention.samples, "10 bits"), read.convention.samples.c_str());
  }

  void chosenLevels_areTaken() {
    const auto times_four = [](int byte) { return byte * 4; };
    const Scene read = opened<std::uint16_t>(times_four, "0,65535");
    const Scene wide = opened<std::uint16_t>(times_four, "0,1020");
    const Scene moved = opened<float>([](int byte) { return byte / 85.0 + 2; }, "2,5");

    QCOMPARE(read.light_field->view_as_float({0, 0}).at(3, 4, 1),
             static_cast<float>(4 * bytes_of(scene_).view({0, 0}).at(3, 4, 1)) / 65535);
    QVERIFY(read.convention.warnings.empty());
    QVERIFY(largest_error(wide, scene_) < 0.01);
    QVERIFY(largest_error(moved, scene_) < 1e-3);
    QVERIFY(says(moved.convention.samples, "chosen by hand"));
    for (const char* levels : {"1", "5,2", "a,b", "0,1,2", ","}) {
      QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)opened<float>(times_four, levels));
    }
  }
};

}  // namespace episcope::in_sample_range_test

EPISCOPE_TEST(sample_range_test, SampleRangeTest)
#include "sample_range_test.moc"
