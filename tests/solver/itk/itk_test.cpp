// Our steady states against ITK's, from the same image, start, T, epsilon and alpha.
#include <itkConnectedThresholdImageFilter.h>

#include <cmath>
#include <optional>

#include "bench/peers/itk_filters.h"
#include "imaging/phantom/phantom.h"
#include "solver/executor.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::itk_test {
namespace {

using bench::ItkImage;
using bench::Problem;
using test::failure;

constexpr std::int64_t kMostSteps = 3000;

// phi of our run until it stops by itself.
Result<solver::Field> our_steady_state(const Problem& problem, double alpha) {
  solver::Parameters parameters = problem.parameters;
  parameters.alpha = alpha;
  auto executor = solver::make_executor(solver::ExecutorKind::host, problem.source, parameters);
  if (!executor) return pass_on(executor);
  TIDEMARK_TRY((*executor)->paint(*problem.seed, solver::Brush::add));
  auto run = (*executor)->advance({.steps = kMostSteps, .until_converged = true});
  if (!run) return pass_on(run);
  if (!run->converged) return fail(ErrorKind::internal, "not converged after {} steps", run->steps);
  TIDEMARK_TRY((*executor)->validate());
  return (*executor)->snapshot().value();
}

// phi of ITK's threshold filter, when what is left moves by less than 0.005 voxel a step; < 0 inside.
ItkImage::Pointer itk_steady_state(const Problem& problem) {
  const auto filter = bench::make_threshold_filter(problem);
  filter->SetMaximumRMSError(0.005);
  filter->SetNumberOfIterations(static_cast<itk::IdentifierType>(kMostSteps));
  filter->Update();
  return filter->GetOutput();
}

// The mean distance, in voxels, of ITK's surface from ours: where ITK's phi changes sign between neighbours,
// ours, which is a distance near its surface, is read at that point.
double mean_surface_distance(const ItkImage& itk_phi, const solver::Field& ours) {
  const std::vector<float> phi = ours.dense();
  const float* peer = itk_phi.GetBufferPointer();
  const Geometry& geometry = ours.geometry;
  double sum = 0.0;
  std::int64_t points = 0;
  for (std::int64_t k = 0; k < geometry.size.z; ++k) {
    for (std::int64_t j = 0; j < geometry.size.y; ++j) {
      for (std::int64_t i = 0; i < geometry.size.x; ++i) {
        const Index3 voxel(i, j, k);
        for (int axis = 0; axis < 3; ++axis) {
          Index3 neighbour = voxel;
          ++neighbour[axis];
          if (!geometry.contains(neighbour)) continue;
          const auto a = static_cast<std::size_t>(geometry.offset(voxel));
          const auto b = static_cast<std::size_t>(geometry.offset(neighbour));
          if ((peer[a] < 0.0F) == (peer[b] < 0.0F)) continue;
          const double t = static_cast<double>(peer[a]) / static_cast<double>(peer[a] - peer[b]);
          sum += std::abs((1.0 - t) * static_cast<double>(phi[a]) + t * static_cast<double>(phi[b]));
          ++points;
        }
      }
    }
  }
  return points == 0 ? HUGE_VAL : sum / static_cast<double>(points);
}

// The voxels with T - epsilon <= value <= T + epsilon that are connected to the seed, as ITK finds them.
Mask itk_flood_fill(const Problem& problem) {
  auto filter = itk::ConnectedThresholdImageFilter<ItkImage, itk::Image<std::uint8_t, 3>>::New();
  const auto image = bench::wrap(problem.source->geometry, problem.values);
  filter->SetInput(image);
  const Index3 seed(glm::round(problem.source->geometry.to_voxel(problem.seed->centre_mm)));
  filter->SetSeed({{seed.x, seed.y, seed.z}});
  filter->SetLower(static_cast<float>(problem.parameters.target - problem.parameters.range));
  filter->SetUpper(static_cast<float>(problem.parameters.target + problem.parameters.range));
  filter->SetReplaceValue(1);
  filter->Update();
  const std::uint8_t* voxels = filter->GetOutput()->GetBufferPointer();
  const auto count = static_cast<std::size_t>(problem.source->geometry.voxel_count());
  return {problem.source->geometry, std::vector<std::uint8_t>(voxels, voxels + count)};
}

// How much of the balls on either side of the bridge's middle is inside.
struct Halves {
  double seeded = 0.0;
  double other = 0.0;
};

Halves covered_halves(const Mask& result, const Problem& problem) {
  constexpr double kBallVoxels = 4.0 / 3.0 * 3.14159265358979 * 20.0 * 20.0 * 20.0;
  const Geometry& geometry = result.geometry;
  const bool seed_is_low =
      geometry.to_voxel(problem.seed->centre_mm).x < static_cast<double>(geometry.size.x) / 2;
  Halves halves;
  for (std::int64_t offset = 0; offset < geometry.voxel_count(); ++offset) {
    if (result.voxels[static_cast<std::size_t>(offset)] == 0) continue;
    const bool low = offset % geometry.size.x < geometry.size.x / 2;
    (low == seed_is_low ? halves.seeded : halves.other) += 1.0 / kBallVoxels;
  }
  return halves;
}

}  // namespace

