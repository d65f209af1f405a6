// From places of slices to a regular grid, and the voxels on it, without files.
#include "imaging/dicom/regular_grid.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <random>

#include "imaging/dicom/resample_slices.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::regular_grid_test {

namespace {

constexpr imaging::GridPolicy kFill{imaging::GridPolicy::Tilt::correct, imaging::GridPolicy::Gaps::fill};
constexpr imaging::GridPolicy kKeep{imaging::GridPolicy::Tilt::keep, imaging::GridPolicy::Gaps::refuse};

using Numbers = QList<double>;

// Slices of 20 x 16 pixels of 0.5 x 0.8 mm at these places along an oblique normal, which move sideways by
// that many mm a mm.
imaging::ImageStack stack_at(const Numbers& along, glm::dvec2 slope = {0.0, 0.0}) {
  imaging::ImageStack stack;
  stack.size = {20, 16, along.size()};
  stack.spacing_mm = {0.5, 0.8};
  const glm::dvec3 row = glm::normalize(glm::dvec3(1.0, 0.1, 0.3));
  const glm::dvec3 column = glm::normalize(glm::cross(glm::dvec3(0.2, 0.0, 1.0), row));
  stack.axes = {row, column, glm::cross(row, column)};
  for (const double z : along) {
    const glm::dvec3 place(slope * z, z);
    stack.positions_mm.push_back(glm::dvec3(7.0, -50.0, 31.0) + stack.axes * place);
    stack.names.push_back(fmt::format("s{}", stack.names.size()));
  }
  return stack;
}

// "2" for a slice as it is, "1:0.25 2:0.75" for a mixture.
QString text_of(const imaging::GridSlice& slice) {
  const auto share = [](const imaging::SliceShare& one) {
    return QString("%1:%2").arg(one.slice).arg(one.weight, 0, 'g', 3);
  };
  if (slice[1].weight == 0.0 && slice[0].weight == 1.0) return QString::number(slice[0].slice);
  return share(slice[0]) + " " + share(slice[1]);
}

bool has(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

// The slices of a stack with f(mm) at their pixels.
template <class Voxel, class Function>
std::vector<std::vector<Voxel>> slices_of(const imaging::ImageStack& stack, const Function& f) {
  std::vector<std::vector<Voxel>> slices;
  for (const glm::dvec3& position : stack.positions_mm) {
    auto& slice = slices.emplace_back();
    for (std::int64_t j = 0; j < stack.size.y; ++j) {
      for (std::int64_t i = 0; i < stack.size.x; ++i) {
        const glm::dvec2 mm = glm::dvec2(i, j) * stack.spacing_mm;
        const double value = f(position + mm.x * stack.axes[0] + mm.y * stack.axes[1]);
        slice.push_back(static_cast<Voxel>(std::is_integral_v<Voxel> ? std::round(value) : value));
      }
    }
  }
  return slices;
}

template <class Voxel>
std::vector<Voxel> resampled(const imaging::GridPlan& plan, const imaging::ImageStack& stack,
                             const std::vector<std::vector<Voxel>>& slices,
                             std::optional<Voxel> background = std::nullopt) {
  std::vector<Voxel> voxels(static_cast<std::size_t>(plan.geometry.voxel_count()));
  const auto decode = [&](std::int64_t k, Voxel* target) {
    const auto& slice = slices[static_cast<std::size_t>(k)];
    std::copy(slice.begin(), slice.end(), target);
    return true;
  };
  if (!imaging::resample_slices<Voxel>({plan, stack.size, decode, [] {}, background}, voxels)) voxels.clear();
  return voxels;
}

// Whether a voxel lies within a slice that its grid slice is made of, at least so many pixels from its edge.
bool is_covered(const imaging::GridPlan& plan, const imaging::ImageStack& stack, Index3 voxel,
                double margin) {
  for (const imaging::SliceShare& share : plan.slices[static_cast<std::size_t>(voxel.z)]) {
    if (share.weight == 0.0) continue;
    const glm::dvec2 at = glm::dvec2(voxel) - share.shift;
    const glm::dvec2 last = glm::dvec2(stack.size) - 1.0;
    if (at.x < margin || at.y < margin || at.x > last.x - margin || at.y > last.y - margin) return false;
  }
  return true;
}

template <class Visit>
void for_each_voxel(const Geometry& grid, const Visit& visit) {
  for (std::int64_t offset = 0; offset < grid.voxel_count(); ++offset) {
    visit(grid.voxel_at(offset), static_cast<std::size_t>(offset));
  }
}

}  // namespace

class RegularGridTest : public QObject {
  Q_OBJECT

