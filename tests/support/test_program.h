// A program of several test classes, each run by the name of its file.
#pragma once

#include <QTest>

#include "tests/support/support.h"

namespace tidemark::test {

using TestFunction = int (*)(int argc, char** argv);

// A test that its program knows by the stem of `file` from before main() on.
struct RegisteredTest {
  RegisteredTest(const char* file, TestFunction run);
};

// Runs the test that argv[1] names; it gets the arguments from there on. Returns its exit code, and 2, with
// the names of all tests, where there is none of that name.
int run_named_test(int argc, char** argv);

}  // namespace tidemark::test

// Adds a Qt Test class to its program.
#define TIDEMARK_TEST(Class)                                                              \
  static const tidemark::test::RegisteredTest kTest(__FILE__, [](int argc, char** argv) { \
    Class test;                                                                           \
    return QTest::qExec(&test, argc, argv);                                               \
  });

// The same for a class that works on the real studies.
#define TIDEMARK_STUDY_TEST(Class)                                                        \
  static const tidemark::test::RegisteredTest kTest(__FILE__, [](int argc, char** argv) { \
    if (const int code = tidemark::test::require_studies(); code != 0) return code;       \
    Class test;                                                                           \
    return QTest::qExec(&test, argc, argv);                                               \
  });
