// Executors agree: T5 of the numerics, threads, chunks, instruction sets, saving and resuming.
#include <cstdlib>
#include <random>

#include "level_sets.h"
#include "solver/paging/page_table.h"
#include "solver/reference/reference_executor.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

using namespace tidemark;
using namespace tidemark::test;

namespace {

struct Setting {
  std::shared_ptr<const Volume> source;
  Parameters parameters;
};

// A lumpy source with noise, random parameters and random spacing. Braces fix the order in which the numbers
// are drawn, which compilers choose for arguments in parentheses.
Setting random_setting(std::mt19937& random) {
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (random() / 4294967296.0);
  };
  Setting setting;
  const Index3 size{random() % 20 + 20, random() % 20 + 20, random() % 16 + 12};
  const glm::dvec3 spacing{uniform(0.4, 1.2), uniform(0.4, 1.2), random() % 2 == 0 ? 1.0 : uniform(0.8, 3.0)};
  const Geometry geometry = grid(size, spacing);
  const glm::dvec3 a{uniform(0.1, 0.5), uniform(0.1, 0.5), uniform(0.1, 0.5)};
  const glm::dvec3 b{uniform(0, 6), uniform(0, 6), uniform(0, 6)};
  const double noise = uniform(0, 20);
  setting.source = volume_of(geometry, [&](glm::dvec3 p) {
    return 100.0 + 80.0 * std::sin(a.x * p.x + b.x) * std::sin(a.y * p.y + b.y) * std::sin(a.z * p.z + b.z) +
           uniform(-noise, noise);
  });
  Parameters& p = setting.parameters;
  p.target = uniform(60, 160);
  p.range = uniform(5, 80);
  p.alpha = random() % 8 == 0 ? (random() % 2 == 0 ? 0.0 : 1.0) : uniform(0, 1);
  p.scheme = random() % 4 == 0 ? Scheme::paper : Scheme::split;
  p.data_form = random() % 4 == 0 ? DataForm::raw : DataForm::clamped;
  p.data_term = random() % 8 != 0;
  p.curvature_term = random() % 8 != 0;
  return setting;
}

void seed(Executor& level_set, const Geometry& geometry, std::mt19937& random) {
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 voxel{random() % static_cast<unsigned>(geometry.size.x),
                           random() % static_cast<unsigned>(geometry.size.y),
                           random() % static_cast<unsigned>(geometry.size.z)};
    const auto brush = i == 2 ? Brush::erase : Brush::add;
    const double radius = 2.0 + random() % 6;
    if (!level_set.paint(sphere_at_voxel(geometry, voxel, radius), brush)) qFatal("paint failed");
  }
}

// Whether a voxel's six one-sided differences are all zero.
bool is_flat(const std::vector<double>& phi, const Geometry& g, Index3 v) {
  const double here = phi[static_cast<std::size_t>(g.offset(v))];
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      Index3 other = v;
      other[axis] = std::clamp<std::int64_t>(v[axis] + side, 0, g.size[axis] - 1);
      if (phi[static_cast<std::size_t>(g.offset(other))] != here) return false;
    }
  }
  return true;
}

bool resident_pages_cover_what_is_not_flat(const Field& field, const std::vector<double>& phi) {
  const Geometry& g = field.geometry;
  for (std::int64_t i = 0; i < g.voxel_count(); ++i) {
    const Index3 v(i % g.size.x, i / g.size.x % g.size.y, i / (g.size.x * g.size.y));
    const std::int64_t page = field.layout.translate(v).page;
    if (field.table[static_cast<std::size_t>(page)] < 0 && !is_flat(phi, g, v)) return false;
  }
  return true;
}

// The tumour phantom's like in small, with a seed.
struct Evolution {
  Geometry geometry = grid({61, 47, 40}, {1.0, 1.0, 1.0});
  std::shared_ptr<const Volume> source = volume_of(geometry, [this](glm::dvec3 p) {
    const double r = glm::distance(p, centre_of(geometry));
    return 100.0 - 6.0 * std::max(0.0, r - 12.0 - 2.0 * std::sin(p.x / 3.0)) + 5.0 * std::sin(p.y * 7.0);
  });
  Parameters parameters = [] {
    Parameters p;
    p.target = 100.0;
    p.range = 25.0;
    p.alpha = 0.6;
    return p;
  }();

  std::unique_ptr<Executor> start(ExecutorKind kind, int threads) const {
    ExecutorOptions options;
    options.threads = threads;
    auto level_set = executor(kind, source, parameters, options);
    if (!level_set->paint({centre_of(geometry), 5.0}, Brush::add)) qFatal("paint failed");
    return level_set;
  }
};

bool same_bits(const Field& a, const Field& b) {
  return a.table == b.table && a.pages == b.pages;
}

}  // namespace

class AgreementTest : public QObject {
  Q_OBJECT

 private slots:
  void each_step_of_the_host_is_the_references_step() {  // T5
    std::mt19937 random(7);
    double worst = 0.0;
    for (int trial = 0; trial < 80; ++trial) {
      const Setting setting = random_setting(random);
      const Geometry& geometry = setting.source->geometry;
      ExecutorOptions options;
      options.skip_quiet_pages = false;
      const auto host = executor(ExecutorKind::host, setting.source, setting.parameters, options);
      ReferenceExecutor reference(setting.source, setting.parameters);
      seed(*host, geometry, random);
      for (int step = 0; step < 8; ++step) {
        run(*host, 3);  // some way between the comparisons
        QCOMPARE(failure(reference.restore(host->snapshot().value())), QString());
        run(*host, 1);
        QVERIFY(reference.advance({}));
        const Field phi = host->snapshot().value();
        worst = std::max(worst, largest_difference(phi.dense(), reference.values()));
        QVERIFY2(worst <= 1e-5, qPrintable(QString("trial %1: %2").arg(trial).arg(worst)));
        QVERIFY(resident_pages_cover_what_is_not_flat(phi, reference.values()));
        QCOMPARE(failure(host->validate()), QString());
      }
    }
    qInfo("T5: largest difference of a step %.1e in 640 steps of 80 settings", worst);
  }