 private slots:
  void places_become_an_even_grid_data() {
    QTest::addColumn<Numbers>("along");
    QTest::addColumn<double>("step");
    QTest::addColumn<QStringList>("slices");
    const auto row = [](const char* name, const Numbers& along, double step, const QStringList& slices) {
      QTest::newRow(name) << along << step << slices;
    };
    row("even", {0, 2, 4, 6}, 2.0, {});
    row("one is missing", {0, 5, 15, 20}, 5.0, {"0", "1", "1:0.5 2:0.5", "2", "3"});
    row("two are missing", {0, 2, 8}, 2.0, {"0", "1", "1:0.667 2:0.333", "1:0.333 2:0.667", "2"});
    row("more are missing than not", {0, 5, 15, 25}, 5.0, {"0", "1", "1:0.5 2:0.5", "2", "2:0.5 3:0.5", "3"});
    row("two pitches and a step between them", {0, 4, 8, 12, 16, 17, 24, 31, 38, 45}, 4.0,
        {"0", "1", "2", "3", "4", "5:0.571 6:0.429", "6", "6:0.429 7:0.571", "7:0.857 8:0.143",
         "7:0.286 8:0.714", "8:0.714 9:0.286", "8:0.143 9:0.857"});
    row("no two alike", {0, 1, 3, 7, 12}, 2.0,
        {"0", "1:0.5 2:0.5", "2:0.75 3:0.25", "2:0.25 3:0.75", "3:0.8 4:0.2", "3:0.4 4:0.6", "4"});
    // The last slice is beyond the middle of the grid's last step, and stands for the rest of it.
    row("half a step more", {0, 2, 4, 6, 7.2}, 2.0, {"0", "1", "2", "3", "4"});
    row("less than half a step more", {0, 2, 4, 6, 6.8}, 2.0, {"0", "1", "2", "3"});
  }

  void places_become_an_even_grid() {
    QFETCH(Numbers, along);
    QFETCH(double, step);
    QFETCH(QStringList, slices);
    const imaging::ImageStack stack = stack_at(along);
    const imaging::GridPlan plan = imaging::plan_regular_grid(stack, kFill);
    QCOMPARE(plan.refusal, std::string());
    QStringList told;
    for (const imaging::GridSlice& slice : plan.slices) told << text_of(slice);
    QCOMPARE(told, slices);
    const Geometry& grid = plan.geometry;
    QCOMPARE(grid.size, Index3(20, 16, slices.empty() ? along.size() : slices.size()));
    QVERIFY(glm::length(grid.spacing_mm - glm::dvec3(0.5, 0.8, step)) < 1e-9);
    QVERIFY(glm::length(grid.origin_mm - stack.positions_mm.front()) < 1e-9);
    QCOMPARE(grid.direction, stack.axes);
    QCOMPARE(plan.changes.empty(), slices.empty());
    QVERIFY(plan.warnings.empty());
  }

  void gaps_are_refused_until_they_may_be_filled() {
    const imaging::GridPlan missing = imaging::plan_regular_grid(stack_at({0, 2, 4, 10, 12, 16}), {});
    QCOMPARE(missing.refusal, std::string("2 slices are missing between s2 and s3: they are 6.000 mm apart, "
                                          "others 2.000 mm, and in 1 more place"));
    QCOMPARE(missing.question,
             std::string("2 slices are missing between s2 and s3, and in 1 more place. Fill "
                         "them by interpolation?"));
    const imaging::GridPlan filled = imaging::plan_regular_grid(stack_at({0, 2, 4, 10, 12, 16}), kFill);
    QCOMPARE(filled.question, std::string());
    QCOMPARE(filled.changes.size(), std::size_t{2});
    QVERIFY2(has(filled.changes[0], "slices 4 to 5 of 9 (6.000 to 8.000 mm from the first)"),
             filled.changes[0].c_str());
    QVERIFY2(
        has(filled.changes[1], "slice 8 of 9 (14.000 mm from the first) is interpolated between s4 and s5"),
        filled.changes[1].c_str());
    const imaging::GridPlan uneven = imaging::plan_regular_grid(stack_at({0, 2, 4, 7, 9}), {});
    QVERIFY2(has(uneven.refusal, "s2 and s3 are 3.000 mm apart, others 2.000 mm"), uneven.refusal.c_str());
    QVERIFY2(has(uneven.question, "Make 6 slices at 2.000 mm"), uneven.question.c_str());
  }

