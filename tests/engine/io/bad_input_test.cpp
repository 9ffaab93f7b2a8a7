// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/models/result_file.h"
#include "engine/io/open.h"
#include "engine/io/write.h"
#include "tests/cpu_time.h"
#include "tests/engine/io/archive_files.h"
#include "tests/engine/io/broken/broken.h"
#include "tests/engine/io/memory_use.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/patience.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <sys/resource.h>
#include <unistd.h>
#include <csignal>
#include <fstream>
#include <functional>

namespace episcope::in_bad_input_test {

using namespace episcope::test;

namespace fs = std::filesystem;

namespace {

/// While it exists, no file can grow beyond `bytes`: for a writer the same as a disk that fills up.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int) = SIG_DFL;
};

using Write = std::function<void(const fs::path&)>;

struct Writer {
  const char* name;
  Write write;
  bool is_folder = false;
};

Estimate estimate_of(const Scene& scene) {
  Estimate estimate;
  estimate.field.disparity = scene.truth->field.disparity.clone();
  estimate.method = "test";
  return estimate;
}

/// Every writer of the folder, each with enough to write that a small disk cannot hold it.
std::vector<Writer> all_writers() {
  const auto scene = std::make_shared<Scene>(plane_scene());
  const auto map = std::make_shared<Image<float>>(200, 200);
  const auto picture = std::make_shared<Image<std::uint8_t>>(300, 300, 3);
  unsigned noise = 1;
  for (std::uint8_t& sample : *picture) {
    noise = noise * 1664525U + 1013904223U;
    sample = static_cast<std::uint8_t>(noise >> 24);
  }
  const auto write_cloud = [=](const fs::path& path) {
    const Image<std::uint8_t> grey(200, 200, 4);
    io::write_ply(path, make_point_cloud({map->view(), {}}, {}, grey));
  };
  std::vector<Writer> all{
      {"PFM", [=](const fs::path& path) { io::write_pfm(path, map->view()); }},
      {"TIFF", [=](const fs::path& path) { io::write_tiff(path, map->view()); }},
      {"PNG", [=](const fs::path& path) { io::write_png(path, picture->view()); }},
      {"PLY", write_cloud},
      {"result",
       [=](const fs::path& path) { io::write_result(path, estimate_of(*scene), Progress(1)); }}};
  for (const io::Writer& form : io::writers()) {
    all.push_back({form.id,
                   [=, &form](const fs::path& path) { form.write(path, *scene, Progress(1)); },
                   form.writes_folder()});
  }
  return all;
}

/// A user for whom permissions count, also where tests run as root.
class PlainUser {
 public:
  PlainUser() : user_(::geteuid()) {
    if (user_ == 0) is_switched_ = ::seteuid(65534) == 0;
  }
  ~PlainUser() {
    if (is_switched_) is_switched_ = ::seteuid(user_) != 0;
  }
  PlainUser(const PlainUser&) = delete;
  PlainUser& operator=(const PlainUser&) = delete;

