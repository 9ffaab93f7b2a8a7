// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open/foreign_form.h"

#include "engine/core/error.h"
#include "engine/io/open/open.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <fstream>

namespace episcope::in_foreign_form_test {

namespace fs = std::filesystem;

class ForeignFormTest : public QObject {
  Q_OBJECT

 private slots:
  void refusal_saysWhatToDo_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("advice");
    QTest::newRow("ZIP") << "lf.zip"
                         << "unpack it";
    QTest::newRow("packed TAR") << "lf.tar.gz"
                                << "unpack it";
    QTest::newRow("Lytro") << "IMG_0001.LFP"
                           << "LFToolbox";
    QTest::newRow("tensor") << "lf.pt"
                            << ".npy";
    QTest::newRow("other") << "lf.doc"
                           << "an lf.h5, a scene folder";
  }
  void refusal_saysWhatToDo() {
    QFETCH(QString, name);
    QFETCH(QString, advice);
    const QTemporaryDir folder;
    const fs::path file = fs::path(folder.path().toStdString()) / name.toStdString();
    std::ofstream(file) << "something";

    try {
      (void)io::open_scene(file, {}, Progress(1));
      QFAIL("it was read");
    } catch (const IoError& error) {
      QVERIFY2(QString(error.what()).contains(advice), error.what());
    }
  }
};

}  // namespace episcope::in_foreign_form_test

EPISCOPE_TEST(foreign_form_test, ForeignFormTest)
#include "foreign_form_test.moc"