  void no_grid_is_much_larger_than_its_slices() {
    const imaging::ImageStack far = stack_at({0, 1, 2, 1000000});
    for (const imaging::GridPolicy& policy : {imaging::GridPolicy(), kFill}) {
      const imaging::GridPlan plan = imaging::plan_regular_grid(far, policy);
      QVERIFY(!plan.refusal.empty());
      QCOMPARE(plan.question, std::string());
      QCOMPARE(plan.geometry, Geometry());
    }
    imaging::ImageStack wide = stack_at({0, 1, 2, 3}, {0.0, 0.4});
    wide.spacing_mm = {1e-4, 1e-4};
    QVERIFY(has(imaging::plan_regular_grid(wide, {}).refusal, "times as many voxels"));
  }

  void tilted_slices_lie_where_they_were_data() {
    QTest::addColumn<double>("x");
    QTest::addColumn<double>("y");
    QTest::newRow("towards high rows") << 0.0 << 0.3;
    QTest::newRow("towards low rows") << 0.0 << -0.3;
    QTest::newRow("along both axes") << -0.2 << 0.25;
  }

  void tilted_slices_lie_where_they_were() {
    QFETCH(double, x);
    QFETCH(double, y);
    const imaging::ImageStack stack = stack_at({0, 3, 6, 9, 12}, {x, y});
    const imaging::GridPlan plan = imaging::plan_regular_grid(stack, {});
    QCOMPARE(plan.refusal, std::string());
    const glm::dvec2 moved(std::ceil(12.0 * std::abs(x) / 0.5), std::ceil(12.0 * std::abs(y) / 0.8));
    QCOMPARE(plan.geometry.size, Index3(20 + moved.x, 16 + moved.y, 5));
    for (std::size_t k = 0; k < 5; ++k) {
      const imaging::SliceShare& share = plan.slices[k][0];
      QCOMPARE(share.slice, static_cast<std::int64_t>(k));
      const glm::dvec3 first(share.shift, static_cast<double>(k));
      QVERIFY(glm::distance(plan.geometry.to_patient(first), stack.positions_mm[k]) < 1e-9);
    }
    QCOMPARE(glm::round(plan.slices[0][0].shift), plan.slices[0][0].shift);  // nothing of it is interpolated
    const double degrees = std::atan(std::hypot(x, y)) * 180.0 / glm::pi<double>();
    QVERIFY2(has(plan.changes.at(0), fmt::format("tilt of {:.1f} degrees", degrees).c_str()),
             plan.changes[0].c_str());

    const imaging::GridPlan kept = imaging::plan_regular_grid(stack, kKeep);
    QCOMPARE(kept.refusal, std::string());
    QVERIFY(kept.slices.empty());
    QCOMPARE(kept.geometry.size, stack.size);
    QVERIFY(has(kept.warnings.at(0), fmt::format("tilted by {:.1f} degrees", degrees).c_str()));
    for (const imaging::GridPlan& one : {plan, kept}) {
      const std::string said = fmt::format(
          "tilted by {:.1f} degrees: from the first slice to the last, slices "
          "move {:.2f} mm sideways.",
          degrees, 12.0 * std::hypot(x, y));
      QVERIFY2(has(one.tilt, said.c_str()), one.tilt.c_str());
    }
    QVERIFY(imaging::plan_regular_grid(stack_at({0, 3, 6}, {0.0, 0.0}), {}).tilt.empty());
  }

  void what_moves_sideways_otherwise_is_no_tilt() {
    imaging::ImageStack stack = stack_at({0, 3, 6, 9, 12}, {0.0, 0.3});
    stack.positions_mm[3] += 0.1 * stack.axes[0];
    for (const imaging::GridPolicy& policy : {imaging::GridPolicy(), kKeep}) {
      QVERIFY(has(imaging::plan_regular_grid(stack, policy).refusal, "unevenly: from s2 to s3"));
      const std::string steep = imaging::plan_regular_grid(stack_at({0, 3, 6}, {0.0, 1.5}), policy).refusal;
      QVERIFY2(has(steep, "56.3 degrees"), steep.c_str());
      QVERIFY(imaging::plan_regular_grid(stack, policy).tilt.empty());  // there is nothing to choose
    }
  }

