// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/builtin.h"

#include "engine/core/error.h"
#include "tests/test_main.h"

namespace episcope::in_request_test {

using scenes::RandomKind;
using scenes::read_request;

class RequestTest : public QObject {
  Q_OBJECT

 private slots:
  void sceneAlone_hasTheUsualOptions() {
    const scenes::BuiltinRequest request = read_request("slant");

    QCOMPARE(request.scene, std::string("slant"));
    QVERIFY(request.is_plain());
    QCOMPARE(request.name(), std::string("slant"));
  }

  void everyKey_isRead() {
    const auto request =
        read_request("random?seed=7&kind=thin&size=320x240&grid=5x7&noise=2.5&channels=1");

    QCOMPARE(request.scene, std::string("random"));
    QCOMPARE(request.options.seed, 7U);
    QVERIFY(request.options.kind == RandomKind::Thin);
    QCOMPARE(request.options.width, 320);
    QCOMPARE(request.options.height, 240);
    QCOMPARE(request.options.grid, (GridShape{5, 7}));
    QCOMPARE(request.options.noise_sigma, 2.5);
    QCOMPARE(request.options.channels, 1);
    QVERIFY(!request.is_plain());
    QCOMPARE(request.name(), std::string("random_thin_7"));
  }

  void oneNumber_isBothSides() {
    const auto request = read_request("objects?size=96&grid=3");

    QCOMPARE(request.options.width, 96);
    QCOMPARE(request.options.height, 96);
    QCOMPARE(request.options.grid, (GridShape{3, 3}));
    QCOMPARE(request.name(), std::string("objects"));
  }

  void everyKind_isReadByItsName() {
    const auto names = all_names<scenes::RandomKind>();

    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto request = read_request("random?kind=" + names[i]);
      QCOMPARE(static_cast<std::size_t>(request.options.kind), i);
    }
    QCOMPARE(names.size(), static_cast<std::size_t>(RandomKind::Faint) + 1);
  }

  void badRequests_sayWhatIsPossible_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("words");
    QTest::newRow("no number") << "random?seed=x"
                               << "'x' is no seed; write seed=N";
    QTest::newRow("negative") << "random?seed=-1"
                              << "'-1' is no seed";
    QTest::newRow("half a number") << "random?seed=7x"
                                   << "'7x' is no seed";
    QTest::newRow("too large") << "random?seed=99999999999"
                               << "is no seed";
    QTest::newRow("no value") << "random?seed"
                              << "'' is no seed";
    QTest::newRow("unknown key") << "random?sead=7"
                                 << "'sead' is not known";
    QTest::newRow("nothing") << "random?"
                             << "seed=N, kind=NAME, size=256 or 320x240, grid=9x9";
    QTest::newRow("unknown kind") << "random?kind=thinn"
                                  << "did you mean 'thin'? (there are any,";
    QTest::newRow("kind of another scene") << "slant?kind=thin"
                                           << "only the scene 'random'";
    QTest::newRow("three sides") << "random?size=1x2x3"
                                 << "'1x2x3' is no size";
    QTest::newRow("not a number") << "random?noise=nan"
                                  << "'nan' is no noise";
    QTest::newRow("second key") << "random?seed=1&gird=9x9"
                                << "'gird' is not known";
  }
  void badRequests_sayWhatIsPossible() {
    QFETCH(QString, text);
    QFETCH(QString, words);
    QString message;

    try {
      std::ignore = read_request(text.toStdString());
    } catch (const InvalidInput& error) {
      message = QString::fromUtf8(error.what());
    }

    QVERIFY2(message.contains(text) && message.contains(words), qPrintable(message));
  }

  void unknownScene_isRefusedWithTheNearest() {
    QVERIFY_THROWS_EXCEPTION(Unavailable, std::ignore = read_request("randon?seed=1"));
  }
};

}  // namespace episcope::in_request_test

EPISCOPE_TEST(request_test, RequestTest)
#include "request_test.moc"
