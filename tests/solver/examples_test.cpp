// The speed function `examples`: features, the forest, and what it makes of strokes.
#include <cmath>
#include <latch>
#include <limits>
#include <random>
#include <thread>

#include "solver/speed/combined_speed.h"
#include "solver/speed/doubt_map.h"
#include "solver/speed/examples/examples_speed.h"
#include "solver/speed/examples/forest_training.h"
#include "solver/speed/examples/shared_by_volume.h"
#include "speed_functions.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::examples_test {

using namespace tidemark::solver;

namespace {

template <class Value>
std::shared_ptr<const Volume> volume_of(Index3 size, glm::dvec3 spacing_mm, const Value& value) {
  auto volume = std::make_shared<Volume>();
  volume->geometry.size = size;
  volume->geometry.spacing_mm = spacing_mm;
  std::vector<float> values;
  for (std::int64_t z = 0; z < size.z; ++z) {
    for (std::int64_t y = 0; y < size.y; ++y) {
      for (std::int64_t x = 0; x < size.x; ++x)
        values.push_back(static_cast<float>(value(glm::dvec3(x, y, z))));
    }
  }
  volume->voxels = std::move(values);
  return volume;
}

constexpr Index3 kGrid{63, 54, 45};
constexpr glm::dvec3 kCentre{31.0, 26.0, 22.0};
constexpr double kRadius = 16.0;

bool in_ball(glm::dvec3 p) {
  return glm::length(p - kCentre) < kRadius;
}

// The same mean inside and outside, and nearly the same values: fine mottle in a ball of coarse mottle.
std::shared_ptr<const Volume> two_textures() {
  return volume_of(kGrid, glm::dvec3(1.0), [](glm::dvec3 p) {
    const double wave = in_ball(p) ? 2.2 : 0.7;
    return 100.0 + 40.0 * std::sin(wave * p.x) * std::cos(wave * p.y + 0.3) * std::cos(wave * p.z);
  });
}

void add_disc(std::vector<std::int64_t>& stroke, Index3 centre) {
  for (std::int64_t y = -2; y <= 2; ++y) {
    for (std::int64_t x = -2; x <= 2; ++x) {
      const Index3 v = centre + Index3(x, y, 0);
      stroke.push_back(number_in(kGrid, v));
    }
  }
  std::sort(stroke.begin(), stroke.end());
}

std::shared_ptr<const Strokes> strokes_of_ball() {
  auto strokes = std::make_shared<Strokes>();
  for (const Index3 centre : {Index3(31, 26, 22), Index3(19, 26, 22), Index3(31, 38, 22), Index3(36, 21, 29),
                              Index3(28, 17, 12), Index3(31, 13, 22)}) {
    add_disc(strokes->inside, centre);
  }
  for (const Index3 centre :
       {Index3(6, 8, 5), Index3(52, 44, 38), Index3(50, 26, 22), Index3(31, 7, 20), Index3(12, 26, 22),
        Index3(31, 26, 41), Index3(20, 42, 24), Index3(31, 45, 22), Index3(31, 26, 3)}) {
    add_disc(strokes->outside, centre);
  }
  return strokes;
}

SpeedInputs inputs_of(std::shared_ptr<const Volume> volume) {
  SpeedInputs inputs;
  inputs.source = std::move(volume);
  inputs.strokes = strokes_of_ball();
  return inputs;
}

}  // namespace

class ExamplesTest : public QObject {
  Q_OBJECT
 private slots:
  void features_of_a_quadratic_are_its_derivatives();
  void deviation_is_that_of_noise();
  void moments_are_small_and_exact_data();
  void moments_are_small_and_exact();
  void features_follow_the_units_of_values_and_lengths_data();
  void features_follow_the_units_of_values_and_lengths();
  void features_have_the_same_bits_in_every_box();
  void a_value_that_overflows_reaches_the_same_voxels_in_every_box();
  void what_is_no_number_goes_the_same_way_in_training_and_in_every_box();
  void speed_has_the_same_bits_in_every_box_and_every_training();
  void textures_that_no_tent_separates_are_separated();
  void doubt_is_the_entropy_of_the_probability();
  void a_second_image_counts();
  void strokes_of_one_kind_are_refused_data();
  void strokes_of_one_kind_are_refused();
  void an_image_on_another_grid_is_refused();
  void training_can_be_cancelled();
  void a_pyramid_is_shared_and_goes_with_its_users();
  void a_pyramid_is_not_waited_for_once_asked_to_stop();
  void who_waits_makes_what_was_not_made();
};

