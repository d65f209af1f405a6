// main() of test programs that open no window.
#include <QCoreApplication>

#include "tests/support/test_program.h"

int main(int argc, char** argv) {
  const QCoreApplication application(argc, argv);
  return tidemark::test::run_named_test(argc, argv);
}
