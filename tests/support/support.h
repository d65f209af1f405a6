// What many tests need.
#pragma once

#include <QTemporaryDir>
#include <QTest>
#include <filesystem>
#include <string>

#include "core/result.h"

namespace tidemark::test {

// A folder that goes away with the object.
class TemporaryFolder {
 public:
  [[nodiscard]] std::filesystem::path path() const { return folder_.path().toStdString(); }
  std::filesystem::path operator/(const std::string& name) const { return path() / name; }

 private:
  QTemporaryDir folder_;
};

// The folder of real studies: $TIDEMARK_STUDIES, else ../shared/data beside the checkout.
std::filesystem::path studies_folder();

// Ends the program with ctest's "skipped" code (77), loudly, when the studies are not there.
int require_studies();

// "" on success, else the error: QCOMPARE(failure(result), QString()) shows the reason.
template <class T>
QString failure(const Result<T>& result) {
  return result ? QString() : QString::fromStdString(result.error().message);
}

}  // namespace tidemark::test

// main() of a test that works on the real studies.
#define TIDEMARK_STUDY_TEST_MAIN(Class)                                             \
  int main(int argc, char** argv) {                                                 \
    if (const int code = tidemark::test::require_studies(); code != 0) return code; \
    Class test;                                                                     \
    return QTest::qExec(&test, argc, argv);                                         \
  }
