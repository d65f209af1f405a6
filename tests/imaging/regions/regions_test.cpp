// Regions and what is done with them, against plain loops over all voxels.
#include <sched.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "core/paged_bytes.h"
#include "core/region.h"
#include "core/without_exceptions.h"
#include "imaging/regions/cut.h"
#include "imaging/regions/fill_slices.h"
#include "imaging/regions/islands.h"
#include "imaging/regions/margin.h"
#include "imaging/regions/smoothing.h"
#include "tests/support/child_process.h"
#include "tests/support/grid.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::regions_test {

namespace {

template <class Wanted>
Mask mask_where(const Geometry& grid, const Wanted& wanted) {
  Mask mask{grid, std::vector<std::uint8_t>(static_cast<std::size_t>(grid.voxel_count()))};
  for (std::int64_t i = 0; i < grid.voxel_count(); ++i)
    mask.voxels[static_cast<std::size_t>(i)] = wanted(grid.voxel_at(i)) ? 1 : 0;
  return mask;
}

bool at(const Mask& mask, Index3 voxel) {
  return mask.geometry.contains(voxel) &&
         mask.voxels[static_cast<std::size_t>(mask.geometry.offset(voxel))] != 0;
}

// Some boxes and single voxels, at the grid's border too.
Mask rubble(const Geometry& grid, unsigned seed) {
  std::mt19937 random(seed);
  Mask mask = mask_where(grid, [](Index3) { return false; });
  for (int piece = 0; piece < 12; ++piece) {
    Index3 low, high;
    for (int axis = 0; axis < 3; ++axis) {
      const auto size = static_cast<unsigned>(grid.size[axis]);
      low[axis] = random() % size;
      high[axis] =
          std::min<std::int64_t>(low[axis] + 1 + random() % (piece % 2 == 0 ? 1 : size / 3 + 1), size);
    }
    for (std::int64_t i = 0; i < grid.voxel_count(); ++i) {
      const Index3 v = grid.voxel_at(i);
      if (glm::all(glm::greaterThanEqual(v, low)) && glm::all(glm::lessThan(v, high)))
        mask.voxels[static_cast<std::size_t>(i)] = 1;
    }
  }
  return mask;
}

std::vector<Geometry> grids() {
  return {grid_of({70, 21, 17}), grid_of({130, 9, 11}, {0.7, 1.1, 2.5}),
          grid_of({12, 30, 1}, {1.0, 0.5, 3.0})};
}

// The smallest distance from the voxel's centre to that of a voxel that is so.
template <class Wanted>
double distance_to(const Geometry& grid, Index3 voxel, const Wanted& wanted) {
  double least = std::numeric_limits<double>::infinity();
  for (std::int64_t i = 0; i < grid.voxel_count(); ++i) {
    const Index3 other = grid.voxel_at(i);
    if (!wanted(other)) continue;
    least = std::min(least, glm::length(glm::dvec3(other - voxel) * grid.spacing_mm));
  }
  return least;
}

}  // namespace

class RegionsTest : public QObject {
  Q_OBJECT

 private slots:
  void a_region_holds_the_voxels_of_its_mask() {
    for (const Geometry& grid : grids()) {
      const Mask mask = rubble(grid, 3);
      const Region region(mask);
      QCOMPARE(region.count(), mask.count());
      QVERIFY(mask_of(region, grid).voxels == mask.voxels);
      // From labels it takes room for its own voxels alone, and is the same.
      std::vector<std::uint8_t> labels(mask.voxels.size(), 9);
      for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = mask.voxels[i] != 0 ? 7 : labels[i];
      const PagedBytes slices(grid.size, labels);
      const Region of_label(slices, 7);
      QVERIFY(of_label == region);
      QVERIFY(of_label.bounds() == region.bounds());
      QVERIFY(!(Region(slices, 9) == region));
      QVERIFY(Region(slices, 1).empty());
    }
    QVERIFY(Region() == Region());
    QVERIFY(Region().bounds().empty());
  }

