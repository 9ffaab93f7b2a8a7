// SPDX-License-Identifier: BSD-3-Clause
#include "tests/app/gui/window_fixture.h"

#include "app/gui/annotate/segment_controller.h"
#include "app/gui/files/autosave.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/jobs.h"
#include "engine/io/formats/write_scene.h"
#include "widgets/canvas/view_canvas.h"

#include <QAbstractButton>
#include <QAction>
#include <QDir>
#include <QSettings>
#include <QTest>

#include <map>
#include <utility>

namespace episcope {
namespace {

// Each scene is rendered once for all tests of the process.
const Scene& rendered(const std::string& id, const scenes::RenderOptions& options) {
  static std::map<std::pair<std::string, int>, Scene> scenes;
  const auto [place, is_new] = scenes.try_emplace({id, options.width});
  if (is_new) place->second = scenes::render_builtin(id, options, Progress());
  return place->second;
}

}  // namespace

WindowFixture::WindowFixture() {
  QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, folder_.filePath("settings"));
  QSettings().clear();
  window.bench().opener.setCacheFolder({});
  window.bench().document.setJournalFolder(folder_.filePath("journals").toStdString());
  find<Autosave>(window).setRoot(folder_.filePath("sessions").toStdString());
  window.resize(1280, 800);
  window.show();
}

scenes::RenderOptions WindowFixture::smallOptions() {
  scenes::RenderOptions options;
  options.height = options.width = 96;
  return options;
}

QString WindowFixture::writeScene(const std::string& id,
                                  const scenes::RenderOptions& options) const {
  const QString scene_folder = folder_.filePath(QString::fromStdString(id));
  QDir().mkpath(scene_folder);
  const QString file = scene_folder + "/lf.h5";
  io::write_archive(file.toStdString(), rendered(id, options), Progress());
  return file;
}

void WindowFixture::openScene(const std::string& id, const scenes::RenderOptions& options) {
  const auto before = window.bench().session.scene();
  window.bench().opener.open(writeScene(id, options));
  QTRY_VERIFY_WITH_TIMEOUT(window.bench().session.scene() != before, kScenePatience);
  QCoreApplication::processEvents();  // the session tells the window of its scene one turn later
}

void WindowFixture::openSmall(const std::string& id) {
  openScene(id, smallOptions());
  QTRY_COMPARE_WITH_TIMEOUT(window.bench().viewer_area.canvas()->picture().size(), QSize(96, 96),
                            kPatience);
}

void WindowFixture::runAndWait() {
  const std::size_t before = window.bench().session.estimates().size();
  auto* run = window.findChild<QAbstractButton*>("method.run");
  QVERIFY(run);
  QTRY_VERIFY_WITH_TIMEOUT(run->isEnabled(), kPatience);
  QTest::mouseClick(run, Qt::LeftButton);
  QTRY_COMPARE_WITH_TIMEOUT(window.bench().session.estimates().size(), before + 1, kScenePatience);
  QCoreApplication::processEvents();  // the session tells the window of it one turn later
}

bool WindowFixture::isSegmented() {
  const LiveLabeler& labeler = find<SegmentController>(window).labeler();
  const LabelingPtr labeling = labeler.labeling(view());
  return labeling && !labeling->is_draft && labeler.is_up_to_date(view()) &&
         !labeler.is_running() && window.bench().jobs.count() == 0;
}

void WindowFixture::trigger(const char* id) {
  QAction* action = window.bench().commands.find(id);
  QVERIFY2(action && action->isEnabled(), id);
  action->trigger();
}

void WindowFixture::key(Qt::Key key, Qt::KeyboardModifiers modifiers) {
  window.activateWindow();  // shortcuts are heard in the active window only
  QVERIFY(QTest::qWaitForWindowActive(&window));
  canvas()->setFocus();
  QTest::keyClick(canvas(), key, modifiers);
}

QPoint WindowFixture::at(PixelIndex pixel) const {
  return canvas()->positionOf(pixel).toPoint();
}

void WindowFixture::press(PixelIndex pixel, Qt::MouseButton button,
                          Qt::KeyboardModifiers modifiers) {
  QTest::mouseMove(canvas(), at(pixel));
  QTest::mousePress(canvas(), button, modifiers, at(pixel));
}

void WindowFixture::move(PixelIndex pixel) {
  QTest::mouseMove(canvas(), at(pixel));
}

void WindowFixture::release(PixelIndex pixel, Qt::MouseButton button) {
  QTest::mouseRelease(canvas(), button, {}, at(pixel));
}

void WindowFixture::drag(PixelIndex from, PixelIndex to, Qt::MouseButton button,
                         Qt::KeyboardModifiers modifiers) {
  press(from, button, modifiers);
  move(to);
  release(to, button);
}

void WindowFixture::click(const QString& object_name) {
  auto* control = window.findChild<QWidget*>(object_name);
  QVERIFY2(control && control->isEnabled() && control->isVisible(), qPrintable(object_name));
  QTest::mouseClick(control, Qt::LeftButton);
}

}  // namespace episcope
