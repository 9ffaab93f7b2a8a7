// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/models/names/view_files.h"
#include "engine/io/open.h"
#include "engine/io/write.h"
#include "tests/cpu_time.h"
#include "tests/engine/io/memory_use.h"
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/patience.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <random>

namespace episcope::in_mutation_test {

using namespace episcope::test;

namespace fs = std::filesystem;

namespace {

constexpr int kMutations = 300;  ///< Of every form.

std::vector<fs::path> files_below(const fs::path& path) {
  if (fs::is_regular_file(path)) return {path};
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string bytes_of_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Cuts, flips bits, or puts bytes that headers are sensitive to; mostly near the begin.
std::string mutated(std::string bytes, std::mt19937& random) {
  const auto below = [&](std::size_t count) { return random() % std::max<std::size_t>(1, count); };
  if (below(5) == 0) {
    bytes.resize(below(bytes.size()));
    return bytes;
  }
  constexpr unsigned char kTelling[] = {0, 1, 0x7F, 0x80, 0xFF, '9', '-', ','};
  const std::size_t changes = 1 + below(4);
  for (std::size_t i = 0; i < changes && !bytes.empty(); ++i) {
    const std::size_t span =
        below(3) == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 700);
    char& byte = bytes[below(span)];
    if (below(2) == 0) {
      byte = static_cast<char>(kTelling[below(std::size(kTelling))]);
    } else {
      byte = static_cast<char>(byte ^ (1 << below(8)));
    }
  }
  return bytes;
}

}  // namespace

/// Files that were damaged at random, though always in the same way.
class MutationTest : public QObject {
  Q_OBJECT

 private slots:
  void damagedFile_opensOrIsRefused_data() {
    QTest::addColumn<std::size_t>("form");
    for (std::size_t i = 0; i < io::writers().size(); ++i) {
      QTest::newRow(io::writers()[i].id) << i;
    }
  }
  void damagedFile_opensOrIsRefused() {
    QFETCH(std::size_t, form);
    const io::Writer& writer = io::writers()[form];
    const QTemporaryDir place;
    const fs::path path =
        fs::path(place.path().toStdString()) /
        (writer.writes_folder() ? "scene" : std::string("scene") + writer.suffixes[0]);
    writer.write(path, plane_scene({.grid = {3, 3}, .height = 10, .width = 12}), Progress(1));
    const std::vector<fs::path> files = files_below(path);
    io::OpenOptions options;
    if (writer.id == std::string("eslf")) {
      options.mosaic = io::Mosaic::Lenslets;
      options.grid = "3x3";
    }
    if (writer.id == std::string("quilt")) {
      options.mosaic = io::Mosaic::Quilt;
      options.grid = "3x1";
    }
    std::mt19937 random(20260101);
    const PeakMemory memory;
    int noticed = 0;  // refused, or opened without a view

    for (int i = 0; i < kMutations; ++i) {
      const fs::path& file = files[random() % files.size()];
      const std::string whole = bytes_of_file(file);
      write_bytes(file, mutated(whole, random));
      const double begin_ms = cpu_time_ms();
      try {
        const Scene scene = io::open_scene(path, options, Progress(1));
        if (count_unused(scene, io::kUnusableViews) > 0) ++noticed;
      } catch (const Error& error) {
        ++noticed;
        QVERIFY2(std::string(error.what()).find("not enough memory") == std::string::npos,
                 (error.what() + std::string(" at mutation ") + std::to_string(i)).c_str());
      }
      QVERIFY2(cpu_time_ms() - begin_ms < 5000 * kSlowdown, QByteArray::number(i));
      write_bytes(file, whole);
    }

    QVERIFY2(noticed > kMutations / 20, QByteArray::number(noticed));
    const QByteArray taken = QByteArray::number(static_cast<double>(memory.used()) / (1 << 20));
    QVERIFY2(memory.used() < (std::uintmax_t{200} << 20), (taken + " MiB").constData());
    (void)io::open_scene(path, options, Progress(1));  // the whole file still opens
  }
};

}  // namespace episcope::in_mutation_test

EPISCOPE_TEST(mutation_test, MutationTest)
#include "mutation_test.moc"
