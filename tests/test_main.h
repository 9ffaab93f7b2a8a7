// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QTest>

/// Ends a source of tests: the function `name`, called by the main function of the suite
/// (episcope_add_tests), runs all test functions of the class. Sources of a suite are compiled
/// together, so each has a namespace of its own: episcope::in_<name>. EPISCOPE_CORE_TEST makes a
/// QCoreApplication first, EPISCOPE_WINDOW_TEST (tests/window_test_main.h) a QApplication.
#define EPISCOPE_TEST(name, Class)          \
  int name(int argc, char** argv) {         \
    episcope::in_##name::Class test;        \
    return QTest::qExec(&test, argc, argv); \
  }

#define EPISCOPE_CORE_TEST(name, Class)             \
  int name(int argc, char** argv) {                 \
    const QCoreApplication application(argc, argv); \
    episcope::in_##name::Class test;                \
    return QTest::qExec(&test, argc, argv);         \
  }
