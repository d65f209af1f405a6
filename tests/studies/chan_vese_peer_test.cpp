// The speed function `regions` against scikit-image's Chan-Vese, which shares no code with it, on slices.
#include <QProcess>
#include <cmath>
#include <fstream>
#include <memory>
#include <numeric>
#include <random>

#include "imaging/load_study.h"
#include "solver/executor.h"
#include "solver/speed/speed_registry.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::chan_vese_peer_test {

using namespace tidemark::solver;

namespace {

constexpr double kAlpha = 0.8;

std::shared_ptr<const Volume> slice_of(Index3 size, std::vector<float> values) {
  auto volume = std::make_shared<Volume>();
  volume->geometry.size = {size.x, size.y, 1};
  volume->voxels = std::move(values);
  return volume;
}

// A clover with a hole in noise.
std::shared_ptr<const Volume> clover() {
  constexpr std::int64_t kSide = 128;
  std::mt19937 random(5);
  std::vector<float> values;
  for (std::int64_t y = 0; y < kSide; ++y) {
    for (std::int64_t x = 0; x < kSide; ++x) {
      const double dx = static_cast<double>(x) - 63.5;
      const double dy = static_cast<double>(y) - 63.5;
      const double r = std::hypot(dx, dy);
      const bool inside = r > 9.0 && r < 38.0 + 12.0 * std::cos(3.0 * std::atan2(dy, dx));
      values.push_back((inside ? 60.0F : 20.0F) + static_cast<float>(random() % 51) - 25.0F);
    }
  }
  return slice_of({kSide, kSide, 1}, std::move(values));
}

// Soft tissue and fat, as a radiologist's window shows them.
std::shared_ptr<const Volume> abdomen() {
  auto study = imaging::load_volume(studies_folder() / "v04_ct_body_3mm" / "example_ct.nii.gz");
  if (!study) qFatal("%s", study.error().message.c_str());
  const Volume& volume = *study;
  const Index3 size = volume.geometry.size;
  std::vector<float> values;
  for (std::int64_t y = 0; y < size.y; ++y) {
    for (std::int64_t x = 0; x < size.x; ++x) {
      values.push_back(std::clamp(volume.value(Index3(x, y, size.z / 4)), -160.0F, 240.0F));
    }
  }
  return slice_of(size, std::move(values));
}

// > 0 in discs all over what is brighter than a level, so that the surface is near every border, and the
// inside is the brighter side from the start.
std::vector<float> discs(const Volume& slice, float level) {
  constexpr std::int64_t kApart = 9;
  const Index3 size = slice.geometry.size;
  std::vector<float> phi;
  for (std::int64_t y = 0; y < size.y; ++y) {
    for (std::int64_t x = 0; x < size.x; ++x) {
      const Index3 centre(std::min(x / kApart * kApart + kApart / 2, size.x - 1),
                          std::min(y / kApart * kApart + kApart / 2, size.y - 1), 0);
      const auto distance = std::hypot(static_cast<float>(x - centre.x), static_cast<float>(y - centre.y));
      phi.push_back(slice.value(centre) > level ? 3.0F - distance : -3.0F);
    }
  }
  return phi;
}

// The distance of the two mean brightnesses that share the values best, as a part of their range.
double contrast(const std::vector<float>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  double below = *low;
  double above = *high;
  for (int round = 0; round < 50; ++round) {
    double sums[2] = {0.0, 0.0};
    double counts[2] = {0.0, 0.0};
    for (const float value : values) {
      const int side = static_cast<double>(value) > 0.5 * (below + above) ? 1 : 0;
      sums[side] += static_cast<double>(value);
      ++counts[side];
    }
    below = sums[0] / counts[0];
    above = sums[1] / counts[1];
  }
  return (above - below) / static_cast<double>(*high - *low);
}

template <class T>
void write(const std::filesystem::path& file, const std::vector<T>& values) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(values.data()),
             static_cast<std::streamsize>(values.size() * sizeof(T)));
}

Mask by_peer(const Volume& slice, const std::vector<float>& phi, double mu) {
  const TemporaryFolder folder;
  const Index3 size = slice.geometry.size;
  write(folder / "image", slice.values());
  write(folder / "phi", phi);
  QProcess python;
  python.start("/usr/bin/python3", {TIDEMARK_CHAN_VESE, QString::fromStdString(folder.path().string()),
                                    QString::number(size.x), QString::number(size.y), QString::number(mu)});
  const bool ended = python.waitForFinished(300'000) && python.exitCode() == 0;
  if (!ended) {
    qFatal("scikit-image (package python3-skimage) cannot segment it: %s",
           python.readAllStandardError().constData());
  }
  Mask mask{slice.geometry, std::vector<std::uint8_t>(phi.size())};
  std::ifstream(folder / "mask", std::ios::binary)
      .read(reinterpret_cast<char*>(mask.voxels.data()), static_cast<std::streamsize>(mask.voxels.size()));
  return mask;
}

Mask by_regions(const std::shared_ptr<const Volume>& slice, const std::vector<float>& phi) {
  SpeedInputs inputs;
  inputs.source = slice;
  inputs.parameters.alpha = kAlpha;
  const auto speed = make_speed({{SpeedTerm{"regions", {}}}, Combine::least}, inputs);
  auto level_set = make_executor(ExecutorKind::host, slice, inputs.parameters);
  if (!speed || !level_set) qFatal("there is no level set");
  Executor& executor = **level_set;
  const bool ready = executor.restore(Field::from_dense(slice->geometry, phi, executor.band())).has_value() &&
                     executor.set_speed(*speed).has_value();
  Advance run;
  run.steps = 5000;
  run.until_converged = true;
  if (!ready || !executor.advance(run)) qFatal("the level set does not move");
  return executor.snapshot()->mask();
}

// The part that differs from the start.
double moved(const Mask& mask, const std::vector<float>& phi) {
  std::int64_t differing = 0;
  for (std::size_t i = 0; i < phi.size(); ++i) differing += (mask.voxels[i] != 0) != (phi[i] > 0.0F) ? 1 : 0;
  return static_cast<double>(differing) / static_cast<double>(phi.size());
}

}  // namespace

class ChanVesePeerTest : public QObject {
  Q_OBJECT

 private slots:
  void both_find_the_same_regions_data() {
    QTest::addColumn<bool>("study");
    QTest::newRow("clover in noise") << false;
    QTest::newRow("v04, soft tissue") << true;
  }

  // At rest scikit-image has mu kappa + (c_in - c_out)^2 D = 0 and this solver (1 - alpha) kappa + alpha D =
  // 0.
  void both_find_the_same_regions() {
    QFETCH(bool, study);
    const auto slice = study ? abdomen() : clover();
    const std::vector<float> values = slice->values();
    const float mean =
        std::accumulate(values.begin(), values.end(), 0.0F) / static_cast<float>(values.size());
    const auto phi = discs(*slice, mean);
    const double apart = contrast(values);
    const Mask ours = by_regions(slice, phi);
    const Mask theirs = by_peer(*slice, phi, apart * apart * (1.0 - kAlpha) / kAlpha);
    const double overlap = dice(ours, theirs);
    qInfo("Dice %.4f; %.0f %% of the voxels changed sides", overlap, 100.0 * moved(ours, phi));
    QVERIFY(moved(theirs, phi) > 0.2);
    QVERIFY(overlap >= 0.97);
  }
};

TIDEMARK_STUDY_TEST(ChanVesePeerTest)

}  // namespace tidemark::test::chan_vese_peer_test

#include "chan_vese_peer_test.moc"