void ExamplesTest::features_of_a_quadratic_are_its_derivatives() {
  // The Gaussian adds a constant to it. Its second derivatives, sorted, are 0.6, 0.2 and -0.4 per mm^2.
  const glm::dvec3 spacing(1.0, 1.25, 2.0);
  const glm::dvec3 middle(64.0, 60.0, 64.0);  // mm
  const auto volume = volume_of({129, 97, 65}, spacing, [&](glm::dvec3 voxel) {
    const glm::dvec3 p = voxel * spacing - middle;
    return 0.3 * p.x * p.x - 0.2 * p.y * p.y + 0.1 * p.z * p.z;
  });
  const auto features = Features::of({volume}, {});
  QCOMPARE(failure(features), QString());
  const Index3 voxel(70, 52, 35);
  const glm::dvec3 p = glm::dvec3(voxel) * spacing - middle;
  const double gradient_length = glm::length(glm::dvec3(0.6 * p.x, -0.4 * p.y, 0.2 * p.z));
  std::vector<float> values(static_cast<std::size_t>(features->count()));
  features->evaluate({voxel, Index3(1)}, values.data());
  QCOMPARE(features->count(), 5 * kNodeFeatures + 3);
  for (int scale = 0; scale < 3; ++scale) {  // those that do not reach the border
    const float* f = values.data() + scale * kNodeFeatures;
    QVERIFY2(std::abs(f[hessian_largest] - 0.6) < 0.01, qPrintable(QString::number(f[hessian_largest])));
    QVERIFY2(std::abs(f[hessian_middle] - 0.2) < 0.01, qPrintable(QString::number(f[hessian_middle])));
    QVERIFY2(std::abs(f[hessian_smallest] + 0.4) < 0.01, qPrintable(QString::number(f[hessian_smallest])));
    // Interpolated between nodes, the magnitude is a little more than at the voxel.
    QVERIFY2(std::abs(f[gradient] - gradient_length) < 0.05 * gradient_length,
             qPrintable(QString::number(f[gradient])));
    QVERIFY(f[structure_largest] >= f[structure_middle] && f[structure_middle] >= f[structure_smallest]);
    QVERIFY(f[structure_largest] > 0.9F * f[gradient]);
  }
  const float* position = values.data() + 5 * kNodeFeatures;
  QCOMPARE(position[0], 70.0F);
  QCOMPARE(position[1], 65.0F);
  QCOMPARE(position[2], 70.0F);
}

void ExamplesTest::deviation_is_that_of_noise() {
  const auto flat = volume_of({64, 64, 64}, glm::dvec3(0.5), [](glm::dvec3) { return 1000.0; });
  const auto noisy = with_noise(flat, 12.0);
  const auto features = Features::of({noisy}, {});
  QCOMPARE(failure(features), QString());
  std::vector<float> values(static_cast<std::size_t>(features->count()));
  features->evaluate({Index3(32), Index3(1)}, values.data());
  for (int scale = 2; scale < 4; ++scale) {
    const float measured = values[static_cast<std::size_t>(scale * kNodeFeatures + deviation)];
    QVERIFY2(std::abs(measured - 12.0F) < 1.5F, qPrintable(QString::number(measured)));
  }
}

void ExamplesTest::moments_are_small_and_exact_data() {
  QTest::addColumn<double>("slice_mm");
  QTest::addColumn<double>("outlier");
  QTest::addColumn<double>("bytes_a_voxel");
  QTest::newRow("even") << 1.0 << 0.0 << 0.7;
  QTest::newRow("thick slices") << 5.0 << 0.0 << 1.6;
  QTest::newRow("a value far out") << 1.0 << 1e8 << 0.7;
}

