// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/zip.h"
#include "tests/test_main.h"

#include <QTemporaryDir>
#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

namespace episcope::in_inflate_stream_test {

using Bytes = std::vector<std::uint8_t>;

class InflateStreamTest : public QObject {
  Q_OBJECT

 private:
  QTemporaryDir folder_;
  std::filesystem::path path() const { return folder_.filePath("packed").toStdString(); }

  // Returns how many bytes they are when deflated.
  uLong write_packed(const Bytes& whole) const {
    uLong size = compressBound(static_cast<uLong>(whole.size()));
    Bytes packed(size);
    compress(packed.data(), &size, whole.data(), static_cast<uLong>(whole.size()));
    std::ofstream(path(), std::ios::binary)
        .write(reinterpret_cast<const char*>(packed.data()), static_cast<std::streamsize>(size));
    return size;
  }

  static Bytes some_bytes(std::size_t count) {
    Bytes bytes(count);
    for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>(i % 5 * i % 251);
    return bytes;
  }

  static Bytes read_in_steps(io::InflateStream& stream, std::size_t step) {
    Bytes all;
    Bytes some(step);
    while (const std::size_t got = stream.read(step, some.data())) {
      all.insert(all.end(), some.begin(), some.begin() + static_cast<std::ptrdiff_t>(got));
    }
    return all;
  }

 private slots:
  // zlib holds bytes back when it has taken all that is stored. In zip archives, which lack the
  // head of two bytes and the checksum of four, nothing follows them.
  void bytesInSteps_areAllThere() {
    for (std::size_t count = 1; count < 400; ++count) {
      const Bytes whole = some_bytes(count);
      const uLong packed = write_packed(whole);
      for (const std::size_t step : {1, 3, 8, 64}) {
        io::InflateStream stream(path(), {"", 2, packed - 6, count, true});
        QCOMPARE(read_in_steps(stream, step), whole);
      }
    }
  }

  // Of its checksum.
  void streamWithoutItsEnd_givesWhatIsThere() {
    const Bytes whole = some_bytes(400);
    const uLong packed = write_packed(whole);
    io::InflateStream stream(path(), 0, packed - 4);
    Bytes read(whole.size());

    QCOMPARE(stream.read(read.size(), read.data()), whole.size());
    QCOMPARE(read, whole);
    QVERIFY(stream.ends_well());
  }

  void wrongChecksum_isDamage() {
    const uLong packed = write_packed(some_bytes(400));
    std::fstream file(path(), std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(static_cast<std::streamoff>(packed) - 1).put('\x55');
    file.close();
    io::InflateStream stream(path(), 0, packed);
    Bytes read(400);

    QCOMPARE(stream.read(read.size(), read.data()), read.size());
    QVERIFY(!stream.ends_well());
  }
};

}  // namespace episcope::in_inflate_stream_test

EPISCOPE_TEST(inflate_stream_test, InflateStreamTest)
#include "inflate_stream_test.moc"