  void sets_are_combined_voxel_by_voxel() {
    for (const Geometry& grid : grids()) {
      const Mask a = rubble(grid, 1);
      const Mask b = rubble(grid, 2);
      const Region in_a(a);
      // With a box of its own.
      const Region in_b = intersection(Region(b), whole(Region(b).bounds()));
      const auto check = [&](const Region& region, const auto& wanted) {
        const Mask expected = mask_where(grid, [&](Index3 v) { return wanted(at(a, v), at(b, v)); });
        return mask_of(region, grid).voxels == expected.voxels;
      };
      QVERIFY(check(united(in_a, in_b), [](bool x, bool y) { return x || y; }));
      QVERIFY(check(intersection(in_a, in_b), [](bool x, bool y) { return x && y; }));
      QVERIFY(check(difference(in_a, in_b), [](bool x, bool y) { return x && !y; }));
      QVERIFY(check(complement(in_a, {Index3(0), grid.size}), [](bool x, bool) { return !x; }));
      QCOMPARE(dice(in_a, in_b), dice(a, b));
      QCOMPARE(common_count(in_a, in_b), intersection(in_a, in_b).count());
      QVERIFY(united(in_a, Region()) == in_a);
      QVERIFY(difference(Region(), in_a).empty());
    }
  }

  void margins_are_exact_in_mm() {
    for (const Geometry& grid : grids()) {
      const Mask mask = rubble(grid, 4);
      for (const double mm : {0.0, 1.0, 2.3, 5.0}) {
        const auto larger = imaging::grown(Region(mask), grid, mm);
        const auto smaller = imaging::shrunk(Region(mask), grid, mm);
        QCOMPARE(failure(larger), QString());
        QCOMPARE(failure(smaller), QString());
        for (std::int64_t i = 0; i < grid.voxel_count(); i += 41) {
          const Index3 v = grid.voxel_at(i);
          const double to_inside = distance_to(grid, v, [&](Index3 w) { return at(mask, w); });
          QCOMPARE(larger->contains(v), to_inside <= mm * (1.0 + 1e-9));
          const double to_outside = distance_to(grid, v, [&](Index3 w) { return !at(mask, w); });
          QCOMPARE(smaller->contains(v), to_outside > mm * (1.0 + 1e-9));
        }
      }
    }
    QCOMPARE(imaging::grown(Region(), grid_of({9, 9, 9}), 1.0)->count(), std::int64_t{0});
    for (const double wrong : {-1.0, 1000.0, std::nan("")}) {
      const auto refused = imaging::grown(Region(), grid_of({9, 9, 9}), wrong);
      QVERIFY(!refused);
      QCOMPARE(refused.error().kind, ErrorKind::usage);
    }
  }

  void a_wide_margin_of_a_wide_grid_reaches_over_words() {
    const Geometry grid = grid_of({400, 3, 3}, {0.5, 1.0, 1.0});
    Region region(VoxelRange{{200, 1, 1}, {201, 2, 2}});
    region.add({200, 1, 1});
    const auto wide = imaging::grown(region, grid, 50.0);
    QCOMPARE(failure(wide), QString());
    const auto bounds = wide->bounds();
    QCOMPARE(bounds.low.x, std::int64_t{100});
    QCOMPARE(bounds.high.x, std::int64_t{301});
    QVERIFY(imaging::shrunk(*wide, grid, 50.0)->contains({200, 1, 1}));
  }

  void islands_touch_across_faces_alone() {
    const Geometry grid = grid_of({6, 5, 4});
    Region region(VoxelRange{Index3(0), grid.size});
    region.add({0, 0, 0});
    region.add({1, 1, 1});  // touches the first at a corner
    region.add_run({3, 2, 2}, 3);
    region.add({5, 3, 2});
    region.add({5, 3, 3});
    const imaging::Islands islands(region);
    QVERIFY((islands.voxels() == std::vector<std::int64_t>{1, 1, 5}));
    QCOMPARE(islands.largest(), std::size_t{2});
    QVERIFY(islands.at({5, 3, 3}) == std::size_t{2});
    QVERIFY(islands.at({1, 1, 1}) == std::size_t{1});
    QVERIFY(!islands.at({2, 2, 2}));
    QVERIFY(!islands.at({0, 0, 9}));
    const Region largest = islands.region_of([](std::size_t island) { return island == 2; });
    QCOMPARE(largest.count(), std::int64_t{5});
    QVERIFY(largest.contains({5, 3, 3}));
    QCOMPARE(imaging::Islands(region, imaging::Touching::in_slices).count(), std::size_t{4});
    QCOMPARE(imaging::Islands(Region()).count(), std::size_t{0});
    QCOMPARE(imaging::Islands(whole({Index3(0), grid.size})).count(), std::size_t{1});
  }