void ExamplesTest::moments_are_small_and_exact() {
  QFETCH(const double, slice_mm);
  QFETCH(const double, outlier);
  QFETCH(const double, bytes_a_voxel);
  // The mean of a ramp is the ramp, and its deviation sigma times its slope.
  constexpr Index3 kSize(96, 96, 64);
  const auto volume = volume_of(kSize, {1.0, 1.0, slice_mm}, [&](glm::dvec3 p) {
    return p == glm::dvec3(95.0, 95.0, 63.0) ? outlier : 2.0 * p.x;
  });
  const auto space = ScaleSpace::of(volume, {});
  QCOMPARE(failure(space), QString());
  const double voxels = static_cast<double>(volume->geometry.voxel_count());
  QVERIFY2(static_cast<double>((*space)->memory()) < bytes_a_voxel * voxels,
           qPrintable(QString::number((*space)->memory())));
  const auto [low, high] = volume->common_range();
  for (int scale = 1; scale < 3; ++scale) {
    const Index3 step = (*space)->step(scale);
    const Index3 node(40 / step.x, 40 / step.y, 30 / step.z);
    const Moments moments = (*space)->moments(*volume, scale, {node, Index3(1)});
    const double mean = moments.mean[0] + 0.5 * (low + high);
    const double deviation = std::sqrt(moments.square[0] - moments.mean[0] * moments.mean[0]);
    const double sigma = kPyramidScales[scale - 1];
    QVERIFY2(std::abs(mean - 2.0 * static_cast<double>(node.x * step.x)) < 0.1,
             qPrintable(QString::number(mean)));
    QVERIFY2(std::abs(deviation - 2.0 * sigma) < 0.1 * sigma, qPrintable(QString::number(deviation)));
  }
}

void ExamplesTest::features_have_the_same_bits_in_every_box() {
  const auto features = Features::of({two_textures()}, {});
  QCOMPARE(failure(features), QString());
  const auto count = static_cast<std::size_t>(features->count());
  std::mt19937 random(5);
  for (int i = 0; i < 40; ++i) {
    VoxelBox box;
    for (int axis = 0; axis < 3; ++axis) {
      box.first[axis] = std::uniform_int_distribution<std::int64_t>(0, kGrid[axis] - 1)(random);
      box.size[axis] = std::min<std::int64_t>(kGrid[axis] - box.first[axis], 1 + i % 9);
    }
    std::vector<float> in_box(count * static_cast<std::size_t>(box.voxels()));
    features->evaluate(box, in_box.data());
    const Index3 last = box.size - Index3(1);
    std::vector<float> alone(count);
    features->evaluate({box.first + last, Index3(1)}, alone.data());
    for (std::size_t f = 0; f < count; ++f) {
      QCOMPARE(in_box[(f + 1) * static_cast<std::size_t>(box.voxels()) - 1], alone[f]);
    }
  }
}

// Their powers grow beyond a float, or vanish, where one does not watch out.
void ExamplesTest::features_follow_the_units_of_values_and_lengths_data() {
  QTest::addColumn<double>("step");
  QTest::addColumn<double>("spacing_mm");
  QTest::newRow("counts in voxels of a micrometre") << 0x1p15 << 0x1p-10;
  QTest::newRow("the largest gradients") << 0x1p24 << 0x1p-16;
  QTest::newRow("small numbers") << 0x1p-20 << 1.0;
}

void ExamplesTest::features_follow_the_units_of_values_and_lengths() {
  QFETCH(const double, step);
  QFETCH(const double, spacing_mm);
  constexpr VoxelBox kRow{{12, 12, 12}, {16, 1, 1}};
  const auto of_an_edge = [&](double values, double lengths) {
    const auto volume =
        volume_of({40, 24, 24}, glm::dvec3(lengths), [&](glm::dvec3 p) { return p.x < 20.0 ? 0.0 : values; });
    const auto features = Features::of({volume}, {}).value();
    std::vector<float> found(static_cast<std::size_t>(features.count() * kRow.voxels()));
    features.evaluate(kRow, found.data());
    return found;
  };
  const std::vector<float> plain = of_an_edge(1.0, 1.0);
  const std::vector<float> found = of_an_edge(step, spacing_mm);
  const double a_mm = step / spacing_mm;
  const double a_mm2 = a_mm / spacing_mm;
  const double units[kNodeFeatures] = {step, step, a_mm, a_mm2, a_mm2, a_mm2, a_mm, a_mm, a_mm};
  for (int f = 0; f < 5 * kNodeFeatures; ++f) {
    const double unit = units[f % kNodeFeatures];
    for (std::int64_t i = 0; i < kRow.voxels(); ++i) {
      const auto at = static_cast<std::size_t>(f * kRow.voxels() + i);
      // What is not a number is not below anything.
      QVERIFY2(std::abs(found[at] / unit - plain[at]) <= 1e-5,
               qPrintable(QStringLiteral("feature %1 of voxel %2: %3, not %4")
                              .arg(f)
                              .arg(i)
                              .arg(found[at] / unit)
                              .arg(plain[at])));
    }
  }
}

