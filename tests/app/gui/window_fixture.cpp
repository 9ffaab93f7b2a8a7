// SPDX-License-Identifier: BSD-3-Clause
#include "tests/app/gui/window_fixture.h"

#include "app/gui/open_controller.h"
#include "app/session/session.h"
#include "engine/io/write_scene.h"
#include "widgets/view_canvas.h"

#include <QAbstractButton>
#include <QDir>
#include <QSettings>
#include <QTest>

namespace episcope {

WindowFixture::WindowFixture() {
  QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, folder_.filePath("settings"));
  QSettings().clear();
  window.opener().setCacheFolder({});
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
  io::write_archive(file.toStdString(), scenes::render_builtin(id, options, Progress()),
                    Progress());
  return file;
}

void WindowFixture::openSmall(const std::string& id) {
  window.open(writeScene(id, smallOptions()));
  QTRY_VERIFY(window.session().scene() != nullptr);
  QTRY_COMPARE(window.panels().canvas->picture().size(), QSize(96, 96));
}

void WindowFixture::runAndWait() {
  const std::size_t before = window.session().estimates().size();
  auto* run = window.findChild<QAbstractButton*>("method.run");
  QVERIFY(run);
  QTest::mouseClick(run, Qt::LeftButton);
  QTRY_COMPARE_WITH_TIMEOUT(window.session().estimates().size(), before + 1, 60'000);
}

}  // namespace episcope
