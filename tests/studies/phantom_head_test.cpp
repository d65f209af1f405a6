// T13 of the numerics: the white matter of the phantom head, with the phantom's own parameters.
#include "imaging/phantom/phantom.h"
#include "solver/executor.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::phantom_head_test {

class PhantomHeadTest : public QObject {
  Q_OBJECT

 private slots:
  void white_matter_is_found_at_any_noise() {
    for (const double noise : {0.0, 3.0, 9.0}) {
      double lowest = 1.0;
      double highest = 0.0;
      for (const std::uint64_t random_seed : {1, 2}) {
        imaging::PhantomOptions options;
        options.noise_percent = noise;
        options.random_seed = random_seed;
        auto head = imaging::make_phantom("head", options);
        QCOMPARE(failure(head), QString());
        QVERIFY(head->seed.has_value());
        solver::Parameters parameters;
        parameters.target = head->target;
        parameters.range = head->range;
        parameters.alpha = head->alpha;
        const auto source = std::make_shared<const Volume>(std::move(head->volume));
        auto level_set = solver::make_executor(solver::ExecutorKind::host, source, parameters);
        QCOMPARE(failure(level_set), QString());
        const auto& [i, j, k, radius_mm] = *head->seed;
        QVERIFY(
            (*level_set)
                ->paint(solver::sphere_at_voxel(source->geometry, {i, j, k}, radius_mm), solver::Brush::add));
        solver::Advance run;
        run.steps = 5000;
        run.until_converged = true;
        const auto report = (*level_set)->advance(run);
        QCOMPARE(failure(report), QString());
        QCOMPARE(failure((*level_set)->validate()), QString());
        const double overlap = dice((*level_set)->snapshot().value().mask(), head->truth);
        qInfo("T13: noise %.0f %%, random seed %d: Dice %.4f after %lld steps in %.2f s", noise,
              static_cast<int>(random_seed), overlap, static_cast<long long>(report->steps), report->seconds);
        QVERIFY(overlap >= 0.93);
        lowest = std::min(lowest, overlap);
        highest = std::max(highest, overlap);
        if (noise == 0.0) break;  // the random seed makes the noise alone
      }
      QVERIFY(lowest > highest - 1e-3);
    }
  }
};

TIDEMARK_TEST(PhantomHeadTest)

}  // namespace tidemark::test::phantom_head_test

#include "phantom_head_test.moc"
