// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/test_main.h"

#include <QApplication>

/// As EPISCOPE_TEST, with a QApplication.
#define EPISCOPE_WINDOW_TEST(name, Class)       \
  int name(int argc, char** argv) {             \
    const QApplication application(argc, argv); \
    episcope::in_##name::Class test;            \
    return QTest::qExec(&test, argc, argv);     \
  }
