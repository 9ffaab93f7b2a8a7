// SPDX-License-Identifier: BSD-3-Clause
// Dark views are brightened for display, and for display only.
#include "app/gui/browse/value_controller.h"
#include "app/gui/scene/scene_switcher.h"
#include "engine/io/formats/write_scene.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/message_bar.h"
#include "widgets/panels/value_bar.h"

#include <QDir>
#include <QDoubleSpinBox>
#include <QPushButton>

namespace episcope::in_brightness_test {

namespace {

constexpr int kDarker = 12;

class Dark : public WindowFixture {
 public:
  Dark() {
    Scene scene = scenes::render_builtin("edge", smallOptions(), Progress());
    const auto& bright = std::get<ViewStack<std::uint8_t>>(scene.light_field->samples());
    ViewStack<std::uint8_t> samples = bright.clone();
    for (std::size_t i = 0; i < samples.size(); ++i) samples.data()[i] /= kDarker;
    LightFieldInfo info;
    info.name = "night";
    scene.light_field = std::make_shared<const LightField>(std::move(samples), info);
    QDir().mkpath(path("night"));
    io::write_archive(path("night/lf.h5").toStdString(), scene, Progress());
    window.bench().opener.open(path("night/lf.h5"));
    [&] { QTRY_VERIFY_WITH_TIMEOUT(window.bench().document.document(), kScenePatience); }();
    QCoreApplication::processEvents();
  }
  MessageBar* messages() { return window.findChild<MessageBar*>("messageBar"); }
  double brightness() {
    const QImage picture = canvas()->picture().convertToFormat(QImage::Format_Grayscale8);
    double sum = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) sum += qGray(picture.pixel(x, y));
    }
    return sum / (picture.height() * picture.width());
  }
  void set(const char* field, double value) {
    window.findChild<QDoubleSpinBox*>(field)->setValue(value);
  }
};

}  // namespace

class BrightnessTest : public QObject {
  Q_OBJECT

 private slots:
  void darkViews_areOfferedToBeBrightened();
  void brightViews_areLeftAlone();
  void exposure_doublesTheBrightness();
  void tone_belongsToItsScene();
  void tone_comesBackWithItsFile();
  void tone_changesNoSample();
};

void BrightnessTest::darkViews_areOfferedToBeBrightened() {
  Dark f;
  QTRY_VERIFY_WITH_TIMEOUT(f.messages()->text().contains("dark"), kPatience);
  const double before = f.brightness();

  f.messages()->findChild<QPushButton*>("message.action")->click();

  QTRY_VERIFY_WITH_TIMEOUT(f.brightness() > 5 * before, kPatience);
  f.trigger("view.auto_tone");  // off again
  QTRY_COMPARE(f.brightness(), before);
}

void BrightnessTest::brightViews_areLeftAlone() {
  WindowFixture f;
  f.openSmall();
  QTest::qWait(100);
  QVERIFY(!f.window.findChild<MessageBar*>("messageBar")->text().contains("dark"));
}

void BrightnessTest::exposure_doublesTheBrightness() {
  Dark f;
  f.trigger("view.tone");
  const double before = f.brightness();
  const QImage epi = f.window.bench().viewer_area.grab().toImage();

  f.set("tone.exposure", 1);
  QTRY_VERIFY(std::abs(f.brightness() - 2 * before) < 0.05 * before);
  QVERIFY(f.window.bench().viewer_area.grab().toImage() != epi);
  f.set("tone.gamma", 2);
  QTRY_VERIFY(f.brightness() > 3 * before);
  f.set("tone.black", 0.2);  // every sample is darker
  QTRY_COMPARE(f.brightness(), 0.0);
}

void BrightnessTest::tone_belongsToItsScene() {
  Dark f;
  const auto dark = f.window.bench().session.generation();
  const double before = f.brightness();
  f.trigger("view.tone");
  f.set("tone.exposure", 3);
  QTRY_VERIFY(f.brightness() > 5 * before);
  const double shown = f.brightness();

  f.openSmall("slant");
  QVERIFY(f.window.bench().session.place().tone.is_plain());
  QTRY_COMPARE(f.window.findChild<QDoubleSpinBox*>("tone.exposure")->value(), 0.0);
  f.window.bench().scenes.show(dark);

  QTRY_COMPARE(f.brightness(), shown);
  QCOMPARE(f.window.findChild<QDoubleSpinBox*>("tone.exposure")->value(), 3.0);
}

void BrightnessTest::tone_comesBackWithItsFile() {
  Dark f;
  f.trigger("view.tone");
  f.set("tone.exposure", 2.5);
  f.set("tone.gamma", 1.5);
  QTRY_COMPARE(f.window.bench().session.place().tone.gamma, 1.5);
  QCoreApplication::processEvents();
  f.window.bench().session.close();
  const auto tone = [&f]() -> const render::Tone& { return f.window.bench().session.place().tone; };

  f.window.bench().opener.open(f.path("night/lf.h5"));
  QTRY_COMPARE_WITH_TIMEOUT(tone().exposure, 2.5, kScenePatience);
  QCOMPARE(tone().gamma, 1.5);

  f.trigger("view.auto_tone");  // off again
  QTRY_VERIFY(tone().is_plain());
  QCoreApplication::processEvents();
  f.window.bench().session.close();
  f.window.bench().opener.open(f.path("night/lf.h5"));
  QTRY_VERIFY_WITH_TIMEOUT(f.messages()->text().contains("dark"), kScenePatience);
  QVERIFY(tone().is_plain());
}

void BrightnessTest::tone_changesNoSample() {
  Dark f;
  const QString before = find<ValueBar>(f.window).text();
  QVERIFY(before.contains("rgb"));
  const std::uint64_t hash = f.window.bench().session.light_field()->sample_hash();

  f.trigger("view.auto_tone");
  QTRY_VERIFY(!f.window.bench().session.place().tone.is_plain());
  QCoreApplication::processEvents();

  QCOMPARE(find<ValueBar>(f.window).text(), before);
  QCOMPARE(f.window.bench().session.light_field()->sample_hash(), hash);
}

}  // namespace episcope::in_brightness_test

EPISCOPE_WINDOW_TEST(brightness_test, BrightnessTest)
#include "brightness_test.moc"
