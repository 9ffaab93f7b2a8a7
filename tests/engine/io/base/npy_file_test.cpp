// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/npy.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <cmath>
#include <cstring>
#include <fstream>
#include <numeric>

namespace episcope::in_npy_file_test {

class NpyFileTest : public QObject {
  Q_OBJECT

 private:
  QTemporaryDir folder_;
  std::filesystem::path path(const char* name) const {
    return std::filesystem::path(folder_.path().toStdString()) / name;
  }
  /// A file of the given version with this dictionary as its header.
  std::filesystem::path write(const char* name, const std::string& dictionary,
                              const std::string& samples, int version = 1) const {
    std::ofstream out(path(name), std::ios::binary);
    out << "\x93NUMPY" << static_cast<char>(version) << '\0';
    const std::size_t length = dictionary.size();
    out << static_cast<char>(length & 255) << static_cast<char>(length >> 8);
    if (version > 1) out << '\0' << '\0';
    out << dictionary << samples;
    return path(name);
  }
  static std::string dictionary(const std::string& type, const std::string& shape,
                                bool is_fortran = false) {
    return "{'descr': '" + type + "', 'fortran_order': " + (is_fortran ? "True" : "False") +
           ", 'shape': " + shape + ", }";
  }
  template <class T>
  static std::string bytes(std::initializer_list<T> numbers) {
    std::string text(numbers.size() * sizeof(T), '\0');
    std::memcpy(text.data(), std::data(numbers), text.size());
    return text;
  }

 private slots:
  void roundTrip_keepsShapeAndSamples() {
    std::vector<std::uint16_t> samples(2 * 3 * 4);
    std::iota(samples.begin(), samples.end(), std::uint16_t{65500});

    io::write_npy<std::uint16_t>(path("trip.npy"), {2, 3, 4}, samples);
    const io::NpyFile file(path("trip.npy"));
    std::vector<std::uint16_t> read(samples.size());
    file.read({0, 0, 0}, file.shape(), read.data());

    QCOMPARE(file.shape(), (io::ArrayShape{2, 3, 4}));
    QCOMPARE(file.type(), io::NumberType::UInt16);
    QCOMPARE(file.header().bytes % 64, std::size_t{0});
    QCOMPARE(read, samples);
  }

  void block_isReadFromTheMiddle() {
    std::vector<std::int32_t> samples(4 * 5 * 6);
    std::iota(samples.begin(), samples.end(), 0);
    io::write_npy<std::int32_t>(path("block.npy"), {4, 5, 6}, samples);

    const io::NpyFile file(path("block.npy"));
    std::vector<std::int32_t> read(2 * 2 * 3);
    file.read({1, 2, 3}, {2, 2, 3}, read.data());

    const std::vector<std::int32_t> expected{45, 46, 47, 51, 52, 53, 75, 76, 77, 81, 82, 83};
    QCOMPARE(read, expected);
  }

  void types_areConverted_data() {
    QTest::addColumn<QString>("type");
    QTest::addColumn<QByteArray>("samples");
    const auto row = [](const char* type, const std::string& samples) {
      QTest::newRow(type) << QString(type) << QByteArray::fromStdString(samples);
    };
    row("|b1", bytes<std::uint8_t>({0, 1}));
    row("|i1", bytes<std::int8_t>({0, 1}));
    row("|u1", bytes<std::uint8_t>({0, 1}));
    row("<i2", bytes<std::int16_t>({0, 1}));
    row(">u2", bytes<std::uint16_t>({0, 256}));
    row(">i4", bytes<std::uint32_t>({0, 1U << 24}));
    row("<u4", bytes<std::uint32_t>({0, 1}));
    row("<i8", bytes<std::int64_t>({0, 1}));
    row(">u8", bytes<std::uint64_t>({0, std::uint64_t{1} << 56}));
    row("<f2", bytes<std::uint16_t>({0, 0x3C00}));
    row(">f2", bytes<std::uint16_t>({0, 0x003C}));
    row("<f4", bytes<float>({0, 1}));
    row(">f4", bytes<std::uint32_t>({0, 0x0000803F}));
    row("<f8", bytes<double>({0, 1}));
    row("=f8", bytes<double>({0, 1}));
  }
  void types_areConverted() {
    QFETCH(QString, type);
    QFETCH(QByteArray, samples);
    const auto file =
        write("type.npy", dictionary(type.toStdString(), "(1, 2)"), samples.toStdString());

    const Image<float> map = io::read_npy_map(file);
    const Image<std::int32_t> labels = io::read_npy_labels(file);

    QCOMPARE(map.height(), 1);
    QCOMPARE(map.at(0, 0), 0.0F);
    QCOMPARE(map.at(0, 1), 1.0F);
    QCOMPARE(labels.at(0, 1), 1);
  }

