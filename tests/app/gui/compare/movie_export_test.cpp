// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/picture_export.h"
#include "app/gui/scene/overlay.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QFile>
#include <QFileDialog>
#include <QImageReader>

namespace episcope::in_movie_export_test {

namespace {

std::vector<QImage> pictures_in(const QString& path) {
  QImageReader reader(path);
  std::vector<QImage> pictures;
  while (reader.canRead()) {
    const QImage picture = reader.read();
    if (picture.isNull()) break;
    pictures.push_back(picture.convertToFormat(QImage::Format_RGB888));
  }
  return pictures;
}

// Mean difference of samples: palettes are coarse.
double difference(const QImage& a, const QImage& b) {
  if (a.size() != b.size()) return 255;
  double sum = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
      sum += std::abs(qRed(p) - qRed(q)) + std::abs(qGreen(p) - qGreen(q)) +
             std::abs(qBlue(p) - qBlue(q));
    }
  }
  return sum / (3.0 * a.width() * a.height());
}

class Filming : public WindowFixture {
 public:
  explicit Filming(bool with_result = false) {
    openSmall();
    if (with_result) runAndWait();
    trigger("file.save_movie");
  }
  void choose(const QString& name, const QString& text) {
    auto* box = window.findChild<QComboBox*>(name);
    QVERIFY(box && box->isEnabled());
    box->window()->activateWindow();
    QTRY_COMPARE_WITH_TIMEOUT(QApplication::activeWindow(), box->window(), kPatience);
    box->setFocus();
    for (int i = 0; i < box->count() && !box->currentText().startsWith(text); ++i) {
      QTest::keyClick(box, Qt::Key_Down);
    }
    QVERIFY2(box->currentText().startsWith(text), qPrintable(box->currentText()));
  }
  std::vector<QImage> save(const QString& name) {
    find<MovieExport>(window).save(path(name));
    [&] {
      QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(path(name)), kPatience);
      QTRY_COMPARE_WITH_TIMEOUT(window.bench().jobs.count(), 0, kPatience);
    }();
    return pictures_in(path(name));
  }
  QImage shown() { return canvas()->picture().convertToFormat(QImage::Format_RGB888); }
};

}  // namespace

class MovieExportTest : public QObject {
  Q_OBJECT

 private slots:
  void parallax_showsTheViewsOfThePath() {
    Filming f;
    QVERIFY(f.window.findChild<QDialog*>("movie")->isVisible());
    f.choose("movie.path", "Along");

    const auto pictures = f.save("a.gif");

    QVERIFY(!f.window.findChild<QDialog*>("movie")->isVisible());
    QCOMPARE(pictures.size(), std::size_t{16});
    const ViewIndex center = f.view();
    for (const int u : {0, 4, 8}) {
      f.window.bench().session.set_view({center.v, u});
      QTRY_VERIFY_WITH_TIMEOUT(difference(pictures[u], f.shown()) < 6, kPatience);
    }
    f.window.bench().session.set_view({center.v, 0});
    QTRY_VERIFY_WITH_TIMEOUT(difference(pictures[8], f.shown()) > 6, kPatience);
  }

  void cancel_writesNothing() {
    Filming f;

    f.click("movie.cancel");

    QVERIFY(!f.window.findChild<QDialog*>("movie")->isVisible());
    QVERIFY(!f.window.findChild<QFileDialog*>());
  }

  void overlay_isDrawnUnlessLeftOut() {
    Filming f(true);
    QTRY_VERIFY_WITH_TIMEOUT(!f.window.bench().overlay.picture().isNull(), kPatience);
    f.trigger("file.save_movie");
    const auto with_map = f.save("with.gif");
    f.trigger("file.save_movie");
    f.click("movie.overlay");
    QVERIFY(!f.window.findChild<QCheckBox*>("movie.overlay")->isChecked());
    const auto without = f.save("without.gif");

    QCOMPARE(with_map.size(), without.size());
    QVERIFY(difference(with_map[0], without[0]) > 10);
  }

  void refocus_goesThroughTheDisparities() {
    Filming f;
    f.choose("movie.kind", "Refocusing");
    QVERIFY(!f.window.findChild<QComboBox*>("movie.path")->isEnabled());

    const auto pictures = f.save("b.gif");

    QCOMPARE(pictures.size(), std::size_t{36});
    QVERIFY(difference(pictures[0], pictures[18]) > 2);
    QVERIFY(difference(pictures[9], pictures[27]) < 6);  // the way back
  }

  void flip_needsSomethingToFlip() {
    Filming f(true);
    QTRY_VERIFY_WITH_TIMEOUT(!f.window.bench().overlay.picture().isNull(), kPatience);
    f.window.bench().overlay.setQuantity(render::Quantity::Confidence);
    f.trigger("file.save_movie");
    f.choose("movie.kind", "Flip");

    const auto pictures = f.save("c.gif");

    QCOMPARE(pictures.size(), std::size_t{2});
    QVERIFY(difference(pictures[0], pictures[1]) > 10);  // confidence and truth
  }

  void wrongSuffix_isTold() {
    Filming f;
    find<MovieExport>(f.window).save(f.path("a.txt"));
    QVERIFY(!QFile::exists(f.path("a.txt")));
    QCOMPARE(f.window.bench().jobs.count(), std::size_t{0});
  }
};

}  // namespace episcope::in_movie_export_test

EPISCOPE_WINDOW_TEST(movie_export_test, MovieExportTest)
#include "movie_export_test.moc"
