// The test that one run by host, compute and stream ends with the same mask.
#pragma once

#include <QTest>
#include <functional>
#include <memory>
#include <optional>

#include "solver/executor.h"
#include "tests/support/support.h"

namespace tidemark::test {

inline void expect_same_mask(const std::shared_ptr<const Volume>& source,
                             const solver::Parameters& parameters,
                             const std::function<Status(solver::Executor&)>& start, std::int64_t steps) {
  std::optional<Mask> expected;
  for (const solver::ExecutorKind kind :
       {solver::ExecutorKind::host, solver::ExecutorKind::compute, solver::ExecutorKind::stream}) {
    solver::ExecutorOptions options;
    options.debug = true;
    auto level_set = solver::make_executor(kind, source, parameters, options);
    QCOMPARE(failure(level_set), QString());
    QCOMPARE(failure(start(**level_set)), QString());
    const auto report = (*level_set)->advance({.steps = steps});
    QCOMPARE(failure(report), QString());
    QCOMPARE(report->steps, steps);
    QCOMPARE(failure((*level_set)->validate()), QString());
    const Mask mask = (*level_set)->snapshot().value().mask();
    qInfo("%s: %lld voxels inside, %.0f steps/s, %.1f M voxel updates/s",
          std::string((*level_set)->name()).c_str(), static_cast<long long>(mask.count()),
          static_cast<double>(report->steps) / report->seconds,
          static_cast<double>(report->voxel_updates) / report->seconds / 1e6);
    if (!expected) expected = mask;
    QVERIFY(mask.count() > 1000);
    QVERIFY(dice(mask, *expected) >= 0.999);
  }
}

}  // namespace tidemark::test
