// The executors, one a row of a test's data.
#pragma once

#include <QTest>

#include "solver/executor.h"

namespace tidemark::test {

// On OpenGL each test makes its own context.
inline void add_executors() {
  QTest::addColumn<int>("kind");
  QTest::newRow("host") << int(solver::ExecutorKind::host);
  QTest::newRow("compute") << int(solver::ExecutorKind::compute);
  QTest::newRow("stream") << int(solver::ExecutorKind::stream);
}

inline solver::ExecutorKind this_executor() {
  QFETCH(int, kind);
  return static_cast<solver::ExecutorKind>(kind);
}

}  // namespace tidemark::test