void ExamplesTest::a_value_that_overflows_reaches_the_same_voxels_in_every_box() {
  const auto volume = std::make_shared<Volume>(*two_textures());
  constexpr Index3 kFar(31, 26, 22);
  std::get<std::vector<float>>(volume->voxels)[static_cast<std::size_t>(number_in(kGrid, kFar))] = 1e38F;
  const auto features = Features::of({volume}, {});
  QCOMPARE(failure(features), QString());
  const auto count = static_cast<std::size_t>(features->count());
  for (int axis = 0; axis < 3; ++axis) {
    VoxelBox line{kFar, Index3(1)};
    line.first[axis] -= 12;
    line.size[axis] = 20;
    std::vector<float> in_line(count * 20);
    features->evaluate(line, in_line.data());
    for (std::size_t i = 0; i < 20; ++i) {
      Index3 voxel = line.first;
      voxel[axis] += static_cast<std::int64_t>(i);
      std::vector<float> alone(count);
      features->evaluate({voxel, Index3(1)}, alone.data());
      for (std::size_t f = 0; f < count; ++f) {
        const float here = in_line[f * 20 + i];
        const bool same = here == alone[f] || (std::isnan(here) && std::isnan(alone[f]));
        QVERIFY2(same, qPrintable(QStringLiteral("feature %1 of voxel %2 along axis %3: %4, alone %5")
                                      .arg(f)
                                      .arg(i)
                                      .arg(axis)
                                      .arg(here)
                                      .arg(alone[f])));
      }
    }
  }
}

void ExamplesTest::what_is_no_number_goes_the_same_way_in_training_and_in_every_box() {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  Samples samples{1, {}, {}};
  for (int i = 0; i < 100; ++i) {
    samples.values.push_back(i < 50 ? static_cast<float>(i) : kNone);
    samples.inside.push_back(i < 50 ? 1 : 0);
  }
  const auto forest = train(samples, {}, {});
  QCOMPARE(failure(forest), QString());
  const auto inside = [&](std::vector<float> values) {
    std::vector<double> found(values.size());
    ForestEvaluator(*forest).evaluate(values.data(), 1, std::ssize(values), found.data());
    return found;
  };
  const double none = inside({kNone}).front();
  QVERIFY2(none < 0.3, qPrintable(QString::number(none)));
  const double least = inside({0.0F}).front();
  QVERIFY2(least > 0.75, qPrintable(QString::number(least)));
  QVERIFY(inside({0.0F, kNone}) == (std::vector<double>{least, none}));
  QVERIFY(inside({kNone, 0.0F}) == (std::vector<double>{none, least}));
  QVERIFY(inside({0.0F, kNone, 0.0F}) == (std::vector<double>{least, none, least}));
  QCOMPARE(inside({60.0F, kNone, 70.0F})[1], none);
}

void ExamplesTest::speed_has_the_same_bits_in_every_box_and_every_training() {
  const SpeedInputs inputs = inputs_of(two_textures());
  const auto first = uncached(inputs, "examples");
  QVERIFY(same_in_every_box(*first, kGrid));
  const SpeedInputs again = inputs_of(two_textures());  // other objects, the same values
  const auto second = uncached(again, "examples");
  QVERIFY(speeds(*first, {Index3(0), kGrid}) == speeds(*second, {Index3(0), kGrid}));
}

void ExamplesTest::textures_that_no_tent_separates_are_separated() {
  const auto volume = two_textures();
  // Mottle is full of edges, and between them the forest decides.
  const auto function = uncached(inputs_of(volume), "examples", {{"edges", 100.0}});
  const auto speed = speeds(*function, {Index3(0), kGrid});
  Mask found{volume->geometry, {}};
  Mask truth = found;
  Mask bright = found;
  for (std::int64_t i = 0; i < volume->geometry.voxel_count(); ++i) {
    const glm::dvec3 p(i % kGrid.x, i / kGrid.x % kGrid.y, i / (kGrid.x * kGrid.y));
    truth.voxels.push_back(in_ball(p) ? 1 : 0);
    found.voxels.push_back(speed[static_cast<std::size_t>(i)] > 0.0 ? 1 : 0);
    bright.voxels.push_back(std::abs(volume->value(i) - 100.0F) < 20.0F ? 1 : 0);
  }
  QVERIFY2(dice(found, truth) >= 0.95, qPrintable(QString::number(dice(found, truth))));
  QVERIFY2(dice(bright, truth) < 0.3, qPrintable(QString::number(dice(bright, truth))));
}

