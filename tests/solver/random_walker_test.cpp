// The random walker: what strokes say of voxels that none of them covers.
#include <cmath>

#include "solver/speed/examples/random_walker.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::random_walker_test {

using namespace tidemark::solver;

namespace {

constexpr Index3 kGrid{41, 30, 24};

template <class Value>
std::shared_ptr<const Volume> image_of(glm::dvec3 spacing_mm, const Value& value) {
  auto volume = std::make_shared<Volume>();
  volume->geometry.size = kGrid;
  volume->geometry.spacing_mm = spacing_mm;
  std::vector<float> values;
  for (std::int64_t i = 0; i < volume->geometry.voxel_count(); ++i) {
    values.push_back(static_cast<float>(value(i % kGrid.x)));
  }
  volume->voxels = std::move(values);
  return volume;
}

// The first plane along x is inside, the last one outside.
Strokes plates() {
  Strokes strokes;
  for (std::int64_t row = 0; row < kGrid.y * kGrid.z; ++row) {
    strokes.inside.push_back(row * kGrid.x);
    strokes.outside.push_back(row * kGrid.x + kGrid.x - 1);
  }
  return strokes;
}

RandomWalker::Prior always(float probability) {
  return [probability](const WalkerGrid& grid, std::int64_t first, std::int64_t last, float* inside) {
    std::fill_n(inside, grid.size.x * grid.size.y * (last - first), probability);
  };
}

// Along x, in the middle of y and z.
std::vector<double> profile(const std::shared_ptr<const Volume>& image, const WalkerOptions& options,
                            const RandomWalker::Prior& prior) {
  const auto walker = RandomWalker::solve({image}, plates(), options, prior, {});
  if (!walker) qFatal("%s", walker.error().message.c_str());
  std::vector<double> inside(static_cast<std::size_t>(kGrid.x));
  walker->evaluate({{0, kGrid.y / 2, kGrid.z / 2}, {kGrid.x, 1, 1}}, inside.data());
  return inside;
}

double farthest(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

}  // namespace

class RandomWalkerTest : public QObject {
  Q_OBJECT
 private slots:
  // A walk between two walls ends at either with a probability that is linear in its place.
  void without_edges_it_is_linear_between_strokes_data() {
    QTest::addColumn<double>("thickness");
    QTest::addColumn<int>("cells");
    QTest::addColumn<double>("limit");
    QTest::newRow("cubes") << 1.0 << 1'000'000 << 0.02;
    QTest::newRow("thick slices") << 4.0 << 1'000'000 << 0.02;
    QTest::newRow("cells of several voxels") << 1.0 << 5'000 << 0.04;
  }
  void without_edges_it_is_linear_between_strokes() {
    QFETCH(double, thickness);
    QFETCH(int, cells);
    QFETCH(double, limit);
    const auto flat = image_of({1.0, 1.0, thickness}, [](std::int64_t) { return 7.0; });
    WalkerOptions options;
    options.prior = 1e-7;
    options.most_cells = cells;
    std::vector<double> linear;
    for (std::int64_t x = 0; x < kGrid.x; ++x) {
      linear.push_back(1.0 - static_cast<double>(x) / static_cast<double>(kGrid.x - 1));
    }
    const double off = farthest(profile(flat, options, always(0.5F)), linear);
    QVERIFY2(off < limit, qPrintable(QString::number(off)));
  }

  // Of a long chain u'' = prior (u - p): u falls off with the length 1 / sqrt(prior).
  void the_prior_decides_far_from_strokes() {
    const auto flat = image_of(glm::dvec3(1.0), [](std::int64_t) { return 7.0; });
    WalkerOptions options;
    options.prior = 0.25;
    options.caution = 0.0;
    const auto inside = profile(flat, options, always(0.3F));
    QVERIFY2(std::abs(inside[20] - 0.3) < 0.01, qPrintable(QString::number(inside[20])));
    // The chain's own rate: 2 cosh(k) = 2 + prior.
    const double rate = std::acosh(1.0 + 0.5 * options.prior);
    for (const std::size_t x : {1, 3, 6}) {
      const double expected = 0.3 + 0.7 * std::exp(-rate * static_cast<double>(x));
      QVERIFY2(std::abs(inside[x] - expected) < 0.01, qPrintable(QString::number(inside[x] - expected)));
    }
  }

