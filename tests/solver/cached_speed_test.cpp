// The cache before speed functions that take long to evaluate.
#include <atomic>
#include <random>
#include <thread>

#include "solver/speed/cached_speed.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cached_speed_test {

using namespace tidemark::solver;

namespace {

constexpr Index3 kGrid{37, 26, 19};  // with pages that are cut at the grid's end

double wave(Index3 v) {
  return std::sin(0.37 * static_cast<double>(v.x) + 0.71 * static_cast<double>(v.y) +
                  1.13 * static_cast<double>(v.z));
}

// Counts the voxels that it is asked for.
class Counting final : public SpeedFunction, public LocallyFollowing {
 public:
  explicit Counting(double sign = 1.0) : sign_(sign) {}

  void evaluate(const VoxelBox& box, double* speed) const override {
    evaluated += box.voxels();
    if (failures > 0 && failures-- > 0) throw std::bad_alloc();
    if (slow) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    for (std::int64_t z = 0; z < box.size.z; ++z) {
      for (std::int64_t y = 0; y < box.size.y; ++y) {
        for (std::int64_t x = 0; x < box.size.x; ++x) *speed++ = sign_ * wave(box.first + Index3(x, y, z));
      }
    }
  }
  bool follows_surface() const override { return true; }
  std::shared_ptr<const SpeedFunction> following(const Field& phi) const override {
    if (phi.pages.size() == 0) return nullptr;
    auto next = std::make_shared<Counting>(-sign_);
    next->changed_from_x = changed_from_x;
    return next;
  }
  bool is_as_before(const VoxelBox& box) const override { return box.first.x + box.size.x <= changed_from_x; }

  mutable std::atomic<std::int64_t> evaluated{0};
  mutable std::atomic<int> failures{0};  // that are still to come
  bool slow = false;
  std::int64_t changed_from_x = 0;  // where following() turns the sign

 private:
  double sign_;
};

// The first voxel of the box where the cache does not give what the function gives; "" when there is none.
QString difference(const CachedSpeed& cached, const VoxelBox& box) {
  std::vector<std::int16_t> quantised(static_cast<std::size_t>(box.voxels()));
  std::vector<double> speed(quantised.size());
  cached.quantised(box, quantised.data());
  cached.evaluate(box, speed.data());
  std::size_t i = 0;
  for (std::int64_t z = 0; z < box.size.z; ++z) {
    for (std::int64_t y = 0; y < box.size.y; ++y) {
      for (std::int64_t x = 0; x < box.size.x; ++x, ++i) {
        const Index3 v = box.first + Index3(x, y, z);
        const auto expected = static_cast<std::int16_t>(std::lround(wave(v) * 32767.0));
        if (quantised[i] == expected && speed[i] == expected / 32767.0) continue;
        return QString("(%1, %2, %3): %4 and not %5").arg(v.x).arg(v.y).arg(v.z).arg(speed[i]).arg(wave(v));
      }
    }
  }
  return {};
}

VoxelBox random_box(std::mt19937& random, bool slice) {
  VoxelBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.first[axis] = std::uniform_int_distribution<std::int64_t>(0, kGrid[axis] - 1)(random);
    box.size[axis] = std::uniform_int_distribution<std::int64_t>(1, kGrid[axis] - box.first[axis])(random);
  }
  if (slice) box.size[std::uniform_int_distribution<int>(0, 2)(random)] = 1;
  return box;
}

}  // namespace

class CachedSpeedTest : public QObject {
  Q_OBJECT

 private slots:
  void a_voxel_has_the_same_bits_in_every_box() {
    std::mt19937 random(7);
    for (int cache = 0; cache < 20; ++cache) {
      const CachedSpeed cached(std::make_shared<Counting>(), kGrid);
      for (int i = 0; i < 30; ++i) QCOMPARE(difference(cached, random_box(random, i % 2 == 0)), QString());
    }
  }

  void a_page_is_evaluated_once() {
    const auto function = std::make_shared<Counting>();
    const CachedSpeed cached(function, kGrid);
    const VoxelBox page{{8, 8, 8}, {8, 8, 8}};
    for (int i = 0; i < 3; ++i) QCOMPARE(difference(cached, page), QString());
    QCOMPARE(function->evaluated.load(), 512);
    QCOMPARE(difference(cached, {Index3(0), kGrid}), QString());
    QCOMPARE(function->evaluated.load(), kGrid.x * kGrid.y * kGrid.z);
  }

  void a_page_is_evaluated_once_when_many_threads_ask() {
    const auto function = std::make_shared<Counting>();
    function->slow = true;
    const CachedSpeed cached(function, kGrid);
    std::atomic<int> wrong{0};
    {
      std::vector<std::jthread> threads;
      for (int t = 0; t < 6; ++t) {
        threads.emplace_back([&, t] {
          for (int i = 0; i < 60; ++i) {
            const int page = (i + t * 10) % 60;  // 5 x 4 x 3 pages
            const Index3 first = Index3(page % 5, page / 5 % 4, page / 20) * Index3(8);
            const VoxelBox box{first, glm::min(Index3(8), kGrid - first)};
            if (!difference(cached, box).isEmpty()) ++wrong;
          }
        });
      }
    }
    QCOMPARE(wrong.load(), 0);
    QCOMPARE(function->evaluated.load(), kGrid.x * kGrid.y * kGrid.z);
  }

