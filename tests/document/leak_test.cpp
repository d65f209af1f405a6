// Leaks that are found, in time, and bodies where there are none.
#include "document/leak.h"

#include "core/index_walk.h"
#include "imaging/phantom/phantom.h"
#include "solver/executor.h"
#include "tests/document/lobes.h"
#include "tests/support/test_program.h"

namespace tidemark::test::leak_test {

namespace {

constexpr std::int64_t kSteps = 8;    // between two looks
constexpr std::int64_t kMost = 2000;  // more than any of them needs to come to rest
constexpr std::int64_t kInTime = 15;  // steps after the front has grown behind the neck
constexpr unsigned kPhantoms = 20;

struct Watched {
  std::optional<document::Leak> leak;
  std::int64_t step = 0;       // of the leak, or at rest
  std::int64_t leaked_at = 0;  // when the front had grown behind the neck; 0: never
  Mask before;                 // what was inside at the last look before the neck was passed
};

std::unique_ptr<solver::Executor> executor_of(const Lobes& lobes, solver::ExecutorKind kind) {
  auto made = solver::make_executor(kind, lobes.volume, lobes.parameters);
  if (!made) qFatal("%s", made.error().message.c_str());
  if (!(*made)->paint(lobes.seed, solver::Brush::add)) qFatal("no seed");
  return std::move(*made);
}

// Half a ball of twice the neck's radius lies behind it.
bool has_leaked(const Lobes& lobes, const Mask& mask) {
  std::int64_t behind = 0;
  for (std::int64_t offset = 0; offset < mask.geometry.voxel_count(); ++offset) {
    if (mask.voxels[static_cast<std::size_t>(offset)] != 0 && lobes.behind(mask.geometry.voxel_at(offset)))
      ++behind;
  }
  return static_cast<double>(behind) >= 2.0 / 3.0 * M_PI * std::pow(2.0 * lobes.neck_mm, 3.0);
}

// Until a leak is found, and on to where there is one for certain if none was.
Watched watch(const Lobes& lobes, solver::ExecutorKind kind = solver::ExecutorKind::host) {
  const auto executor = executor_of(lobes, kind);
  solver::FrontPatches patches(lobes.volume->geometry);
  document::LeakFinder finder;
  if (!patches.restart(*executor)) qFatal("no look");
  Watched watched;
  std::vector<Mask> masks{executor->snapshot()->mask()};
  bool rests = false;
  while (!rests && watched.step < kMost) {
    const auto report = executor->advance({.steps = kSteps, .until_converged = true});
    if (!report || !patches.look(*executor)) qFatal("no steps");
    rests = report->converged;
    watched.step += report->steps;
    masks.push_back(executor->snapshot()->mask());
    if (lobes.behind && watched.leaked_at == 0 && has_leaked(lobes, masks.back())) {
      watched.leaked_at = watched.step;
    }
    watched.leak = finder.find(patches, {});
    if (watched.leak) break;
  }
  if (watched.leak) watched.before = masks[static_cast<std::size_t>(watched.leak->passed) - 1];
  return watched;
}

// Whether the surface grows behind the neck later on, from where it is now.
bool leaks_in_the_end(const Lobes& lobes) {
  const auto executor = executor_of(lobes, solver::ExecutorKind::host);
  if (!executor->advance({.steps = kMost, .until_converged = true})) qFatal("no steps");
  return has_leaked(lobes, executor->snapshot()->mask());
}

struct Block {
  Index3 first{0};
  Index3 last{0};  // inside, too
};

// Of a surface that holds the first block at the first look, and one more with each look after it.
std::optional<document::Leak> leak_among(const std::vector<Block>& blocks) {
  auto volume = std::make_shared<Volume>();
  volume->geometry.size = Index3(48, 32, 16);
  const auto count = static_cast<std::size_t>(volume->geometry.voxel_count());
  volume->voxels = std::vector<std::int16_t>(count, 100);
  const auto executor = solver::make_executor(solver::ExecutorKind::host, volume, {});
  if (!executor) qFatal("%s", executor.error().message.c_str());
  std::vector<float> phi(count, -0.5F);
  solver::FrontPatches patches(volume->geometry);
  for (const Block& block : blocks) {
    for_each_index(block.first, block.last + Index3(1), [&](Index3 voxel) {
      phi[static_cast<std::size_t>(volume->geometry.offset(voxel))] = 0.5F;
    });
    const double band = (*executor)->band();
    if (!(*executor)->restore(solver::Field::from_dense(volume->geometry, phi, band))) qFatal("no phi");
    const bool first = &block == &blocks.front();
    if (first ? !patches.restart(**executor) : !patches.look(**executor)) qFatal("no look");
  }
  document::LeakFinder finder;
  return finder.find(patches, {});
}

Lobes lobes_of(std::string_view kind, double alpha) {
  imaging::Phantom phantom = *imaging::make_phantom(kind);
  Lobes lobes;
  lobes.parameters.target = phantom.target;
  lobes.parameters.range = phantom.range;
  lobes.parameters.alpha = alpha;
  const auto& seed = *phantom.seed;
  lobes.seed = {phantom.volume.geometry.to_patient({seed[0], seed[1], seed[2]}), seed[3]};
  lobes.volume = std::make_shared<const Volume>(std::move(phantom.volume));
  return lobes;
}

}  // namespace

class LeakTest : public QObject {
  Q_OBJECT

