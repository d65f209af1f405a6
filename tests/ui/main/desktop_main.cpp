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
  // The number of failures.
  const int code = tidemark::test::run_named_test(argc, argv);
  if (code == 0 || code > application.failed_stories()) return code;
  // A virtual machine's processor is lent to others, whose time counts as the event's. What holds the user
  // interface does it again.
  qInfo("Events were long, so that all stories are told once more:");
  return tidemark::test::run_named_test(argc, argv);
}