class ItkTest : public QObject {
  Q_OBJECT

 private slots:
  void our_steady_state_is_that_of_itks_threshold_level_set_data() {
    QTest::addColumn<QString>("kind");
    for (const char* kind : {"sphere", "dumbbell", "bridge", "tumour"}) QTest::newRow(kind) << QString(kind);
  }

  void our_steady_state_is_that_of_itks_threshold_level_set() {
    QFETCH(QString, kind);
    const auto problem = bench::make_problem(kind.toStdString());
    QCOMPARE(failure(problem), QString());
    const auto ours = our_steady_state(*problem, problem->parameters.alpha);
    QCOMPARE(failure(ours), QString());
    const auto itk_phi = itk_steady_state(*problem);
    const double overlap = dice(ours->mask(), bench::inside(*itk_phi, problem->source->geometry));
    const double distance = mean_surface_distance(*itk_phi, *ours);
    qInfo("Dice %.4f, mean surface distance %.3f voxel", overlap, distance);
    QVERIFY(overlap >= 0.98);
    QVERIFY(distance < 0.25);
  }

  void with_data_alone_a_noiseless_region_is_what_a_flood_fill_finds_data() {
    QTest::addColumn<QString>("kind");
    for (const char* kind : {"sphere", "dumbbell", "tumour"}) QTest::newRow(kind) << QString(kind);
  }

  void with_data_alone_a_noiseless_region_is_what_a_flood_fill_finds() {
    QFETCH(QString, kind);
    imaging::PhantomOptions noiseless;
    noiseless.noise_percent = 0.0;
    const auto problem = bench::make_problem(kind.toStdString(), noiseless);
    QCOMPARE(failure(problem), QString());
    const auto ours = our_steady_state(*problem, 1.0);
    QCOMPARE(failure(ours), QString());
    const double overlap = dice(ours->mask(), itk_flood_fill(*problem));
    qInfo("Dice %.4f", overlap);
    QVERIFY(overlap >= 0.99);
  }

  void across_a_noisy_bridge_data_alone_leaks_and_the_stated_alpha_does_not() {
    const auto problem = bench::make_problem("bridge");
    QCOMPARE(failure(problem), QString());
    const Halves flooded = covered_halves(itk_flood_fill(*problem), *problem);
    QVERIFY(flooded.other > 0.5);  // a flood fill leaks

    const auto leaking = our_steady_state(*problem, 1.0);
    QCOMPARE(failure(leaking), QString());
    const Halves both = covered_halves(leaking->mask(), *problem);
    const auto kept = our_steady_state(*problem, problem->parameters.alpha);
    QCOMPARE(failure(kept), QString());
    const Halves one = covered_halves(kept->mask(), *problem);
    qInfo("alpha 1: %.3f and %.3f of the balls; alpha %.1f: %.3f and %.3f", both.seeded, both.other,
          problem->parameters.alpha, one.seeded, one.other);
    QVERIFY(both.other > 0.9);
    QVERIFY(one.seeded > 0.95);
    QVERIFY(one.other < 0.01);
  }
};

TIDEMARK_TEST(ItkTest)

}  // namespace tidemark::test::itk_test

#include "itk_test.moc"