 private slots:
  // Where the neck itself keeps the surface out, there is nothing to find.
  void what_comes_through_a_neck_is_found_in_time() {
    int leaks = 0;
    int found = 0;
    for (unsigned number = 0; number < kPhantoms; ++number) {
      const Lobes lobes = lobes_with_neck(number);
      const Watched watched = watch(lobes);
      if (!leaks_in_the_end(lobes)) {
        QVERIFY2(!watched.leak, qPrintable(QString("phantom %1 does not leak").arg(number)));
        continue;
      }
      ++leaks;
      if (!watched.leak) continue;
      ++found;
      QVERIFY2(watched.leaked_at == 0 || watched.step - watched.leaked_at <= kInTime,
               qPrintable(
                   QString("phantom %1: %2 after %3").arg(number).arg(watched.step).arg(watched.leaked_at)));
      QVERIFY(!watched.leak->neck.empty());
      QVERIFY(watched.leak->area_mm2 < 2.5 * M_PI * lobes.neck_mm * lobes.neck_mm);
    }
    qInfo("%d of %d leaks found", found, leaks);
    QVERIFY(leaks >= 15);
    QCOMPARE(found, leaks);
  }

  void nothing_is_found_where_there_is_no_neck() {
    for (unsigned number = 0; number < kPhantoms; ++number) {
      const Watched watched = watch(lobes_without_neck(number));
      QVERIFY2(!watched.leak, qPrintable(QString("phantom %1 at step %2").arg(number).arg(watched.step)));
      QVERIFY(watched.step < kMost);
    }
  }

  void a_wall_across_the_neck_closes_it_data() {
    QTest::addColumn<unsigned>("number");
    for (const unsigned number : {0U, 5U, 14U, 19U}) QTest::addRow("%u", number) << number;
  }
  void a_wall_across_the_neck_closes_it() {
    QFETCH(unsigned, number);
    const Lobes lobes = lobes_with_neck(number);
    const Watched watched = watch(lobes);
    QVERIFY(watched.leak);
    auto walls = std::make_shared<solver::Constraints>(lobes.volume->geometry.size);
    walls->set(watched.leak->neck, solver::Constraint::wall);
    QCOMPARE(walls->count(solver::Constraint::wall), static_cast<std::int64_t>(watched.leak->neck.size()));
    for (const Index3& voxel : watched.leak->neck) {
      QVERIFY(watched.before.voxels[static_cast<std::size_t>(lobes.volume->geometry.offset(voxel))] == 0);
    }
    const auto executor = executor_of(lobes, solver::ExecutorKind::host);
    QVERIFY(executor->set_constraints(walls));
    QVERIFY(executor->advance({.steps = kMost, .until_converged = true}));
    QVERIFY(!has_leaked(lobes, executor->snapshot()->mask()));
  }

  void the_bridge_leaks_without_curvature_alone() {
    QVERIFY(!watch(lobes_of("bridge", 0.6)).leak);
    const Watched watched = watch(lobes_of("bridge", 1.0));
    QVERIFY(watched.leak);
    // The bridge is the tube of 1.4 mm around the line between the balls, which end at x = 52 and 68.
    QVERIFY(std::abs(watched.leak->middle.x - 60) <= 9);
    QVERIFY(std::abs(watched.leak->middle.y - 32) <= 2 && std::abs(watched.leak->middle.z - 32) <= 2);
    QVERIFY(watched.leak->area_mm2 <= 12.0);
  }

  void every_executor_sees_the_same() {
    const Lobes lobes = lobes_with_neck(7);
    const Watched host = watch(lobes);
    const Watched reference = watch(lobes, solver::ExecutorKind::reference);
    QVERIFY(host.leak && reference.leak);
    QCOMPARE(reference.step, host.step);
    QVERIFY(reference.leak->middle == host.leak->middle);
    QCOMPARE(reference.leak->area_mm2, host.leak->area_mm2);
  }

  // The front comes around an edge of the body, where no face of a voxel closes its way.
  void a_neck_has_faces_that_close_it() {
    const auto leak = leak_among({{{2, 2, 2}, {11, 11, 11}},
                                  {{12, 12, 6}, {12, 12, 6}},
                                  {{12, 12, 2}, {21, 21, 11}},
                                  {{22, 12, 2}, {25, 21, 11}}});
    QVERIFY(leak);
    QCOMPARE(leak->passed, 2);
    QCOMPARE(leak->area_mm2, 4.0);
    QCOMPARE(leak->neck.size(), std::size_t{4});
    QVERIFY(glm::distance(glm::dvec3(leak->middle), glm::dvec3(12, 12, 6)) == 1.0);
  }

  void what_has_come_from_nowhere_is_no_leak() {
    QVERIFY(
        !leak_among({{{2, 2, 2}, {11, 11, 11}}, {{22, 12, 2}, {31, 21, 11}}, {{32, 12, 2}, {35, 21, 11}}}));
  }

  void padding_and_the_border_of_the_volume_are_no_neck() {
    // Sizes that are no multiple of a page; the surface runs out of the volume on all sides.
    auto volume = std::make_shared<Volume>();
    volume->geometry.size = Index3(37, 29, 21);
    volume->voxels = std::vector<std::int16_t>(static_cast<std::size_t>(volume->geometry.voxel_count()), 100);
    Lobes lobes;
    lobes.volume = volume;
    lobes.parameters.target = 100.0;
    lobes.parameters.range = 50.0;
    lobes.parameters.alpha = 0.9;
    lobes.seed = {{5.0, 5.0, 5.0}, 3.0};
    const Watched watched = watch(lobes);
    QVERIFY(!watched.leak);
  }
};

TIDEMARK_TEST(LeakTest)

}  // namespace tidemark::test::leak_test

#include "leak_test.moc"
