// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/models/external_result.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>
#include <fstream>
#include <limits>

namespace episcope::in_submission_folder_test {

namespace fs = std::filesystem;

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

class SubmissionFolderTest : public QObject {
  Q_OBJECT
 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void writtenScenes_areAccepted() {
    QCOMPARE(io::benchmark_scenes().size(), std::size_t{12});
    for (const auto& scene : io::benchmark_scenes()) {
      const Image<float> map(512, 512, 1, 0.5F);
      QCOMPARE(io::write_submitted_scene(path(), scene.name, {map.view(), {}}, 0.125),
               std::size_t{0});
    }

    QVERIFY(io::submission_problems(path(), io::benchmark_scenes()).empty());
    const Estimate cotton = io::read_external_result(path(), {9, 9}, "cotton");
    QCOMPARE(cotton.seconds, 0.125);
    QCOMPARE(cotton.field.disparity.view({4, 4}).at(3, 3), 0.5F);
  }

  void gaps_getTheFartherValueBesideThem() {
    Image<float> map(4, 4, 1, kNone);
    map.at(1, 0) = 2;
    map.at(1, 3) = 1;
    map.at(2, 2) = 7;

    const std::size_t gaps = io::write_submitted_scene(path(), "a", {map.view(), {}}, 1);

    QCOMPARE(gaps, std::size_t{13});
    const Image<float> written = io::read_pfm(io::submitted_map_file(path(), "a"));
    const std::vector<float> expected{2, 1, 1, 1, 2, 1, 1, 1, 7, 7, 7, 7, 7, 7, 7, 7};
    QCOMPARE(std::vector<float>(written.begin(), written.end()), expected);
  }

  void whatCannotBeSubmitted_isRefused() {
    const Image<float> bare(4, 4, 1, kNone), whole(4, 4, 1, 0);

    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             (void)io::write_submitted_scene(path(), "a", {bare.view(), {}}, 1));
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             (void)io::write_submitted_scene(path(), "a", {whole.view(), {}}, 0));
    QVERIFY(fs::is_empty(path()));
  }

  void problems_areNamed_data() {
    QTest::addColumn<QByteArray>("map");
    QTest::addColumn<QByteArray>("runtime");
    QTest::addColumn<QString>("problem");
    const auto pfm = [](const char* header, int samples = 6) {
      return QByteArray(header) + QByteArray(4 * samples, '\0');
    };
    const QByteArray good = pfm("Pf\n3 2\n-1\n");
    QTest::newRow("nothing") << good << QByteArray("2.5") << "";
    QTest::newRow("comment and spaces")
        << pfm("Pf\n# a map\n3 2 \n-1.0\n") << QByteArray("1e-3\nmore") << "";
    QTest::newRow("three channels")
        << pfm("PF\n3 2\n-1\n", 18) << QByteArray("2.5") << "one channel";
    QTest::newRow("another size") << pfm("Pf\n2 3\n-1\n") << QByteArray("2.5") << "\"3 2\"";
    QTest::newRow("header in one line") << pfm("Pf 3 2 -1\n") << QByteArray("2.5") << "one channel";
    QTest::newRow("no scale") << pfm("Pf\n3 2\n0\n") << QByteArray("2.5") << "no scale";
    QTest::newRow("big endian") << pfm("Pf\n3 2\n1\n") << QByteArray("2.5") << "big endian";
    QTest::newRow("truncated") << pfm("Pf\n3 2\n-1\n", 5) << QByteArray("2.5") << "as many samples";
    QTest::newRow("too long") << pfm("Pf\n3 2\n-1\n", 7) << QByteArray("2.5") << "as many samples";
    QTest::newRow("not finite") << pfm("Pf\n3 2\n-1\n", 4) + QByteArray::fromHex("0000807f0000c07f")
                                << QByteArray("2.5") << "2 samples";
    QTest::newRow("runtime in words") << good << QByteArray("2.5 s") << "seconds";
    QTest::newRow("runtime of nothing") << good << QByteArray("0") << "seconds";
    QTest::newRow("no map") << QByteArray() << QByteArray("1") << "is missing: the map";
    QTest::newRow("no runtime") << good << QByteArray() << "is missing: the seconds";
  }
  void problems_areNamed() {
    QFETCH(QByteArray, map);
    QFETCH(QByteArray, runtime);
    QFETCH(QString, problem);
    fs::create_directories(path() / "disp_maps");
    fs::create_directories(path() / "runtimes");
    const auto write = [](const fs::path& file, const QByteArray& bytes) {
      if (!bytes.isEmpty()) std::ofstream(file, std::ios::binary).write(bytes, bytes.size());
    };
    write(io::submitted_map_file(path(), "a"), map);
    write(io::submitted_runtime_file(path(), "a"), runtime);

    const auto problems = io::submission_problems(path(), {{"a", 2, 3}});

    QCOMPARE(problems.size(), std::size_t(problem.isEmpty() ? 0 : 1));
    if (problems.empty()) return;
    const QString found = QString::fromStdString(problems[0]);
    QVERIFY2(found.contains(problem) && found.contains("a."), qPrintable(found));
  }

 private:
  [[nodiscard]] fs::path path() const { return folder_->path().toStdString(); }

  std::unique_ptr<QTemporaryDir> folder_;
};

}  // namespace episcope::in_submission_folder_test

EPISCOPE_TEST(submission_folder_test, SubmissionFolderTest)
#include "submission_folder_test.moc"
