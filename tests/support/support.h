// Helpers that many tests use.
#pragma once

#include <QByteArray>
#include <QTemporaryDir>
#include <QTest>
#include <filesystem>
#include <optional>
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

// Of a whole file; empty where it cannot be read.
QByteArray bytes_of(const std::filesystem::path& file);

// Sets a variable of the environment as long as it lives.
class Variable {
 public:
  Variable(const char* name, const QByteArray& value) : name_(name) {
    if (qEnvironmentVariableIsSet(name)) before_ = qgetenv(name);
    qputenv(name, value);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  ~Variable() {
    if (before_) {
      qputenv(name_, *before_);
    } else {
      qunsetenv(name_);
    }
  }

 private:
  const char* name_;
  std::optional<QByteArray> before_;
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
