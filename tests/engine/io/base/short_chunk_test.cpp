// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "tests/cpu_time.h"
#include "tests/engine/io/base/one_dataset.h"
#include "tests/test_main.h"

#include <hdf5.h>
#include <lzf.h>
#include <QTemporaryDir>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

// Chunks that are stored shorter than they are, by damage: the library reads what lies behind them
// in memory.

namespace episcope::in_short_chunk_test {

using namespace episcope::test;

namespace {

namespace fs = std::filesystem;

constexpr hsize_t kLength = 4000;
constexpr hsize_t kChunk = 1000;  // 0x3e8

void write_chunks(const fs::path& path, bool is_compressed) {
  const auto store = [&](hid_t creation) {
    H5Pset_chunk(creation, 1, &kChunk);
    if (is_compressed) H5Pset_deflate(creation, 4);
  };
  write_row(path, kLength, store, [](hid_t dataset) { fill_row(dataset, kLength); });
}

/// Packed by LZF, the second chunk of fewer samples. `stated`: the size of a chunk as h5py states
/// it.
void write_packed(const fs::path& path, unsigned stated) {
  const auto store = [&](hid_t creation) {
    const std::array<unsigned, 3> values{4, 0x0105, stated};
    H5Pset_chunk(creation, 1, &kChunk);
    H5Pset_filter(creation, 32000, H5Z_FLAG_OPTIONAL, values.size(), values.data());
  };
  write_row(path, kLength, store, [](hid_t dataset) {
    const std::vector<std::uint8_t> samples(kChunk, 170);
    std::vector<std::uint8_t> packed(kChunk);
    for (hsize_t start = 0; start < kLength; start += kChunk) {
      const auto held = static_cast<unsigned>(start == kChunk ? 100 : kChunk);
      const unsigned size = lzf_compress(samples.data(), held, packed.data(), held - 1);
      H5Dwrite_chunk(dataset, H5P_DEFAULT, 0, &start, size, packed.data());
    }
  });
}

/// The third chunk, as the tree of chunks tells: its length, no filter skipped, where it begins.
void shorten(const fs::path& path) {
  const std::string behind("\0\0\0\0\0\0\xd0\x07\0\0\0\0\0\0", 14);
  replace_bytes(path, "\xe8\x03" + behind, std::string("\xe8\0", 2) + behind);
}

/// To 1500 samples each: in the layout, behind the number of axes and the place of the tree.
void enlarge(const fs::path& path) {
  const std::string behind("\0\0\x01\0\0\0", 6);  // and the size of a sample
  replace_bytes(path, "\xe8\x03" + behind, "\xdc\x05" + behind);
}

}  // namespace

class ShortChunkTest : public QObject {
  Q_OBJECT

 private:
  QTemporaryDir folder_;

 private slots:
  void wholeChunks_areRead_data() {
    QTest::addColumn<bool>("is_compressed");
    QTest::newRow("plain") << false;
    QTest::newRow("compressed") << true;
  }
  void wholeChunks_areRead() {
    QFETCH(bool, is_compressed);
    const fs::path path = folder_.filePath("whole.h5").toStdString();
    write_chunks(path, is_compressed);

    QCOMPARE(read_row(path, 0, kLength), std::vector<std::uint8_t>(kLength, 170));
    QCOMPARE(read_row(path, 900, 200), std::vector<std::uint8_t>(200, 170));
  }

  // Compressed ones hold fewer samples than are then asked of them.
  void largerChunks_areRefused() {
    const fs::path path = folder_.filePath("larger.h5").toStdString();
    write_chunks(path, true);
    enlarge(path);

    QVERIFY_THROWS_EXCEPTION(IoError, (void)read_row(path, 0, 100));
  }

  void shortChunk_isRefused() {
    const fs::path path = folder_.filePath("short.h5").toStdString();
    write_chunks(path, false);
    shorten(path);

    QVERIFY_THROWS_EXCEPTION(IoError, (void)read_row(path, 0, 2000));
    QVERIFY_THROWS_EXCEPTION(IoError, (void)read_row(path, 1900, 101));
  }

  void shortChunkAmongCompressed_isRefused() {
    const fs::path path = folder_.filePath("skipped.h5").toStdString();
    const auto store = [](hid_t creation) {
      H5Pset_chunk(creation, 1, &kChunk);
      H5Pset_deflate(creation, 4);
    };
    write_row(path, kLength, store, [](hid_t dataset) {
      fill_row(dataset, kLength);
      const std::vector<std::uint8_t> part(100, 170);
      const hsize_t start = 2 * kChunk;
      H5Dwrite_chunk(dataset, H5P_DEFAULT, 1, &start, part.size(), part.data());
    });

    QCOMPARE(read_row(path, 0, 2000), std::vector<std::uint8_t>(2000, 170));
    QVERIFY_THROWS_EXCEPTION(IoError, (void)read_row(path, 1900, 101));
  }

  // A look at the whole list of chunks for each of them took a minute.
  void manyChunks_areReadInLinearTime() {
    static constexpr hsize_t kMany = 200'000, kFew = 4;
    const fs::path path = folder_.filePath("many.h5").toStdString();
    const auto store = [](hid_t creation) {
      H5Pset_chunk(creation, 1, &kFew);
      H5Pset_deflate(creation, 1);
    };
    write_row(path, kMany, store, [](hid_t dataset) { fill_row(dataset, kMany); });

    const double begin = cpu_time_ms();
    const std::vector<std::uint8_t> read = read_row(path, 0, kMany);
    const double taken = cpu_time_ms() - begin;

    QCOMPARE(read, std::vector<std::uint8_t>(kMany, 170));
    QVERIFY2(taken < 5000 * kSlowdown, QByteArray::number(taken));
  }

  // LZF has no checksum: what is lost cannot be told from samples, but must not come from memory.
  void shortPackedChunk_endsInZeros() {
    const fs::path path = folder_.filePath("packed.h5").toStdString();
    write_packed(path, kChunk);

    std::vector<std::uint8_t> expected(kLength, 170);
    std::fill(expected.begin() + kChunk + 100, expected.begin() + 2 * kChunk, 0);
    QCOMPARE(read_row(path, 0, kLength), expected);
  }

  void packedChunksOfAnotherSize_areRefused() {
    const fs::path path = folder_.filePath("other_size.h5").toStdString();
    write_packed(path, kChunk / 2);

    QVERIFY_THROWS_EXCEPTION(IoError, (void)read_row(path, 0, 100));
  }
};

}  // namespace episcope::in_short_chunk_test

EPISCOPE_TEST(short_chunk_test, ShortChunkTest)
#include "short_chunk_test.moc"