  // A comb whose teeth are joined at its last row, and a spiral: parts that are found to be one late.
  void an_island_is_whole_however_it_winds() {
    const Geometry grid = grid_of({41, 41, 3});
    const Mask comb = mask_where(grid, [](Index3 v) { return v.x % 2 == 0 || v.y == 40; });
    QCOMPARE(imaging::Islands(Region(comb)).count(), std::size_t{1});
    const Mask rings =
        mask_where(grid, [](Index3 v) { return std::max(std::abs(v.x - 20), std::abs(v.y - 20)) % 2 == 0; });
    QCOMPARE(imaging::Islands(Region(rings)).count(), std::size_t{11});
  }

  void holes_are_filled_and_bays_are_not() {
    const Geometry grid = grid_of({20, 20, 12});
    const auto in_box = [](Index3 v, std::int64_t low, std::int64_t high) {
      return v.x >= low && v.y >= low && v.z >= low && v.x < high && v.y < high && v.z < high;
    };
    // A box with a bubble, and a tunnel along k that opens at both ends.
    const auto tunnel = [](Index3 v) { return v.x == 8 && v.y == 8; };
    const Mask mask =
        mask_where(grid, [&](Index3 v) { return in_box(v, 2, 10) && !in_box(v, 4, 6) && !tunnel(v); });
    const Region filled = imaging::without_holes(Region(mask), grid.size, imaging::Touching::in_volume);
    QVERIFY(filled.contains({4, 4, 4}));
    QVERIFY(!filled.contains({8, 8, 5}));
    QCOMPARE(filled.count(), mask.count() + 8);
    const Region slices = imaging::without_holes(Region(mask), grid.size, imaging::Touching::in_slices);
    QVERIFY(slices.contains({8, 8, 5}));
    QCOMPARE(slices.count(), std::int64_t{8 * 8 * 8});
    // What is open to the grid's border may go on beyond it.
    const Mask cup = mask_where(
        grid, [&](Index3 v) { return v.z < 5 && !(v.z < 4 && v.x > 3 && v.x < 9 && v.y > 3 && v.y < 9); });
    QVERIFY(imaging::without_holes(Region(cup), grid.size, imaging::Touching::in_volume) == Region(cup));
  }

  void a_median_asks_the_ball_around_each_voxel() {
    for (const Geometry& grid : grids()) {
      const Mask mask = rubble(grid, 6);
      const double radius_mm = 2.4;
      const auto smooth = imaging::smoothed_by_median(Region(mask), grid, radius_mm);
      QCOMPARE(failure(smooth), QString());
      const Index3 reach(glm::dvec3(radius_mm) / grid.spacing_mm);
      for (std::int64_t i = 0; i < grid.voxel_count(); ++i) {
        const Index3 v = grid.voxel_at(i);
        int all = 0;
        int inside = 0;
        for (std::int64_t z = -reach.z; z <= reach.z; ++z)
          for (std::int64_t y = -reach.y; y <= reach.y; ++y)
            for (std::int64_t x = -reach.x; x <= reach.x; ++x) {
              // Beyond the grid, and farther than it is large, there is nothing to ask.
              if (glm::any(glm::greaterThanEqual(glm::abs(Index3(x, y, z)), grid.size))) continue;
              if (glm::length(glm::dvec3(x, y, z) * grid.spacing_mm) > radius_mm) continue;
              ++all;
              inside += at(mask, glm::clamp(v + Index3(x, y, z), Index3(0), grid.size - Index3(1))) ? 1 : 0;
            }
        QCOMPARE(smooth->contains(v), 2 * inside > all);
      }
    }
    QVERIFY(!imaging::smoothed_by_median(Region(), grid_of({9, 9, 9}), 0.0));
    const auto too_many =
        imaging::smoothed_by_median(whole({{0, 0, 0}, {9, 9, 9}}), grid_of({200, 200, 200}), 20.0 + 5.0);
    QVERIFY(!too_many);
    QCOMPARE(too_many.error().kind, ErrorKind::usage);
  }