void ExamplesTest::doubt_is_the_entropy_of_the_probability() {
  const SpeedInputs inputs = inputs_of(two_textures());
  const auto speed_with = [&](double sharpness) {
    return make_speed(setting_of("examples", {{"sharpness", sharpness}}), inputs).value();
  };
  const auto edges = make_speed(setting_of("edges"), inputs).value();
  const VoxelBox slice{{0, 0, 22}, {kGrid.x, kGrid.y, 1}};
  const auto doubt_of = [&](const SpeedFunction& speed) {
    std::vector<double> doubt(static_cast<std::size_t>(slice.voxels()));
    speed.evaluate_doubt(slice, doubt.data());
    return doubt;
  };
  const auto plain = speed_with(1.0);  // D = 2 p - 1
  QVERIFY(plain->has_doubt());
  const std::vector<double> doubt = doubt_of(*plain);
  std::vector<double> speed(doubt.size());
  plain->evaluate(slice, speed.data());
  double near = 0.0;
  std::int64_t near_count = 0;
  double far = 0.0;
  for (std::size_t i = 0; i < doubt.size(); ++i) {
    const double p = 0.5 * (speed[i] + 1.0);
    // D is rounded, and the entropy is steep where it is sure.
    QVERIFY(std::abs(doubt[i] - entropy(p)) < 1e-3);
    QVERIFY(doubt[i] >= 0.0 && doubt[i] <= 1.0);
    const auto offset = static_cast<std::int64_t>(i);
    const double border =
        std::abs(glm::length(glm::dvec3(offset % kGrid.x, offset / kGrid.x, 22) - kCentre) - kRadius);
    if (border < 2.0) {
      near += doubt[i];
      ++near_count;
    } else {
      far += doubt[i];
    }
  }
  near /= static_cast<double>(near_count);
  far /= static_cast<double>(static_cast<std::int64_t>(doubt.size()) - near_count);
  QVERIFY2(near > 1.5 * far, qPrintable(QStringLiteral("%1 and %2").arg(near).arg(far)));
  // What sharpness makes of p changes nothing; nor do functions without a doubt.
  const auto sharp = speed_with(8.0);
  QVERIFY(doubt_of(*sharp) == doubt);
  const CombinedSpeed joined({edges, sharp}, Combine::least);
  QVERIFY(joined.has_doubt());
  QVERIFY(doubt_of(joined) == doubt);
  QVERIFY(doubt_map(edges) == nullptr);
  QCOMPARE(entropy(0.5), 1.0);
  QCOMPARE(entropy(0.0), 0.0);
  QCOMPARE(entropy(1.0), 0.0);
}

void ExamplesTest::a_second_image_counts() {
  const auto flat = with_noise(volume_of(kGrid, glm::dvec3(1.0), [](glm::dvec3) { return 50.0; }), 5.0);
  SpeedInputs inputs = inputs_of(flat);
  const auto difference = [&] {
    const auto function = uncached(inputs, "examples", {{"sharpness", 1.0}});
    // Neither voxel is in a stroke.
    return speed_at(*function, {28, 23, 18}) - speed_at(*function, {31, 49, 22});
  };
  const double alone = difference();
  inputs.images = {
      volume_of(kGrid, glm::dvec3(1.0), [](glm::dvec3 p) { return in_ball(p) ? 300.0 : 200.0; })};
  QVERIFY2(difference() > alone + 0.3, qPrintable(QString::number(alone)));
}

void ExamplesTest::strokes_of_one_kind_are_refused_data() {
  QTest::addColumn<bool>("inside");
  QTest::newRow("inside") << true;
  QTest::newRow("outside") << false;
}

void ExamplesTest::strokes_of_one_kind_are_refused() {
  QFETCH(bool, inside);
  SpeedInputs inputs = inputs_of(two_textures());
  auto strokes = std::make_shared<Strokes>(*inputs.strokes);
  (inside ? strokes->outside : strokes->inside).clear();
  inputs.strokes = strokes;
  const auto made = make_speed(setting_of("examples"), inputs);
  QVERIFY(!made);
  QVERIFY(made.error().kind == ErrorKind::usage);
  QCOMPARE(failure(made), QString("examples: paint at least one stroke %1 of what is to be found")
                              .arg(inside ? "outside" : "inside"));
}