  void halfFloats_keepSmallAndOddValues() {
    const auto file = write("half.npy", dictionary("<f2", "(1, 5)"),
                            bytes<std::uint16_t>({0x0001, 0x7BFF, 0xFC00, 0x7E00, 0xC100}));

    const Image<float> map = io::read_npy_map(file);

    QCOMPARE(map.at(0, 0), std::ldexp(1.0F, -24));
    QCOMPARE(map.at(0, 1), 65504.0F);
    QCOMPARE(map.at(0, 2), -std::numeric_limits<float>::infinity());
    QVERIFY(std::isnan(map.at(0, 3)));
    QCOMPARE(map.at(0, 4), -2.5F);
  }

  void fortranOrder_isTurned() {
    const auto file = write("fortran.npy", dictionary("<f4", "(2, 3)", true),
                            bytes<float>({0, 10, 1, 11, 2, 12}));

    const Image<float> map = io::read_npy_map(file);

    QCOMPARE(map.height(), 2);
    QCOMPARE(map.width(), 3);
    QCOMPARE(map.at(0, 2), 2.0F);
    QCOMPARE(map.at(1, 0), 10.0F);
  }

  void laterVersions_areRead() {
    const auto two = write("two.npy", dictionary("|u1", "(1, 1)"), "\7", 2);
    const auto three = write("three.npy", dictionary("|u1", "(1L, 1L)"), "\7", 3);

    QCOMPARE(io::read_npy_labels(two).at(0, 0), 7);
    QCOMPARE(io::read_npy_labels(three).at(0, 0), 7);
  }

  void maps_mayHaveAxesOfLengthOne() {
    const auto file = write("axes.npy", dictionary("|u1", "(1, 2, 3, 1)"), "abcdef");

    QCOMPARE(io::read_npy_labels(file).at(1, 2), static_cast<int>('f'));
  }

  void badFiles_areRefused_data() {
    QTest::addColumn<QString>("header");
    QTest::addColumn<QString>("expected");
    const auto row = [](const char* name, const std::string& header, const char* expected) {
      QTest::newRow(name) << QString::fromStdString(header) << expected;
    };
    row("10^12 elements", dictionary("<f8", "(1000000, 1000000)"), "1000000×1000000 float64");
    row("overflow", dictionary("<f8", "(4294967296, 4294967296, 4294967296)"), "the file ends");
    row("longer than any number", dictionary("<f8", "(99999999999999999999, 2)"), "valid shape");
    row("negative", dictionary("<f8", "(-3, 2)"), "valid shape");
    row("unclosed", "{'descr': '<f8', 'shape': (3, 2", "valid shape");
    row("objects", dictionary("|O", "(2, 2)"), "pickled Python objects");
    row("records", "{'descr': [('a', '<f4')], 'shape': (2, 2), }", "records");
    row("text", dictionary("<U5", "(2, 2)"), "the type U5");
    row("complex", dictionary("<c8", "(2, 2)"), "complex");
    row("no type", "{'shape': (2, 2), }", "descr");
    row("nothing", "", "descr");
    row("three axes", dictionary("|u1", "(2, 2, 2)"), "2×2×2");
    row("empty", dictionary("|u1", "(0, 2)"), "0×2");
  }
  void badFiles_areRefused() {
    QFETCH(QString, header);
    QFETCH(QString, expected);
    const auto file = write("bad.npy", header.toStdString(), "12345678");

    try {
      (void)io::read_npy_map(file);
      QFAIL("the file was accepted");
    } catch (const IoError& error) {
      QVERIFY2(QString(error.what()).contains(expected), error.what());
    }
  }

  void truncatedFiles_areRefused() {
    const std::vector<float> samples(100);
    io::write_npy<float>(path("whole.npy"), {10, 10}, samples);
    const auto size = std::filesystem::file_size(path("whole.npy"));

    for (std::uintmax_t bytes = 0; bytes < size; bytes += 9) {
      std::filesystem::copy_file(path("whole.npy"), path("cut.npy"),
                                 std::filesystem::copy_options::overwrite_existing);
      std::filesystem::resize_file(path("cut.npy"), bytes);
      QVERIFY_THROWS_EXCEPTION(IoError, (void)io::read_npy_map(path("cut.npy")));
    }
  }

  void fractions_areNoLabels() {
    const auto file = write("half.npy", dictionary("<f4", "(1, 1)"), bytes<float>({0.5F}));

    QVERIFY_THROWS_EXCEPTION(IoError, (void)io::read_npy_labels(file));
  }

  void anotherShape_isNotWritten() {
    const std::vector<float> samples(5);

    QVERIFY_THROWS_EXCEPTION(InvalidInput, io::write_npy<float>(path("no.npy"), {2, 2}, samples));
    QVERIFY(!std::filesystem::exists(path("no.npy")));
  }
};

}  // namespace episcope::in_npy_file_test

EPISCOPE_TEST(npy_file_test, NpyFileTest)
#include "npy_file_test.moc"