  void a_gaussian_keeps_the_volume_and_takes_the_noise() {
    for (const glm::dvec3 spacing : {glm::dvec3(1.0), glm::dvec3(0.8, 1.0, 2.0)}) {
      const Geometry grid = grid_of({66, 52, 34}, spacing);
      const glm::dvec3 centre = 0.5 * glm::dvec3(grid.size - Index3(1)) * spacing;
      const auto depth = [&](Index3 v) { return 16.0 - glm::length(glm::dvec3(v) * spacing - centre); };
      std::mt19937 random(8);
      // Near to its surface half of the voxels have flipped.
      const Mask noisy = mask_where(
          grid, [&](Index3 v) { return std::abs(depth(v)) < 1.5 ? random() % 2 == 0 : depth(v) > 0.0; });
      const Mask ball = mask_where(grid, [&](Index3 v) { return depth(v) > 0.0; });
      const auto smooth = imaging::smoothed_by_gaussian(Region(noisy), grid, 2.0);
      QCOMPARE(failure(smooth), QString());
      const auto kept = static_cast<double>(smooth->count()) / static_cast<double>(noisy.count());
      QVERIFY2(std::abs(kept - 1.0) < 0.001, qPrintable(QString::number(kept)));
      QVERIFY(dice(*smooth, Region(ball)) > 0.975);
      QVERIFY(dice(Region(noisy), Region(ball)) < 0.94);
      QCOMPARE(imaging::Islands(*smooth).count(), std::size_t{1});
    }
  }

  void a_gaussian_weighs_the_surroundings_of_each_voxel() {
    for (const Geometry& grid : grids()) {
      for (const double sigma_mm : {1.5, 4.0}) {
        const Mask mask = rubble(grid, 7);
        const auto smooth = imaging::smoothed_by_gaussian(Region(mask), grid, sigma_mm);
        QCOMPARE(failure(smooth), QString());
        std::vector<double> values(mask.voxels.begin(), mask.voxels.end());
        for (int axis = 0; axis < 3; ++axis) {
          const std::vector<double> before = values;
          const double sigma = sigma_mm / grid.spacing_mm[axis];
          const auto reach = static_cast<std::int64_t>(std::ceil(3.0 * sigma));
          for (std::int64_t i = 0; i < grid.voxel_count(); ++i) {
            double sum = 0.0;
            double weights = 0.0;
            for (std::int64_t n = -reach; n <= reach; ++n) {
              Index3 v = grid.voxel_at(i);
              v[axis] = std::clamp<std::int64_t>(v[axis] + n, 0, grid.size[axis] - 1);
              const double weight = std::exp(-0.5 * std::pow(static_cast<double>(n) / sigma, 2));
              sum += weight * before[static_cast<std::size_t>(grid.offset(v))];
              weights += weight;
            }
            values[static_cast<std::size_t>(i)] = sum / weights;
          }
        }
        double least_inside = 1.0;
        double most_outside = 0.0;
        for (std::int64_t i = 0; i < grid.voxel_count(); ++i) {
          const double value = values[static_cast<std::size_t>(i)];
          if (smooth->contains(grid.voxel_at(i))) {
            least_inside = std::min(least_inside, value);
          } else {
            most_outside = std::max(most_outside, value);
          }
        }
        QVERIFY2(most_outside - least_inside < 1e-5,
                 qPrintable(QString("%1 %2").arg(most_outside).arg(least_inside)));
      }
    }
  }

  // 601 slices reach into each one, which are 96 MB of floats, and there are 8. On one processor, because
  // every thread maps memory of its own.
  void a_gaussian_takes_memory_for_the_slices_that_are_there() {
    const Geometry grid = grid_of({200, 200, 8}, {2.0, 2.0, 0.1});
    const Region region = whole({{10, 10, 2}, {190, 190, 6}});
    const auto smooth = [&]() -> Status {
      cpu_set_t one;
      CPU_ZERO(&one);
      CPU_SET(static_cast<std::size_t>(sched_getcpu()), &one);
      sched_setaffinity(0, sizeof one, &one);
      return without_exceptions([&]() -> Status {
        const auto smoothed = imaging::smoothed_by_gaussian(region, grid, 10.0);
        return smoothed ? Status() : pass_on(smoothed);
      });
    };
    const Ended ended = run_in_child(smooth, {.more_memory = std::int64_t{32} << 20});
    QVERIFY(!ended.was_killed);
    QCOMPARE(QString::fromStdString(ended.failure), QString());
  }