  void a_page_that_failed_for_lack_of_memory_keeps_nobody_waiting() {
    const auto function = std::make_shared<Counting>();
    const CachedSpeed cached(function, kGrid);
    const VoxelBox two{{8, 8, 8}, {16, 8, 8}};
    function->failures = 1;
    std::vector<double> speed(static_cast<std::size_t>(two.voxels()));
    QVERIFY_EXCEPTION_THROWN(cached.evaluate(two, speed.data()), std::bad_alloc);
    QCOMPARE(difference(cached, two), QString());
    QCOMPARE(difference(cached, {Index3(0), kGrid}), QString());
  }

  void slices_are_answered_from_the_pages_that_are_there() {
    const auto function = std::make_shared<Counting>();
    const CachedSpeed cached(function, kGrid);
    const VoxelBox slice{{0, 0, 11}, {kGrid.x, kGrid.y, 1}};
    QCOMPARE(difference(cached, slice), QString());
    QCOMPARE(function->evaluated.load(), 2 * kGrid.x * kGrid.y);  // difference() asks twice
    // Of 5 x 4 pages the 16 on the left.
    QCOMPARE(difference(cached, {{0, 0, 8}, {32, kGrid.y, 8}}), QString());
    function->evaluated = 0;
    QCOMPARE(difference(cached, slice), QString());
    QCOMPARE(function->evaluated.load(), 2 * 5 * kGrid.y);
  }

  void memory_is_two_bytes_a_voxel_that_was_asked_for() {
    const CachedSpeed cached(std::make_shared<Counting>(), {400, 400, 400});
    const std::int64_t empty = cached.memory();
    QVERIFY(empty < 400 * 400 * 400 / 50);
    QCOMPARE(difference(cached, {{80, 80, 80}, {160, 160, 160}}), QString());
    const double bytes = static_cast<double>(cached.memory() - empty) / (160.0 * 160.0 * 160.0);
    QVERIFY2(bytes >= 2.0 && bytes < 2.1, qPrintable(QString::number(bytes)));
  }

  void what_follows_the_surface_has_a_cache_of_its_own() {
    const CachedSpeed cached(std::make_shared<Counting>(), kGrid);
    const VoxelBox page{{0, 0, 0}, {8, 8, 8}};
    QCOMPARE(difference(cached, page), QString());
    QVERIFY(cached.following(Field()) == nullptr);
    Geometry geometry;
    geometry.size = kGrid;
    const auto next = cached.following(Field::empty(geometry, 2.5));
    QVERIFY(next != nullptr);
    double speed[512];
    next->evaluate(page, speed);
    QVERIFY(std::abs(speed[3] + wave({3, 0, 0})) < 1e-4);
  }

  void pages_that_are_as_before_are_taken_over() {
    const auto function = std::make_shared<Counting>();
    function->changed_from_x = 16;
    const CachedSpeed cached(function, kGrid);
    const VoxelBox all{Index3(0), {32, 16, 16}};
    QCOMPARE(difference(cached, all), QString());
    Geometry geometry;
    geometry.size = kGrid;
    const auto next = cached.following(Field::empty(geometry, 2.5));
    const auto& next_cache = dynamic_cast<const CachedSpeed&>(*next);
    const auto& next_function = dynamic_cast<const Counting&>(next_cache.function());
    std::vector<double> speed(static_cast<std::size_t>(all.voxels()));
    next->evaluate(all, speed.data());
    QCOMPARE(next_function.evaluated.load(), 16 * 16 * 16);
    QVERIFY(std::abs(speed[3] - wave({3, 0, 0})) < 1e-4);
    QVERIFY(std::abs(speed[20] + wave({20, 0, 0})) < 1e-4);
  }

  void functions_without_a_cache_are_quantised_alike() {
    const auto function = std::make_shared<Counting>();
    const CachedSpeed cached(function, kGrid);
    const VoxelBox box{{3, 4, 5}, {11, 12, 13}};
    std::vector<std::int16_t> direct(static_cast<std::size_t>(box.voxels()));
    std::vector<std::int16_t> from_pages(direct.size());
    evaluate_quantised(*function, box, direct.data());
    evaluate_quantised(cached, box, from_pages.data());
    QVERIFY(direct == from_pages);
    QCOMPARE(quantised_speed(-1.0), std::int16_t{-32767});
    QCOMPARE(quantised_speed(1.0), std::int16_t{32767});
  }
};

TIDEMARK_TEST(CachedSpeedTest)

}  // namespace tidemark::test::cached_speed_test

#include "cached_speed_test.moc"
