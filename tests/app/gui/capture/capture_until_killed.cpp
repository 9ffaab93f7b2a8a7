// SPDX-License-Identifier: BSD-3-Clause
// The window that ships, in whose Capture tab a lens and a mesh are opened and one pair after the
// other is added until it is killed. After each pair that is kept it tells how many there are.
// Usage: capture_until_killed <state folder> <light field> <lens> <mesh>
#include "app/gui/capture/capture_controller.h"
#include "app/gui/capture/photographs.h"
#include "app/gui/files/autosave.h"
#include "app/gui/main_window.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/shell/frame.h"
#include "app/session/session.h"
#include "tests/patience.h"

#include <QApplication>
#include <QComboBox>
#include <QFile>
#include <QLineEdit>
#include <QSettings>
#include <QTest>

#include <cstdio>
#include <filesystem>

using namespace episcope;

namespace {

void add_pair(CaptureController& capture, const QString& file, int number) {
  QFile csv(file);
  if (!csv.open(QIODevice::WriteOnly)) return;
  csv.write(QString(",%1,2,%1,4,5\n").arg(number).toUtf8());
  csv.close();
  capture.importPairs(file);
}

bool prepare(MainWindow& window, char** argv) {
  window.bench().opener.open(argv[2]);
  const bool is_open =
      QTest::qWaitFor([&] { return window.bench().session.scene() != nullptr; }, kPatience);
  auto& capture = *window.findChild<CaptureController*>();
  window.bench().frame.showTab("capture");
  capture.photographs().openCamera(argv[3]);
  capture.openMesh(argv[4]);
  const bool has_mesh = QTest::qWaitFor([&] { return !capture.work().objects.empty(); }, kPatience);
  auto* name = window.findChild<QComboBox*>("capture.objects")->lineEdit();
  name->selectAll();
  QTest::keyClicks(name, "found again");
  QTest::keyClick(name, Qt::Key_Return);
  return is_open && has_mesh;
}

}  // namespace

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  if (argc != 5) return 2;
  const std::filesystem::path state = argv[1];
  QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, (state / "settings").c_str());
  MainWindow window;
  window.bench().document.setJournalFolder(state / "journals");
  auto* autosave = window.findChild<Autosave*>();
  autosave->setRoot(state / "sessions");
  window.show();
  if (!prepare(window, argv)) return 3;
  for (int number = 1;; ++number) {
    add_pair(*window.findChild<CaptureController*>(),
             QString::fromStdString((state / "pair.csv").string()), number);
    QCoreApplication::processEvents();  // changes are told of then
    if (!QTest::qWaitFor([&] { return autosave->isIdle(); }, kPatience)) return 3;
    std::printf("%d\n", number);
    std::fflush(stdout);
  }
}
