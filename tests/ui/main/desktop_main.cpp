// main() of test programs that drive the desktop: Qt as the program itself sets it up.
#include <QStandardPaths>

#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"

int main(int argc, char** argv) {
  QCoreApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
  QCoreApplication::setOrganizationName("tidemark-test");
  QCoreApplication::setApplicationName("tidemark-test");
  QStandardPaths::setTestModeEnabled(true);
  const tidemark::test::WatchedApplication application(argc, argv);
  return tidemark::test::run_named_test(argc, argv);
}
