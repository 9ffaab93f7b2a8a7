// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/archive/write_scene.h"
#include "engine/io/grid/image_file.h"
#include "engine/io/maps/pfm.h"
#include "engine/io/maps/ply.h"
#include "engine/io/maps/result_file.h"
#include "engine/io/open/open.h"
#include "engine/io/write/writer.h"
#include "tests/engine/io/archive_files.h"
#include "tests/engine/io/broken/broken.h"
#include "tests/engine/io/memory_use.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <QElapsedTimer>
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
    const Image<std::uint8_t> grey(200, 200);
    io::write_ply(path, {{map->view(), {}}, grey.view(), {}, true});
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
<<<<<<< HEAD
  return {
      {"no such path", [](const fs::path& f) { return f / "none"; }, "no such file"},
      {"empty folder", [](const fs::path& f) { return f; }, "the folder is empty"},
      {"folder of something else",
       [](const fs::path& f) {
         std::ofstream(f / "note.txt") << "x";
         return f;
       },
       "no light field in this folder"},
      {"text named .h5",
       [](const fs::path& f) {
         std::ofstream(f / "lf.h5") << "this is no HDF5";
         return f / "lf.h5";
       },
       "not an HDF5 file"},
      {"text named .h5 in its folder",
       [](const fs::path& f) {
         std::ofstream(f / "lf.h5") << "this is no HDF5";
         return f;
       },
       "not an HDF5 file"},
      {"empty file named .h5",
       [](const fs::path& f) {
         std::ofstream give(f / "lf.h5");
         return f / "lf.h5";
       },
       "not an HDF5 file"},
      {"another kind of file",
       [](const fs::path& f) {
         std::ofstream(f / "scene.xyz") << "x";
         return f / "scene.xyz";
       },
       "not a light field"},
      {"HDF5 cut in its header", [](const fs::path& f) { return cut_archive(f, 90); },
       "truncated or damaged"},
      {"HDF5 cut in its samples", [](const fs::path& f) { return cut_archive(f, 200000); },
       "truncated or damaged"},
      {"no dataset LF",
       [](const fs::path& f) {
         return archive_of(f, {{"IMAGES", {2, 2}}});
       },
       "no dataset LF in this file, which holds IMAGES"},
      {"HDF5 without datasets", [](const fs::path& f) { return archive_of(f, {}); },
       "no dataset at all"},
      {"LF of rank 3",
       [](const fs::path& f) {
         return archive_of(f, {{"LF", {3, 8, 9}}});
       },
       "3 axes (3×8×9)"},
      {"LF of 2 channels",
       [](const fs::path& f) {
         return archive_of(f, {{"LF", {3, 3, 8, 9, 2}}});
       },
       "2 channels"},
      {"LF without views",
       [](const fs::path& f) {
         return archive_of(f, {{"LF", {0, 3, 8, 9, 3}}});
       },
       "not that of a light field"},
      {"GT_DEPTH of rank 3",
       [](const fs::path& f) {
         return archive_of(f, {{"LF", {3, 3, 8, 9, 3}}, {"GT_DEPTH", {3, 8, 9}}});
       },
       "GT_DEPTH has 3 axes"},
      {"GT_DEPTH of another size",
       [](const fs::path& f) {
         return archive_of(f, {{"LF", {3, 3, 8, 9, 3}}, {"GT_DEPTH", {9, 8}}});
       },
       "GT_DEPTH has the shape 9×8, but 3×3×8×9 or 8×9"},
      {"GT_LABELS of another size",
       [](const fs::path& f) {
         return archive_of(f, {{"LF", {3, 3, 8, 9, 3}}, {"GT_LABELS", {3, 3, 8, 8}}});
       },
       "GT_LABELS has the shape 3×3×8×8"},
      {"result instead of a light field",
       [](const fs::path& f) {
         io::write_result(f / "r.h5", estimate_of(plane_scene()), Progress(1));
         return f / "r.h5";
       },
       "disparity result, not a light field"},
      {"grid with a view of another size",
       [](const fs::path& f) {
         image_grid(f);
         io::write_png(f / "2_1.png", Image<std::uint8_t>(8, 8, 3).view());
         return f;
       },
       "8×8 px, RGB, 8 bit, but the centre view has 9×8 px"},
      {"grid with a grey view",
       [](const fs::path& f) {
         image_grid(f);
         io::write_png(f / "2_1.png", Image<std::uint8_t>(8, 9).view());
         return f;
       },
       "all views must match"},
      {"grid with a missing view",
       [](const fs::path& f) {
         image_grid(f);
         fs::remove(f / "1_2.png");
         return f;
       },
       "view 1,2 is missing (row,column as in the names; pattern {row}_{col}.png matches 8 of 8 "
       "images"},
      {"grid with a damaged view",
       [](const fs::path& f) {
         image_grid(f);
         std::ofstream(f / "0_2.png") << "no picture";
         return f;
       },
       "0_2.png: the image cannot be decoded"},
      {"list with a gap",
       [](const fs::path& f) {
         for (const int i : {0, 1, 2, 3, 4, 6, 7, 8}) {
           io::write_png(f / (std::to_string(i) + ".png"), Image<std::uint8_t>(2, 2).view());
         }
         return f;
       },
       "view 5 is missing (pattern {index}.png matches 8 of 8 images"},
      {"grid with many missing views",
       [](const fs::path& f) {
         image_grid(f);
         for (const char* name : {"0_1.png", "1_2.png", "2_0.png"}) fs::remove(f / name);
         return f;
       },
       "3 views are missing: 0,1 1,2 2,0 (row,column"},
      {"list that may be anything",
       [](const fs::path& f) {
         for (int i = 0; i < 6; ++i) {
           io::write_png(f / (std::to_string(i) + ".png"), Image<std::uint8_t>(9, 9).view());
         }
         return f;
       },
       "give --grid 2x3 (2 rows of 3 views), or --grid 3x2"},
      {"two grids of equal right",
       [](const fs::path& f) {
         for (const char* side : {"left", "right"}) {
           for (const char* place : {"0_0", "0_1", "1_0", "1_1"}) {
             io::write_png(f / (std::string(side) + place + ".png"),
                           Image<std::uint8_t>(2, 2).view());
           }
         }
         return f;
       },
       "two sets of 4 images could be the views, left{row}_{col}.png and right{row}_{col}.png"},
      {"several light fields in a folder",
       [](const fs::path& f) {
         for (int i = 0; i < 4; ++i) {
           io::write_png(f / ("IMG_" + std::to_string(i) + "_macpi.png"),
                         Image<std::uint8_t>(2, 2).view());
         }
         return f;
       },
       "IMG_0_macpi.png"},
      {"one picture",
       [](const fs::path& f) {
         io::write_png(f / "a.png", Image<std::uint8_t>(2, 2).view());
         return f;
       },
       "do not form a grid of views"},
      {"benchmark with a missing view",
       [](const fs::path& f) {
         const fs::path scene = benchmark(f);
         fs::remove(scene / "input_Cam004.png");
         return scene;
       },
       "input_Cam004.png: this view is missing: 8 of 9"},
      {"benchmark without cfg and with a missing view",
       [](const fs::path& f) {
         const fs::path scene = benchmark(f);
         fs::remove(scene / "parameters.cfg");
         fs::remove(scene / "input_Cam004.png");
         return scene;
       },
       "do not form a square grid"},
      {"benchmark with a broken cfg",
       [](const fs::path& f) {
         const fs::path scene = benchmark(f);
         std::ofstream(scene / "parameters.cfg") << "num_cams_x = many\n";
         return scene;
       },
       "num_cams_x is 'many'"},
      {"benchmark with truth of another size",
       [](const fs::path& f) {
         const fs::path scene = benchmark(f);
         io::write_pfm(scene / "gt_disp_lowres_Cam002.pfm", Image<float>(3, 3).view());
         return scene;
       },
       "this map has 3×3 px, but the views have 80×64 px"},
      {"benchmark with cut truth",
       [](const fs::path& f) {
         const fs::path scene = benchmark(f);
         fs::resize_file(scene / "gt_disp_lowres_Cam002.pfm", 5000);
         return scene;
       },
       "truncated"},
  };
=======
  std::vector<Broken> all = broken_archives();
  for (const auto& more : {broken_folders(), broken_places()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
>>>>>>> a3ee101 (io: sizes that files claim are checked before memory is taken; a wider table of broken input)
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
    QElapsedTimer clock;
    clock.start();

    try {
      (void)io::open_scene(path, {}, Progress(2));
      QFAIL("the input was accepted");
    } catch (const IoError& error) {
      verify_sentence(error, broken.expected);
    }

    // Every input of the table is small: none takes more than a library that is loaded first.
    const QByteArray taken = QByteArray::number(static_cast<double>(memory.used()) / (1 << 20));
    QVERIFY2(memory.used() < (std::uintmax_t{100} << 20), (taken + " MiB").constData());
    QVERIFY2(clock.elapsed() < 10000, QByteArray::number(clock.elapsed()) + " ms");
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
