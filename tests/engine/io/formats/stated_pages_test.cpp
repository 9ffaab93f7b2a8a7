// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/tiff_pages.h"
#include "tests/test_main.h"

namespace episcope::in_stated_pages_test {

class StatedPagesTest : public QObject {
  Q_OBJECT

 private slots:
  void axes_areThoseOfTheProgram_data() {
    QTest::addColumn<QString>("description");
    QTest::addColumn<int>("pages");
    QTest::addColumn<int>("channels");
    QTest::addColumn<int>("views_in_turn");
    QTest::addColumn<QString>("grid");
    const QString imagej = "ImageJ=1.53t\nimages=162\n";
    QTest::newRow("ImageJ") << imagej + "channels=2\nslices=9\nframes=9\nhyperstack=true\n"
                            << 162 << 2 << 1 << "9x9";
    QTest::newRow("ImageJ, a list") << imagej + "channels=2\nslices=81\n" << 162 << 2 << 1 << "";
    QTest::newRow("ImageJ, views as channels") << imagej + "channels=9\nslices=18\n"
                                               << 162 << 1 << 1 << "18x9";
    const QString ome =
        "<OME><Image><Pixels DimensionOrder=\"%1\" SizeC=\"3\" SizeT=\"9\" "
        "SizeX=\"64\" SizeY=\"48\" SizeZ=\"5\"/></Image></OME>";
    QTest::newRow("OME") << ome.arg("XYCZT") << 135 << 3 << 1 << "9x5";
    QTest::newRow("OME, channels between") << ome.arg("XYZCT") << 135 << 3 << 5 << "9x5";
    QTest::newRow("OME, channels last") << ome.arg("XYTZC") << 135 << 3 << 45 << "5x9";
    QTest::newRow("OME, colored pages") << ome.arg("XYCZT") << 45 << 1 << 1 << "9x5";
    QTest::newRow("tifffile") << R"({"shape": [9, 5, 48, 64]})" << 45 << 1 << 1 << "9x5";
    QTest::newRow("tifffile, colored")
        << R"({"shape": [9, 5, 48, 64, 3]})" << 45 << 1 << 1 << "9x5";
    QTest::newRow("tifffile, channels last")
        << R"({"shape": [9, 5, 3, 48, 64]})" << 135 << 3 << 1 << "9x5";
    QTest::newRow("tifffile, channels first")
        << R"({"shape": [3, 9, 5, 48, 64]})" << 135 << 3 << 45 << "9x5";
    QTest::newRow("tifffile, axes named")
        << R"({"shape": [9, 2, 48, 64], "axes": "QCYX"})" << 18 << 2 << 1 << "";
  }
  void axes_areThoseOfTheProgram() {
    QFETCH(QString, description);
    QFETCH(int, pages);
    QFETCH(int, channels);
    QFETCH(int, views_in_turn);
    QFETCH(QString, grid);

    const auto stated = io::stated_pages(description.toStdString(), pages);

    QVERIFY(stated);
    QCOMPARE(stated->order.channels, channels);
    QCOMPARE(stated->order.views_in_turn, views_in_turn);
    const QString found =
        stated->grid ? QString("%1x%2").arg(stated->grid->v).arg(stated->grid->u) : "";
    QCOMPARE(found, grid);
  }

  void whatSaysNothingOfThePages_isLeft_data() {
    QTest::addColumn<QString>("description");
    QTest::newRow("nothing") << "";
    QTest::newRow("a sentence") << "Light field of a flower";
    QTest::newRow("other pages") << "ImageJ=1.53t\nchannels=2\nslices=9\n";
    QTest::newRow("large numbers")
        << "ImageJ=1.53t\nchannels=2\nslices=2000000000\nframes=2000000000\n";
    QTest::newRow("none") << "ImageJ=1.53t\nslices=0\nframes=-20\n";
    QTest::newRow("no shape") << R"({"shape": "20"})";
    QTest::newRow("negative shape") << R"({"shape": [-4, -5, 48, 64]})";
    QTest::newRow("large shape") << R"({"shape": [1e300, 20, 48, 64]})";
    QTest::newRow("axes as numbers") << R"({"shape": [4, 5, 48, 64], "axes": 7})";
    QTest::newRow("no JSON") << R"({"shape": [4, 5)";
    QTest::newRow("OME without an order") << "<OME><Pixels SizeC=\"2\"/></OME>";
    QTest::newRow("OME cut off") << "<OME><Pixels DimensionOrder=\"XY";
  }
  void whatSaysNothingOfThePages_isLeft() {
    QFETCH(QString, description);
    QVERIFY(!io::stated_pages(description.toStdString(), 20));
  }
};

}  // namespace episcope::in_stated_pages_test

EPISCOPE_TEST(stated_pages_test, StatedPagesTest)
#include "stated_pages_test.moc"