  void doubt_counts_as_outside() {
    const auto flat = image_of(glm::dvec3(1.0), [](std::int64_t) { return 7.0; });
    WalkerOptions options;
    options.prior = 0.25;
    options.caution = 0.15;
    for (const auto& [prior, expected] : {std::pair(0.3F, 0.21), {0.5F, 0.35}, {0.9F, 0.87}, {0.0F, 0.0}}) {
      const auto inside = profile(flat, options, always(prior));
      QVERIFY2(std::abs(inside[20] - expected) < 0.01, qPrintable(QString::number(inside[20])));
    }
  }

  void an_edge_holds_walks_back() {
    const auto step = image_of(glm::dvec3(1.0), [](std::int64_t x) { return x < 12 ? 100.0 : 200.0; });
    WalkerOptions options;
    options.prior = 1e-5;
    const auto inside = profile(step, options, always(0.5F));
    QVERIFY2(inside[11] > 0.95, qPrintable(QString::number(inside[11])));
    QVERIFY2(inside[12] < 0.05, qPrintable(QString::number(inside[12])));
    options.contrast = 0.0;
    QVERIFY(profile(step, options, always(0.5F))[12] > 0.5);
  }

  void a_voxel_has_the_same_bits_in_every_box_and_every_run() {
    const auto waves = image_of(glm::dvec3(1.0), [](std::int64_t x) { return 20.0 * std::sin(0.7 * x); });
    WalkerOptions options;
    options.most_cells = 5'000;
    const auto first = RandomWalker::solve({waves}, plates(), options, always(0.4F), {});
    const auto second = RandomWalker::solve({waves}, plates(), options, always(0.4F), {});
    QVERIFY(first && second);
    const VoxelBox all{{0, 0, 0}, kGrid};
    std::vector<double> whole(static_cast<std::size_t>(all.voxels()));
    first->evaluate(all, whole.data());
    std::vector<double> alone(1);
    for (const Index3 voxel : {Index3(0, 0, 0), Index3(17, 11, 5), Index3(40, 29, 23)}) {
      second->evaluate({voxel, Index3(1)}, alone.data());
      QCOMPARE(alone[0], whole[static_cast<std::size_t>(waves->geometry.offset(voxel))]);
    }
  }

  void it_can_be_cancelled() {
    const auto flat = image_of(glm::dvec3(1.0), [](std::int64_t) { return 7.0; });
    std::stop_source stop;
    stop.request_stop();
    const auto walker = RandomWalker::solve({flat}, plates(), {}, always(0.5F), {nullptr, stop.get_token()});
    QVERIFY(!walker);
    QVERIFY(walker.error().kind == ErrorKind::cancelled);
  }

  void its_network_is_not_read_to_the_end_when_cancelled() {
    const auto flat = image_of(glm::dvec3(1.0), [](std::int64_t) { return 7.0; });
    const WalkerGrid grid = grid_around(plates(), flat->geometry, 1'000'000);
    ThreadPool threads;
    std::stop_source stop;
    const Progress progress{nullptr, stop.get_token()};
    QVERIFY(network_of({flat}, plates(), grid, 20.0, threads, progress));
    stop.request_stop();
    const auto network = network_of({flat}, plates(), grid, 20.0, threads, progress);
    QVERIFY(!network);
    QVERIFY(network.error().kind == ErrorKind::cancelled);
  }
};

TIDEMARK_TEST(RandomWalkerTest)

}  // namespace tidemark::test::random_walker_test

#include "random_walker_test.moc"
