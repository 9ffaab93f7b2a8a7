// SPDX-License-Identifier: BSD-3-Clause
// The window that ships, painted in with the mouse until it is killed. After each stroke it says
// how many steps the document has and what it looks like.
// Usage: paint_in_a_window_until_killed <folder of journals> <light field> <folder of settings>
#include "app/gui/annotate/annotate_controller.h"
#include "app/gui/files/autosave.h"
#include "app/gui/main_window.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/shell/commands.h"
#include "app/session/session.h"
#include "tests/app/gui/annotate/document_digest.h"
#include "tests/app/gui/paint_stroke.h"
#include "tests/patience.h"

#include <QAction>
#include <QApplication>
#include <QSettings>
#include <QTest>

#include <cstdio>

using namespace episcope;

namespace {

void paint(MainWindow& window, int number) {
  if (number % 7 == 0) window.bench().commands.find("annotate.add_label")->trigger();
  if (number % 5 == 0) {
    window.bench().session.set_view({number % 9, number % 4});
    QCoreApplication::processEvents();
  }
  paint_stroke(window, number, number % 4 == 3 ? Qt::RightButton : Qt::LeftButton);
}

}  // namespace

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  if (argc != 4) return 2;
  QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, argv[3]);
  MainWindow window;
  window.bench().document.setJournalFolder(argv[1]);
  window.findChild<Autosave*>()->setRoot({});
  window.show();
  window.bench().opener.open(argv[2]);
  if (!QTest::qWaitFor([&] { return window.bench().document.document(); }, kPatience)) return 3;
  window.findChild<AnnotateController*>()->setAnnotating(true);
  for (int number = 0;; ++number) {
    paint(window, number);
    QCoreApplication::processEvents();
    const AnnotationDocument& document = *window.bench().document.document();
    std::printf("%zu %s\n", document.history().applied_count(), digest_of(document).constData());
    std::fflush(stdout);
  }
}