  void empty_slices_between_drawn_ones_are_filled() {
    const Geometry grid = grid_of({40, 36, 33}, {0.9, 1.1, 2.0});
    const glm::dvec3 centre = 0.5 * glm::dvec3(grid.size - Index3(1)) * grid.spacing_mm;
    const Mask ball = mask_where(grid, [&](Index3 v) {
      return glm::length((glm::dvec3(v) * grid.spacing_mm - centre) / glm::dvec3(1.0, 0.8, 1.6)) < 14.0;
    });
    for (int axis = 0; axis < 3; ++axis) {
      const Mask drawn = mask_where(grid, [&](Index3 v) { return at(ball, v) && v[axis] % 4 == 0; });
      const auto filled = imaging::with_slices_filled(Region(drawn), grid, axis);
      QCOMPARE(failure(filled), QString());
      QVERIFY(difference(Region(drawn), *filled).empty());
      const VoxelRange bounds = Region(drawn).bounds();
      const Mask between = mask_where(grid, [&](Index3 v) {
        return at(ball, v) && v[axis] >= bounds.low[axis] && v[axis] < bounds.high[axis];
      });
      QVERIFY2(dice(*filled, Region(between)) > 0.96,
               qPrintable(QString::number(dice(*filled, Region(between)))));
      // What was drawn is as it was, and nothing is beside it in its slices.
      const Region in_drawn(
          mask_where(grid, [&](Index3 v) { return filled->contains(v) && v[axis] % 4 == 0; }));
      QVERIFY(in_drawn == Region(drawn));
    }
    const auto nothing = imaging::with_slices_filled(Region(ball), grid, 2);
    QVERIFY(!nothing);
    QCOMPARE(nothing.error().kind, ErrorKind::usage);
  }

  void a_plane_cuts_and_a_mirror_turns() {
    Geometry grid = grid_of({70, 12, 8}, {1.0, 2.0, 0.5});
    grid.origin_mm = {5.0, -7.0, 3.0};
    const Mask mask = rubble(grid, 9);
    const glm::dvec3 point = grid.to_patient({33.2, 5.1, 4.4});
    const glm::dvec3 normal(0.3, -0.8, 0.2);
    const Region side = imaging::on_side(Region(mask), grid, point, normal);
    const Region other = imaging::on_side(Region(mask), grid, point, -normal);
    QVERIFY(united(side, other) == Region(mask));
    QVERIFY(intersection(side, other).empty());
    side.for_each_run([&](Index3 v, std::int64_t) {
      QVERIFY(glm::dot(grid.to_patient(glm::dvec3(v)) - point, normal) >= 0.0);
    });
    QVERIFY(!side.empty() && !other.empty());
    for (int axis = 0; axis < 3; ++axis) {
      const Mask turned = mask_where(grid, [&](Index3 v) {
        v[axis] = grid.size[axis] - 1 - v[axis];
        return at(mask, v);
      });
      QVERIFY(imaging::mirrored(Region(mask), grid.size, axis) == Region(turned));
    }
  }

  void long_work_is_cancelled() {
    std::stop_source stop;
    stop.request_stop();
    const Progress progress{nullptr, stop.get_token()};
    const Geometry grid = grid_of({64, 64, 64});
    const Region region = whole({{5, 5, 5}, {50, 50, 50}});
    for (const auto& result :
         {imaging::grown(region, grid, 3.0, progress), imaging::shrunk(region, grid, 3.0, progress),
          imaging::smoothed_by_median(region, grid, 3.0, progress),
          imaging::smoothed_by_gaussian(region, grid, 3.0, progress)}) {
      QVERIFY(!result);
      QCOMPARE(result.error().kind, ErrorKind::cancelled);
    }
  }
};

TIDEMARK_TEST(RegionsTest)

}  // namespace tidemark::test::regions_test

#include "regions_test.moc"
