// main() of test programs that open windows.
#include <QApplication>

#include "tests/support/test_program.h"

int main(int argc, char** argv) {
  // Sizes in tests are those of one resolution.
  QCoreApplication::setAttribute(Qt::AA_Use96Dpi);
  const QApplication application(argc, argv);
  return tidemark::test::run_named_test(argc, argv);
}
