#include "tests/support/support.h"

#include <QFile>
#include <cstdio>
#include <cstdlib>

namespace tidemark::test {

QByteArray bytes_of(const std::filesystem::path& file) {
  QFile opened(QString::fromStdString(file.string()));
  return opened.open(QIODevice::ReadOnly) ? opened.readAll() : QByteArray();
}

std::filesystem::path studies_folder() {
  const char* chosen = std::getenv("TIDEMARK_STUDIES");
  return chosen != nullptr ? chosen : TIDEMARK_DEFAULT_STUDIES;
}

int require_studies() {
  if (std::filesystem::is_directory(studies_folder())) return 0;
  std::fprintf(stderr,
               "\n*** REAL STUDIES ARE MISSING: %s is not a folder. Nothing was tested. ***\n"
               "*** Set TIDEMARK_STUDIES to the folder that holds them. ***\n\n",
               studies_folder().c_str());
  // Continuous integration has them: where they are missing it would test less without anybody seeing it.
  return std::getenv("CI") != nullptr ? 1 : 77;
}

}  // namespace tidemark::test
