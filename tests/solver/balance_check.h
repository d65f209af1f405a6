// The test that the pushes at places on the surface are what the next step does to phi.
#pragma once

#include <QTest>
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "solver/balance.h"
#include "solver/executor.h"
#include "solver/surface_places.h"
#include "tests/support/support.h"

namespace tidemark::test {

inline solver::StepInputs inputs_of(const solver::Executor& level_set,
                                    const std::shared_ptr<const Volume>& source) {
  auto phi = level_set.snapshot();
  if (!phi) qFatal("%s", phi.error().message.c_str());
  return {std::make_shared<const solver::Field>(std::move(*phi)),
          source,
          level_set.parameters(),
          level_set.speed(),
          level_set.constraints(),
          level_set.time_step()};
}

// Computes one step, and compares what it did at 1,000 places on the surface with what their balances said.
// Pages must not rest. A sum of pushes may be off by 1 %, and by what phi as a float cannot hold.
inline void expect_balances_foretell_a_step(solver::Executor& level_set,
                                            const std::shared_ptr<const Volume>& source) {
  constexpr int kPlaces = 1000;
  constexpr double kShare = 0.01;
  constexpr double kRounding = 2e-6;
  constexpr double kMoves = 2e-4;  // changes below it say nothing about the share
  const solver::StepInputs inputs = inputs_of(level_set, source);
  const auto report = level_set.advance({.steps = 1});
  QCOMPARE(failure(report), QString());
  const solver::Field after = level_set.snapshot().value();

  auto places = solver::surface_places(*inputs.phi, std::nullopt, 1e-3);
  QVERIFY(places.size() >= kPlaces);
  std::shuffle(places.begin(), places.end(), std::mt19937(1));
  places.resize(kPlaces);
  double largest = 0.0;
  int moving = 0;
  for (const glm::dvec3& place : places) {
    const double foretold = inputs.time_step * solver::PlaceBalance(inputs, place).balance().pushes.sum();
    const double change = solver::phi_at(after, place) - solver::phi_at(*inputs.phi, place);
    const double error = std::abs(foretold - change);
    QVERIFY2(error <= kShare * std::abs(change) + kRounding,
             qPrintable(QStringLiteral("foretold %1, computed %2").arg(foretold).arg(change)));
    if (std::abs(change) < kMoves) continue;
    ++moving;
    largest = std::max(largest, error / std::abs(change));
  }
  qInfo("%s: largest error of a sum %.2g %%, of %d places that move by more than %g",
        std::string(level_set.name()).c_str(), 100.0 * largest, moving, kMoves);
  QVERIFY(moving > kPlaces / 4);
}

}  // namespace tidemark::test
