// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/user_folders.h"

#include "app/session/project_file.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

namespace episcope::in_file_name_test {

class FileNameTest : public QObject {
  Q_OBJECT

 private slots:
  void separators_areReplaced() {
    QCOMPARE(file_name_of("a/b\\c: \"d\"?"), std::string("a_b_c_ _d__"));
  }

  void longNames_endBehindACharacter() {
    const std::string name = std::string(79, 'a') + "ü";

    QCOMPARE(file_name_of(name), std::string(79, 'a'));
    QCOMPARE(file_name_of("x" + name), "x" + std::string(79, 'a'));
    QCOMPARE(file_name_of(std::string(78, 'a') + "ü and more"), std::string(78, 'a') + "ü");
  }

  void namesOfOtherEncodings_becomeAscii() {
    QCOMPARE(file_name_of("gr\xfcn"), std::string("gr_n"));
    QCOMPARE(file_name_of("cut \xe2\x82"), std::string("cut __"));
    QCOMPARE(file_name_of("“grün” 光"), std::string("“grün” 光"));
  }

  // A light field in a folder of such a name keeps no project from being saved.
  void projects_areWrittenWithAnyName() {
    const QTemporaryDir folder;
    const std::filesystem::path path = folder.filePath("work.episcope").toStdString();
    ProjectScene scene;
    scene.name = "gr\xfcn";
    scene.input = (path.parent_path() / "gr\xfcn" / "lf.h5").string();

    Project project;
    project.scenes = {scene};
    write_project(path, project);

    QCOMPARE(read_project(path).scenes.size(), 1U);
  }
};

}  // namespace episcope::in_file_name_test

EPISCOPE_CORE_TEST(file_name_test, FileNameTest)
#include "file_name_test.moc"