  // Any places whatever: the shares of a slice add up to it and lie around it.
  void shares_are_where_the_grid_is() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> step(0.5, 4.0);
    for (int round = 0; round < 200; ++round) {
      Numbers along{0.0};
      for (int k = 0; k < 9; ++k) along << along.back() + (random() % 3 == 0 ? step(random) : 2.0);
      const imaging::ImageStack stack = stack_at(along, {0.1, round % 2 == 0 ? 0.0 : -0.2});
      const imaging::GridPlan plan = imaging::plan_regular_grid(stack, kFill);
      QCOMPARE(plan.refusal, std::string());
      for (std::size_t q = 0; q < plan.slices.size(); ++q) {
        const auto& [low, high] = plan.slices[q];
        QVERIFY(std::abs(low.weight + high.weight - 1.0) < 1e-12);
        const double place = low.weight * along[low.slice] + high.weight * along[high.slice];
        const double wanted = std::min(plan.geometry.spacing_mm.z * static_cast<double>(q), along.back());
        QVERIFY(std::abs(place - wanted) < 0.1 * plan.geometry.spacing_mm.z);
        for (const imaging::SliceShare& share : {low, high}) {
          QVERIFY(share.shift.x > -0.01 && share.shift.y > -0.01);
          const glm::dvec2 last = share.shift + glm::dvec2(stack.size) - 1.0;
          QVERIFY(last.x < static_cast<double>(plan.geometry.size.x) - 1.0 + 0.01);
          QVERIFY(last.y < static_cast<double>(plan.geometry.size.y) - 1.0 + 0.01);
        }
      }
      QVERIFY(std::abs(plan.geometry.spacing_mm.z * static_cast<double>(plan.slices.size() - 1) -
                       along.back()) <= 0.5 * plan.geometry.spacing_mm.z + 0.1);
    }
  }

  void a_ramp_is_the_same_on_every_grid_data() {
    QTest::addColumn<Numbers>("along");
    QTest::addColumn<double>("slope");
    QTest::newRow("tilt") << Numbers{0, 2, 4, 6, 8} << 0.33;
    QTest::newRow("missing") << Numbers{0, 2, 8, 10} << 0.0;
    QTest::newRow("uneven") << Numbers{0, 2, 4, 5, 8.5, 12} << 0.0;
    QTest::newRow("both") << Numbers{0, 2, 4, 5, 8.5, 12} << -0.33;
  }

  void a_ramp_is_the_same_on_every_grid() {
    QFETCH(Numbers, along);
    QFETCH(double, slope);
    const imaging::ImageStack stack = stack_at(along, {0.5 * slope, slope});
    const imaging::GridPlan plan = imaging::plan_regular_grid(stack, kFill);
    const auto ramp = [](glm::dvec3 mm) { return 400.0 + 11.0 * mm.x - 7.0 * mm.y + 5.0 * mm.z; };
    const auto exact = resampled(plan, stack, slices_of<float>(stack, ramp));
    const auto rounded = resampled(plan, stack, slices_of<std::int16_t>(stack, ramp));
    int compared = 0;
    for_each_voxel(plan.geometry, [&](Index3 voxel, std::size_t offset) {
      if (!is_covered(plan, stack, voxel, 0.0)) return;
      const double wanted = ramp(plan.geometry.to_patient(glm::dvec3(voxel)));
      QVERIFY(std::abs(static_cast<double>(exact[offset]) - wanted) < 1e-3);
      QVERIFY(std::abs(rounded[offset] - wanted) <= 1.0 + 1e-6);
      ++compared;
    });
    QVERIFY(compared > 1000);
  }

  void slices_that_are_there_stay_as_they_are() {
    const imaging::ImageStack stack = stack_at({0, 2, 8, 10});
    const imaging::GridPlan plan = imaging::plan_regular_grid(stack, kFill);
    std::mt19937 random(7);
    const auto noise = [&](glm::dvec3) { return static_cast<double>(random() % 60000); };
    const auto slices = slices_of<std::uint16_t>(stack, noise);
    const auto voxels = resampled(plan, stack, slices);
    const auto area = static_cast<std::ptrdiff_t>(stack.size.x * stack.size.y);
    for (const auto& [there, from] : {std::pair{0, 0}, {1, 1}, {4, 2}, {5, 3}}) {
      QVERIFY(std::equal(slices[static_cast<std::size_t>(from)].begin(),
                         slices[static_cast<std::size_t>(from)].end(), voxels.begin() + there * area));
    }
    for (std::ptrdiff_t v = 0; v < area; ++v) {
      const double low = slices[1][static_cast<std::size_t>(v)];
      const double high = slices[2][static_cast<std::size_t>(v)];
      QCOMPARE(static_cast<long>(voxels[static_cast<std::size_t>(2 * area + v)]),
               std::lround(low + (high - low) / 3.0));
    }
  }

