// Helpers that many tests use.
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

// The exit code of a test that needs the studies: 0 where they are, else ctest's "skipped" (77), loudly, or
// under continuous integration ($CI) a failure.
int require_studies();

// "" on success, else the error: QCOMPARE(failure(result), QString()) shows the reason.
template <class T>
QString failure(const Result<T>& result) {
  return result ? QString() : QString::fromStdString(result.error().message);
}

}  // namespace tidemark::test
