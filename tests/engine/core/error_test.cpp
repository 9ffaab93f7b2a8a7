// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "tests/test_main.h"

#include <new>

namespace episcope::in_error_test {

class ErrorTest : public QObject {
  Q_OBJECT

 private slots:
  void sentence_isTheMessageWithoutThePath() {
    const IoError error("a: b/c.h5", "it is damaged: twice");

    QCOMPARE(error.sentence(), std::string("it is damaged: twice"));
    QCOMPARE(std::string(error.what()), std::string("a: b/c.h5: it is damaged: twice"));
  }

  void failureText_saysWhatHappened() {
    QCOMPARE(failure_text(std::make_exception_ptr(std::bad_alloc())),
             std::string(kNotEnoughMemory));
    QCOMPARE(failure_text(std::make_exception_ptr(InvalidInput("no views"))),
             std::string("no views"));
    QVERIFY(!failure_text(std::make_exception_ptr(1)).empty());
  }
};

}  // namespace episcope::in_error_test

EPISCOPE_TEST(error_test, ErrorTest)
#include "error_test.moc"