  // No evolution gets so far from a distance transform: steep everywhere, with tiny values beside large ones.
  void a_step_from_a_field_of_noise_is_the_references_step() {  // T5
    std::mt19937 random(11);
    const auto uniform = [&] { return 2.0 * (random() / 4294967296.0) - 1.0; };
    double worst = 0.0;
    for (int trial = 0; trial < 80; ++trial) {
      const Setting setting = random_setting(random);
      const Geometry& geometry = setting.source->geometry;
      const auto host = executor(ExecutorKind::host, setting.source, setting.parameters);
      ReferenceExecutor reference(setting.source, setting.parameters);
      set_phi(*host, geometry, [&](glm::dvec3) { return host->band() * std::pow(uniform(), 5.0); });
      QCOMPARE(failure(reference.restore(host->snapshot().value())), QString());
      run(*host, 1);
      QVERIFY(reference.advance({}));
      const std::vector<float> values = host->snapshot().value().dense();
      worst = std::max(worst, largest_difference(values, reference.values()) / host->band());
    }
    qInfo("T5: largest difference of a step from noise %.1e of the band in 80 settings", worst);
    QVERIFY(worst <= 1e-5);
  }

  void free_runs_end_in_the_same_mask() {  // T5
    const Evolution evolution;
    const auto host = evolution.start(ExecutorKind::host, 2);
    const auto reference = evolution.start(ExecutorKind::reference, 1);
    run(*host, 500);
    run(*reference, 500);
    const double overlap = dice(host->snapshot().value().mask(), reference->snapshot().value().mask());
    qInfo("T5: Dice after 500 steps %.5f", overlap);
    QVERIFY(overlap >= 0.999);
    QVERIFY(host->snapshot().value().mask().count() > 5000);
  }

  void the_bits_do_not_depend_on_threads_or_chunks() {
    const Evolution evolution;
    const auto expected = evolution.start(ExecutorKind::host, 1);
    run(*expected, 210);
    const Field phi = expected->snapshot().value();
    for (const int threads : {2, 5}) {
      const auto other = evolution.start(ExecutorKind::host, threads);
      run(*other, 210);
      QVERIFY(same_bits(phi, other->snapshot().value()));
    }
    for (const int chunk : {1, 7, 30}) {
      const auto other = evolution.start(ExecutorKind::host, 2);
      for (int done = 0; done < 210; done += chunk) run(*other, chunk);
      QVERIFY(same_bits(phi, other->snapshot().value()));
    }
  }

  void instruction_sets_agree() {
    const Evolution evolution;
    std::vector<Mask> masks;
    std::vector<std::string> names;
    for (const char* name : {"sse4", "avx2", "avx512"}) {
      qputenv("TIDEMARK_SIMD", name);
      const auto made = make_executor(ExecutorKind::host, evolution.source, evolution.parameters);
      if (!made) {
        // This processor lacks it: the reason says so, and nothing else may fail.
        QCOMPARE(made.error().kind, ErrorKind::capability);
        qWarning("%s", made.error().message.c_str());
        continue;
      }
      QVERIFY((*made)->paint({centre_of(evolution.geometry), 5.0}, Brush::add));
      run(**made, 300);
      masks.push_back((*made)->snapshot().value().mask());
      names.emplace_back(name);
    }
    qunsetenv("TIDEMARK_SIMD");
    QVERIFY(!masks.empty());
    for (std::size_t i = 1; i < masks.size(); ++i) {
      const double overlap = dice(masks[0], masks[i]);
      qInfo("Dice %s against %s: %.5f", names[0].c_str(), names[i].c_str(), overlap);
      QVERIFY(overlap >= 0.999);
    }
  }

  void an_unknown_instruction_set_is_a_usage_error() {
    qputenv("TIDEMARK_SIMD", "mmx");
    const Evolution evolution;
    const auto made = make_executor(ExecutorKind::host, evolution.source, evolution.parameters);
    qunsetenv("TIDEMARK_SIMD");
    QVERIFY(!made);
    QCOMPARE(made.error().kind, ErrorKind::usage);
  }

  void a_saved_level_set_resumes_to_the_same_voxels() {
    const Evolution evolution;
    const auto unbroken = evolution.start(ExecutorKind::host, 2);
    run(*unbroken, 60);
    const Field saved =
        Field::from_dense(evolution.geometry, unbroken->snapshot().value().dense(), unbroken->band());
    const auto resumed = executor(ExecutorKind::host, evolution.source, evolution.parameters);
    QCOMPARE(failure(resumed->restore(saved)), QString());
    run(*unbroken, 60);
    run(*resumed, 60);
    QCOMPARE(unbroken->snapshot().value().mask().voxels, resumed->snapshot().value().mask().voxels);
    QVERIFY(resumed->validate());
  }
};

TIDEMARK_TEST(AgreementTest)
#include "agreement_test.moc"