 private:
  uid_t user_;
  bool is_switched_ = false;
};

std::vector<Broken> broken_inputs() {
  std::vector<Broken> all = broken_archives();
  for (const auto& more : {broken_folders(), broken_arrays(), broken_places()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

}  // namespace

class BadInputTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  fs::path folder() const { return folder_->path().toStdString(); }

  /// One sentence: the path, what is wrong, what to do; no line breaks.
  static void verify_sentence(const IoError& error, const std::string& expected) {
    const std::string text = error.what();
    QVERIFY2(text.starts_with(error.path().string() + ": "), text.c_str());
    QVERIFY2(text.find(expected) != std::string::npos, text.c_str());
    QVERIFY2(text.find('\n') == std::string::npos, text.c_str());
    QVERIFY2(text.find(';') != std::string::npos, text.c_str());  // what is wrong; what to do
    QVERIFY2(text.back() != '.' && text.size() < 400, text.c_str());
  }
  std::size_t files_in(const fs::path& place) const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(place), fs::directory_iterator()));
  }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void brokenInput_isRefusedInOneSentence_data() {
    QTest::addColumn<std::size_t>("index");
    const auto inputs = broken_inputs();
    for (std::size_t i = 0; i < inputs.size(); ++i) QTest::newRow(inputs[i].name) << i;
  }
  void brokenInput_isRefusedInOneSentence() {
    QFETCH(std::size_t, index);
    const Broken broken = broken_inputs()[index];
    const fs::path path = broken.make(folder());
    const PeakMemory memory;
    const double begin_ms = cpu_time_ms();

    try {
      (void)io::open_scene(path, {}, Progress(2));
      QFAIL("the input was accepted");
    } catch (const IoError& error) {
      verify_sentence(error, broken.expected);
    }

    // Every input of the table is small; the longest list of files takes most.
    const QByteArray taken = QByteArray::number(static_cast<double>(memory.used()) / (1 << 20));
    QVERIFY2(memory.used() < (std::uintmax_t{200} << 20), (taken + " MiB").constData());
    QVERIFY2(cpu_time_ms() - begin_ms < 10000 * kSlowdown,
             QByteArray::number(cpu_time_ms() - begin_ms) + " ms");
  }

  void unreadableInput_isRefusedInOneSentence_data() {
    QTest::addColumn<QString>("input");
    QTest::newRow("file") << "lf.h5";
    QTest::newRow("folder") << "closed";
  }
  void unreadableInput_isRefusedInOneSentence() {
    QFETCH(QString, input);
    fs::permissions(folder(), fs::perms::all);
    std::ofstream(folder() / "lf.h5") << "x";
    fs::create_directory(folder() / "closed");
    fs::permissions(folder() / input.toStdString(), fs::perms::none);

    try {
      const PlainUser user;
      (void)io::open_scene(folder() / input.toStdString(), {}, Progress(1));
      QFAIL("the input was accepted");
    } catch (const IoError& error) {
      verify_sentence(error, "check its permissions");
    }
    fs::permissions(folder() / input.toStdString(), fs::perms::owner_all);
  }

  void depthWithoutAnySurface_isTold_data() {
    QTest::addColumn<float>("depth");
    QTest::newRow("NaN") << std::numeric_limits<float>::quiet_NaN();
    QTest::newRow("zero") << 0.0F;
  }
  void depthWithoutAnySurface_isTold() {
    QFETCH(float, depth);
    RawArchive form;
    form.depth = [depth](ViewIndex, int, int, float) { return depth; };
    const fs::path path = folder() / "lf.h5";
    write_raw_archive(path, plane_scene(), form);

    const Scene scene = io::open_scene(path, {}, Progress(1));

    QVERIFY(!scene.truth->has_disparity());
    QVERIFY(QString::fromStdString(describe(scene.convention))
                .contains("GT_DEPTH holds no depth at 100 %"));
  }

  void pathsWithUmlautsAndSpaces_work_data() {
    QTest::addColumn<std::size_t>("index");
    const auto writers = all_writers();
    for (std::size_t i = 0; i < writers.size(); ++i) QTest::newRow(writers[i].name) << i;
  }
  void pathsWithUmlautsAndSpaces_work() {
    QFETCH(std::size_t, index);
    const fs::path place = folder() / "Größe und Übung ☂";
    fs::create_directory(place);

    all_writers()[index].write(place / "ein Maß.h5");

    QVERIFY(fs::exists(place / "ein Maß.h5"));
  }

  void inputUnderAnUmlautPath_opens() {
    const fs::path place = folder() / "Größe und Übung ☂";
    fs::create_directories(place / "views");
    io::write_archive(place / "lf.h5", plane_scene(), Progress(1));
    for (const char* name : {"0_0.png", "0_1.png", "1_0.png", "1_1.png"}) {
      io::write_png(place / "views" / name, Image<std::uint8_t>(8, 9, 3).view());
    }

    QCOMPARE(io::open_scene(place, {}, Progress(1)).light_field->info().name,
             std::string("Größe und Übung ☂"));
    QCOMPARE(io::open_scene(place / "views", {}, Progress(1)).light_field->grid(),
             (GridShape{2, 2}));
  }

  void unwritablePlace_isRefusedInOneSentence_data() {
    QTest::addColumn<std::size_t>("index");
    QTest::addColumn<QString>("place");
    const auto writers = all_writers();
    for (std::size_t i = 0; i < writers.size(); ++i) {
      // Tests may run as root, for whom permissions do not count: places nobody can write to.
      for (const char* place : {"file/out", "missing/out", "/proc/out"}) {
        QTest::addRow("%s to %s", writers[i].name, place) << i << QString(place);
      }
    }
  }
  void unwritablePlace_isRefusedInOneSentence() {
    QFETCH(std::size_t, index);
    QFETCH(QString, place);
    std::ofstream(folder() / "file") << "a file";

    try {
      all_writers()[index].write(folder() / place.toStdString());
      QFAIL("it was written");
    } catch (const IoError& error) {
      verify_sentence(error, "choose another");
    }
    QCOMPARE(files_in(folder()), std::size_t{1});
  }

  void fullDisk_leavesTheOldFileAndNothingElse_data() {
    QTest::addColumn<std::size_t>("index");
    QTest::addColumn<int>("bytes");
    const auto writers = all_writers();
    for (std::size_t i = 0; i < writers.size(); ++i) {
      for (const int bytes : {0, 2000, 5000}) {
        QTest::addRow("%s at %d bytes", writers[i].name, bytes) << i << bytes;
      }
    }
  }
  void fullDisk_leavesTheOldFileAndNothingElse() {
    QFETCH(std::size_t, index);
    QFETCH(int, bytes);
    const Writer writer = all_writers()[index];
    const bool is_folder = writer.is_folder;
    if (!is_folder) std::ofstream(folder() / "out") << "old";

    try {
      const FullDisk full(static_cast<rlim_t>(bytes));
      writer.write(folder() / "out");
      QFAIL("it was written");
    } catch (const IoError& error) {
      verify_sentence(error, "choose another folder");
    }

    QCOMPARE(files_in(folder()), std::size_t{is_folder ? 0U : 1U});
    if (!is_folder) QCOMPARE(fs::file_size(folder() / "out"), std::uintmax_t{3});
    // The libraries beneath must still work.
    writer.write(folder() / "again");
    QVERIFY(fs::exists(folder() / "again"));
  }

  void deviceFiles_areNeverReplaced() {
    try {
      io::write_pfm("/dev/full", Image<float>(2, 2).view());
      QFAIL("it was written");
    } catch (const IoError& error) {
      verify_sentence(error, "not a regular file");
    }
    QVERIFY(fs::is_character_file("/dev/full"));
  }

  void linkToAFile_staysALink() {
    std::ofstream(folder() / "real.pfm") << "old";
    fs::create_symlink("real.pfm", folder() / "link.pfm");

    io::write_pfm(folder() / "link.pfm", Image<float>(2, 2).view());

    QVERIFY(fs::is_symlink(folder() / "link.pfm"));
    QCOMPARE(io::read_pfm(folder() / "real.pfm").width(), 2);
  }
};

}  // namespace episcope::in_bad_input_test

EPISCOPE_TEST(bad_input_test, BadInputTest)
#include "bad_input_test.moc"
