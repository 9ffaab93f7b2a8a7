// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/dialogs.h"
#include "tests/window_test_main.h"

#include <QLabel>

#include <memory>

// Questions stay legible, whatever the names in them.

namespace episcope::in_question_box_test {

class QuestionBoxTest : public QObject {
  Q_OBJECT

 private slots:
  void longPath_isBroken_notCut();
  void namesAreNoMarkup();
  void manyNames_areCounted();
};

void QuestionBoxTest::longPath_isBroken_notCut() {
  QWidget window;
  window.resize(1280, 800);
  window.show();
  const QString path = "/data/" + QString(120, 'a') + '/' + QString(120, 'b') + "/lf.h5";
  auto* box = new_question_box(
      &window, {.name = "box", .title = "Title", .text = "Where is " + path + " now?"});

  box->show();
  QVERIFY(QTest::qWaitForWindowExposed(box));

  constexpr int kWide = 640;
  QVERIFY2(box->width() < kWide, qPrintable(QString::number(box->width())));
  const auto* label = box->findChild<QLabel*>("qt_msgbox_label");
  QVERIFY(label->height() >= label->heightForWidth(label->width()));
  QVERIFY(box->text().remove(QChar(0x200b)).contains(path));
}

void QuestionBoxTest::namesAreNoMarkup() {
  QWidget window;

  const std::unique_ptr<QMessageBox> box(
      new_question_box(&window, {.name = "box", .title = "Title", .text = "<b>x</b> is lost."}));

  QCOMPARE(box->textFormat(), Qt::PlainText);
}

void QuestionBoxTest::manyNames_areCounted() {
  QStringList names;
  for (int i = 1; i <= 6; ++i) names << QString("r%1").arg(i);
  QCOMPARE(listed(names), "r1, r2, r3, r4, r5, r6");

  names << "r7";

  QCOMPARE(listed(names), "r1, r2, r3, r4, r5 and 2 more");
}

}  // namespace episcope::in_question_box_test

EPISCOPE_WINDOW_TEST(question_box_test, QuestionBoxTest)
#include "question_box_test.moc"
