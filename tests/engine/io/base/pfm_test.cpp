// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/exchange_files.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <limits>

namespace episcope::in_pfm_test {

class PfmTest : public QObject {
  Q_OBJECT

 private:
  QTemporaryDir folder_;
  std::filesystem::path path(const char* name) const {
    return std::filesystem::path(folder_.path().toStdString()) / name;
  }
  void write(const std::filesystem::path& file, const std::string& header,
             const std::vector<std::uint32_t>& samples) const {
    std::ofstream out(file, std::ios::binary);
    out << header;
    out.write(reinterpret_cast<const char*>(samples.data()),
              static_cast<std::streamsize>(samples.size() * 4));
  }

 private slots:
  void roundTrip_keepsEveryBit_data() {
    QTest::addColumn<int>("channels");
    QTest::newRow("Pf") << 1;
    QTest::newRow("PF") << 3;
  }
  void roundTrip_keepsEveryBit() {
    QFETCH(int, channels);
    Image<float> image(7, 5, channels);
    std::uint32_t bits = 12345;
    for (float& sample : image) {
      sample = std::bit_cast<float>(bits);
      bits = bits * 1664525U + 1013904223U;
    }
    image.at(0, 0) = -0.0F;
    image.at(0, 1) = std::bit_cast<float>(0x7FC01234U);  // NaN with a payload
    image.at(1, 0) = -std::numeric_limits<float>::infinity();
    image.at(1, 1) = std::numeric_limits<float>::denorm_min();

    io::write_pfm(path("trip.pfm"), image.view());
    const Image<float> read = io::read_pfm(path("trip.pfm"));

    QCOMPARE(read.height(), 7);
    QCOMPARE(read.width(), 5);
    QCOMPARE(read.channels(), channels);
    QCOMPARE(std::memcmp(read.data(), image.data(), image.size() * 4), 0);
  }

  void rows_areStoredBottomToTop() {
    Image<float> image(2, 1);
    image.at(0, 0) = 1;
    image.at(1, 0) = 2;

    io::write_pfm(path("rows.pfm"), image.view());

    std::ifstream in(path("rows.pfm"), std::ios::binary);
    std::string text((std::istreambuf_iterator<char>(in)), {});
    float first = 0;
    std::memcpy(&first, text.data() + text.size() - 8, 4);
    QCOMPARE(first, 2.0F);
  }

  void header_acceptsCommentsScaleAndByteOrder() {
    const std::uint32_t one = std::bit_cast<std::uint32_t>(1.5F);
    write(path("big.pfm"), "Pf\n# made by hand\n2 1 # size\n2.0\n",
          {__builtin_bswap32(one), __builtin_bswap32(one)});
    write(path("little.pfm"), "Pf 2 1\n-0.5\n", {one, one});

    QCOMPARE(io::read_pfm(path("big.pfm")).at(0, 1), 3.0F);
    QCOMPARE(io::read_pfm(path("little.pfm")).at(0, 0), 0.75F);
  }

  void linesOfWindows_endTheHeader() {
    const std::uint32_t values[] = {std::bit_cast<std::uint32_t>(1.5F),
                                    std::bit_cast<std::uint32_t>(-2.0F)};
    write(path("windows.pfm"), "Pf\r\n2 1\r\n-1.0\r\n", {values[0], values[1]});
    // The first sample begins with the byte of a line feed.
    write(path("return.pfm"), "Pf\n2 1\n-1.0\r", {0x3F80000AU, values[1]});

    const Image<float> windows = io::read_pfm(path("windows.pfm"));
    QCOMPARE(windows.at(0, 0), 1.5F);
    QCOMPARE(windows.at(0, 1), -2.0F);
    QCOMPARE(io::read_pfm(path("return.pfm")).at(0, 1), -2.0F);
  }

  void grayOfThreeChannels_isAMap() {
    Image<float> image(2, 2, 3);
    for (int i = 0; i < 4; ++i) std::fill_n(&image.at(i / 2, i % 2), 3, 0.5F * i);
    io::write_pfm(path("gray.pfm"), image.view());
    image.at(1, 0, 2) = 7;
    io::write_pfm(path("colour.pfm"), image.view());

    QCOMPARE(io::read_pfm_map(path("gray.pfm")).channels(), 1);
    QCOMPARE(io::read_pfm_map(path("gray.pfm")).at(1, 1), 1.5F);
    QVERIFY_THROWS_EXCEPTION(IoError, (void)io::read_pfm_map(path("colour.pfm")));
  }

  void badFiles_areRefused_data() {
    QTest::addColumn<QString>("header");
    QTest::addColumn<QString>("expected");
    QTest::newRow("another kind") << "P6\n1 1\n255\n"
                                  << "Pf";
    QTest::newRow("no size") << "Pf\n"
                             << "width";
    QTest::newRow("negative size") << "Pf\n-3 1\n-1\n"
                                   << "not valid";
    QTest::newRow("scale 0") << "Pf\n1 1\n0\n"
                             << "not valid";
    QTest::newRow("huge") << "Pf\n99999999 99999999\n-1\n"
                          << "not valid";
    QTest::newRow("cut short") << "Pf\n3 3\n-1\n"
                               << "0 of 3 rows";
  }
  void badFiles_areRefused() {
    QFETCH(QString, header);
    QFETCH(QString, expected);
    write(path("bad.pfm"), header.toStdString(), {0, 0});

    try {
      (void)io::read_pfm(path("bad.pfm"));
      QFAIL("the file was accepted");
    } catch (const IoError& error) {
      QVERIFY2(QString(error.what()).contains(expected), error.what());
    }
  }

  void twoChannels_areRefused() {
    const Image<float> image(2, 2, 2);

    QVERIFY_THROWS_EXCEPTION(InvalidInput, io::write_pfm(path("two.pfm"), image.view()));
    QVERIFY(!std::filesystem::exists(path("two.pfm")));
  }
};

}  // namespace episcope::in_pfm_test

EPISCOPE_TEST(pfm_test, PfmTest)
#include "pfm_test.moc"
