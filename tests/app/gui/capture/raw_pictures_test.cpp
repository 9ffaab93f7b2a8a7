// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/capture/raw_pictures.h"
#include "app/gui/capture/capture_controller.h"
#include "app/session/raw_scene.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/controls/labels.h"
#include "widgets/controls/message_bar.h"

#include <QComboBox>
#include <QPushButton>
#include <QTabWidget>

namespace episcope::in_raw_pictures_test {

namespace {

class RawFixture : public WindowFixture {
 public:
  /// Raw picture of a small sensor.
  [[nodiscard]] QString write(capture::CameraModel model, const QString& name) const {
    capture::SyntheticCamera camera = capture::synthetic_camera(model);
    camera.width = 480;
    camera.height = 360;
    const RawFolder files =
        write_raw_folder(path(name).toStdString(), {"edge", {}}, camera, Progress(2));
    return QString::fromStdString(files.raw.string());
  }
  [[nodiscard]] QString full(const char* label) const {
    return window.findChild<FoldedLabel*>(label)->fullText();
  }
  [[nodiscard]] RawPictures& raw() const { return find<CaptureController>(window).rawPictures(); }
  [[nodiscard]] bool isRawPage() const {
    return window.findChild<QWidget*>("rawPicturePanel")->isVisible();
  }
};

}  // namespace

class RawPicturesTest : public QObject {
  Q_OBJECT

 private slots:
  void rawPicture_isDecodedStepByStep() {
    RawFixture f;
    const QString raw = f.write(capture::CameraModel::Square, "square");
    f.trigger("tab.capture");
    auto* decode = f.window.findChild<QPushButton*>("raw.views");
    QVERIFY(!decode->isEnabled());

    f.raw().open(raw);
    QTRY_VERIFY_WITH_TIMEOUT(f.full("raw.lenses.state").contains("square"), kScenePatience);
    QVERIFY(f.isRawPage());
    QVERIFY2(f.full("raw.picture.state").startsWith("raw.png: 480×360 px"),
             qPrintable(f.full("raw.picture.state")));
    QVERIFY(f.full("raw.white.state").contains("raw_white.png"));
    QCOMPARE(f.window.findChild<QComboBox*>("raw.shown")->count(), 3);  // raw, white, dark
    QVERIFY(decode->isEnabled());

    const QString lenses = f.full("raw.lenses.state");
    f.click("raw.lenses");
    QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kScenePatience);
    QCOMPARE(f.full("raw.lenses.state"), lenses);

    f.raw().decode(f.path("lf.h5"), {.views = 5});
    QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().session.scene() != nullptr, kScenePatience);
    QCOMPARE(f.window.bench().session.light_field()->grid(), (GridShape{5, 5}));
    QVERIFY2(f.full("raw.views.state").startsWith("5×5 views"),
             qPrintable(f.full("raw.views.state")));
  }

  void openedContainer_isShownWithItsRawPicture() {
    RawFixture f;
    const QString raw = f.write(capture::CameraModel::Illum, "illum");
    f.window.bench().opener.open(raw);
    QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().session.scene() != nullptr, kScenePatience);

    f.trigger("tab.capture");

    QTRY_VERIFY_WITH_TIMEOUT(f.full("raw.lenses.state").contains("hexagonal"), kScenePatience);
    QVERIFY(f.isRawPage());
    QVERIFY(f.full("raw.picture.state").contains("grbg"));
    for (const char* state : {"raw.picture.state", "raw.white.state", "raw.lenses.state"}) {
      const QString shown = f.window.findChild<FoldedLabel*>(state)->text();
      QVERIFY2(!shown.contains(QChar(0x2026)), qPrintable(shown));
    }
  }

  void pictureWithoutLenses_isToldAndStays() {
    RawFixture f;
    const QString raw = f.write(capture::CameraModel::Square, "square");
    f.trigger("tab.capture");
    const QString dark = QString(raw).replace("raw.png", "raw_dark.png");

    f.raw().open(dark);

    QTRY_VERIFY_WITH_TIMEOUT(
        f.window.findChild<MessageBar*>("messageBar")->text().contains("no array of microlenses"),
        kScenePatience);
    QVERIFY(f.full("raw.picture.state").startsWith("raw_dark.png"));
    QVERIFY(!f.window.findChild<QPushButton*>("raw.views")->isEnabled());
  }
};

}  // namespace episcope::in_raw_pictures_test

EPISCOPE_WINDOW_TEST(raw_pictures_test, RawPicturesTest)
#include "raw_pictures_test.moc"