  void a_ball_is_round_again_and_has_its_volume() {
    constexpr double kRadius = 17.0;
    Numbers along;
    for (int k = 0; k < 30; ++k) along << 1.5 * k;
    imaging::ImageStack stack = stack_at(along, {0.0, std::tan(20.0 * glm::pi<double>() / 180.0)});
    stack.size = {60, 90, 30};
    stack.spacing_mm = {0.8, 0.8};
    const glm::dvec3 centre = stack.positions_mm.front() + stack.axes * glm::dvec3(23.6, 43.6, 21.75);
    const auto ball = [&](glm::dvec3 mm) {
      return 1000.0 * std::clamp(0.5 + (kRadius - glm::distance(mm, centre)), 0.0, 1.0);
    };
    const imaging::GridPlan plan = imaging::plan_regular_grid(stack, {});
    const auto voxels = resampled(plan, stack, slices_of<std::int16_t>(stack, ball));
    double mass = 0.0;
    glm::dmat3 moments(0.0);
    for_each_voxel(plan.geometry, [&](Index3 voxel, std::size_t offset) {
      const glm::dvec3 from_centre = plan.geometry.to_patient(glm::dvec3(voxel)) - centre;
      mass += voxels[offset];
      moments += static_cast<double>(voxels[offset]) * glm::outerProduct(from_centre, from_centre);
    });
    const double volume = mass / 1000.0 * plan.geometry.voxel_volume_ml() * 1000.0;
    // Of the ball with its soft edge.
    const double wanted = 4.0 / 3.0 * glm::pi<double>() * (std::pow(kRadius, 3) + kRadius / 4.0);
    QVERIFY2(std::abs(volume / wanted - 1.0) < 0.005, qPrintable(QString::number(volume / wanted)));
    const double spread = kRadius * kRadius / 5.0;
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        const double relative = moments[a][b] / mass / spread;
        QVERIFY2(std::abs(relative - (a == b ? 1.0 : 0.0)) < 0.015, qPrintable(QString::number(relative)));
      }
    }
  }

  void beside_the_slices_is_background() {
    const imaging::ImageStack stack = stack_at({0, 3, 6}, {0.0, 0.5});
    const imaging::GridPlan plan = imaging::plan_regular_grid(stack, {});
    const auto slices = slices_of<std::int16_t>(stack, [](glm::dvec3) { return 70.0; });
    auto darker = slices;
    darker[1][0] = -5;
    for (const auto& [voxels, beside] :
         {std::pair{resampled<std::int16_t>(plan, stack, slices, std::int16_t{-1000}), -1000},
          {resampled<std::int16_t>(plan, stack, darker), -5}}) {
      QCOMPARE(voxels.back(), std::int16_t{70});  // the last slice is moved farthest
      QCOMPARE(voxels.front(), std::int16_t{70});
      QCOMPARE(int{voxels[static_cast<std::size_t>(plan.geometry.offset({3, 0, 2}))]}, beside);
      QCOMPARE(int{voxels[static_cast<std::size_t>(plan.geometry.offset({3, plan.geometry.size.y - 1, 0}))]},
               beside);
    }
  }

  void a_slice_that_cannot_be_decoded_ends_it() {
    const imaging::ImageStack stack = stack_at({0, 2, 8, 10});
    const imaging::GridPlan plan = imaging::plan_regular_grid(stack, kFill);
    std::vector<std::int16_t> voxels(static_cast<std::size_t>(plan.geometry.voxel_count()));
    const auto decode = [](std::int64_t k, std::int16_t*) { return k != 2; };
    QVERIFY(!imaging::resample_slices<std::int16_t>({plan, stack.size, decode, [] {}, {}}, voxels));
  }
};

TIDEMARK_TEST(RegularGridTest)

}  // namespace tidemark::test::regular_grid_test

#include "regular_grid_test.moc"