void ExamplesTest::an_image_on_another_grid_is_refused() {
  SpeedInputs inputs = inputs_of(two_textures());
  inputs.images = {volume_of({9, 8, 7}, glm::dvec3(1.0), [](glm::dvec3) { return 1.0; })};
  const auto made = make_speed(setting_of("examples"), inputs);
  QCOMPARE(failure(made), QString("examples: an image has 9 x 8 x 7 voxels, the volume 63 x 54 x 45"));
}

void ExamplesTest::training_can_be_cancelled() {
  std::stop_source stop;
  stop.request_stop();
  const auto made =
      make_speed(setting_of("examples"), inputs_of(two_textures()), {nullptr, stop.get_token()});
  QVERIFY(!made);
  QVERIFY(made.error().kind == ErrorKind::cancelled);
  // What was given up leaves nothing behind that is wrong.
  Samples samples{1, {}, {}};
  for (int i = 0; i < 100; ++i) {
    samples.values.push_back(static_cast<float>(i));
    samples.inside.push_back(i < 50 ? 1 : 0);
  }
  QVERIFY(train(samples, {}, {nullptr, stop.get_token()}).error().kind == ErrorKind::cancelled);
  const auto forest = train(samples, {}, {});
  QCOMPARE(failure(forest), QString());
  const float ends[] = {0.0F, 99.0F};
  double inside[2];
  ForestEvaluator(*forest).evaluate(ends, 1, 2, inside);
  QVERIFY(inside[0] > 0.75 && inside[1] < 0.25);
}

void ExamplesTest::a_pyramid_is_shared_and_goes_with_its_users() {
  const auto volume = two_textures();
  auto first = ScaleSpace::of(volume, {});
  QCOMPARE(failure(first), QString());
  auto second = ScaleSpace::of(volume, {});
  QVERIFY(*first == *second);
  const std::weak_ptr<const ScaleSpace> watched = *first;
  *first = nullptr;
  QVERIFY(!watched.expired());
  *second = nullptr;
  QVERIFY(watched.expired());
}

void ExamplesTest::a_pyramid_is_not_waited_for_once_asked_to_stop() {
  using Number = std::shared_ptr<const int>;
  SharedByVolume<int> numbers;
  const auto make = [](int number) {
    return [number]() -> Result<Number> { return std::make_shared<const int>(number); };
  };
  const auto volume = std::make_shared<const Volume>();
  std::latch begun(1);
  std::latch may_end(1);
  Result<Number> slow;
  std::jthread maker([&] {
    slow = numbers.of(volume, {}, [&]() -> Result<Number> {
      begun.count_down();
      may_end.wait();
      return std::make_shared<const int>(1);
    });
  });
  begun.wait();
  // Nothing here may wait for the other thread.
  const auto other = numbers.of(std::make_shared<const Volume>(), {}, make(2));
  std::stop_source stop;
  Result<Number> cancelled;
  std::jthread waiter([&] { cancelled = numbers.of(volume, stop.get_token(), make(3)); });
  stop.request_stop();
  waiter.join();
  const auto cancelled_before = numbers.of(volume, stop.get_token(), make(4));
  may_end.count_down();
  const auto waited = numbers.of(volume, {}, make(5));
  maker.join();
  QCOMPARE(failure(other), QString());
  QCOMPARE(**other, 2);
  QVERIFY(!cancelled && cancelled.error().kind == ErrorKind::cancelled);
  QVERIFY(!cancelled_before && cancelled_before.error().kind == ErrorKind::cancelled);
  QCOMPARE(failure(waited), QString());
  QCOMPARE(**waited, 1);
  QVERIFY(*waited == *slow);
  QCOMPARE(ScaleSpace::of(two_textures(), {nullptr, stop.get_token()}).error().kind, ErrorKind::cancelled);
}

void ExamplesTest::who_waits_makes_what_was_not_made() {
  using Number = std::shared_ptr<const int>;
  SharedByVolume<int> numbers;
  const auto volume = std::make_shared<const Volume>();
  std::latch begun(1);
  Result<Number> failed;
  std::jthread maker([&] {
    failed = numbers.of(volume, {}, [&]() -> Result<Number> {
      begun.count_down();
      return cancelled_error();
    });
  });
  begun.wait();
  const auto made = numbers.of(volume, {}, []() -> Result<Number> { return std::make_shared<const int>(7); });
  maker.join();
  QVERIFY(!failed && failed.error().kind == ErrorKind::cancelled);
  QCOMPARE(failure(made), QString());
  QCOMPARE(**made, 7);
}

TIDEMARK_TEST(ExamplesTest)

}  // namespace tidemark::test::examples_test

#include "examples_test.moc"
