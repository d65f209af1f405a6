// Executors agree: T5 of the numerics, threads, chunks, instruction sets, saving and resuming.
#include <cstdlib>

#include "random_problem.h"
#include "settings.h"
#include "solver/reference/reference_executor.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::agreement_test {

namespace {

// The tumour phantom's like in small, with a seed.
struct Evolution {
  Geometry geometry = grid({61, 47, 40}, {1.0, 1.0, 1.0});
  std::shared_ptr<const Volume> source = volume_of(geometry, [this](glm::dvec3 p) {
    const double r = glm::distance(p, centre_of(geometry));
    return 100.0 - 6.0 * std::max(0.0, r - 12.0 - 2.0 * std::sin(p.x / 3.0)) + 5.0 * std::sin(p.y * 7.0);
  });
  solver::Parameters parameters = [] {
    solver::Parameters p;
    p.target = 100.0;
    p.range = 25.0;
    p.alpha = 0.6;
    return p;
  }();

  std::unique_ptr<solver::Executor> start(solver::ExecutorKind kind, int threads) const {
    solver::ExecutorOptions options;
    options.threads = threads;
    auto level_set = executor(kind, source, parameters, options);
    if (!level_set->paint({centre_of(geometry), 5.0}, solver::Brush::add)) qFatal("paint failed");
    return level_set;
  }
};

bool same_bits(const solver::Field& a, const solver::Field& b) {
  return same_pages(a, b);
}

}  // namespace

class AgreementTest : public QObject {
  Q_OBJECT

 private slots:
  void each_step_is_the_references_step_data() { add_rows_with_host(); }
  void each_step_is_the_references_step() {  // T5
    const Setting setting = this_row();
    solver::ExecutorOptions options = setting.options();
    options.skip_quiet_pages = false;
    // An executor on OpenGL takes as long to make as many steps do: there each has more of the parameters.
    const bool is_host = setting.kind == solver::ExecutorKind::host;
    const int problems = is_host ? 40 : 8;
    const int draws = is_host ? 2 : 8;
    std::mt19937 random(7);
    double worst = 0.0;
    for (int i = 0; i < problems; ++i) {
      RandomProblem problem = random_problem(random);
      const Geometry& geometry = problem.source->geometry;
      const auto tested = executor(setting.kind, problem.source, problem.parameters, options);
      solver::ReferenceExecutor reference(problem.source, problem.parameters);
      seed(*tested, geometry, random);
      for (int draw = 0; draw < draws; ++draw) {
        for (solver::Executor* level_set : {tested.get(), static_cast<solver::Executor*>(&reference)}) {
          QCOMPARE(failure(level_set->set_parameters(problem.parameters)), QString());
        }
        for (int step = 0; step < (is_host ? 8 : 2); ++step) {
          run(*tested, 3);  // some way between the comparisons
          QCOMPARE(failure(reference.restore(tested->snapshot().value())), QString());
          run(*tested, 1);
          QVERIFY(reference.advance({}));
          const solver::Field phi = tested->snapshot().value();
          worst = std::max(worst, largest_difference(phi.dense(), reference.values()));
          QVERIFY2(worst <= 1e-5, qPrintable(QString("problem %1: %2").arg(i).arg(worst)));
          QVERIFY(resident_pages_cover_what_is_not_flat(phi, reference.values()));
          QCOMPARE(failure(tested->validate()), QString());
        }
        problem.parameters = random_parameters(random);
      }
    }
    qInfo("T5: largest difference of a step %.1e in %d settings", worst, problems * draws);
  }

  // No evolution gets so far from a distance transform: steep everywhere, with tiny values beside large ones.
  void a_step_from_a_field_of_noise_is_the_references_step_data() { add_rows_with_host(); }
  void a_step_from_a_field_of_noise_is_the_references_step() {  // T5
    const Setting setting = this_row();
    std::mt19937 random(11);
    const auto uniform = [&] { return 2.0 * (random() / 4294967296.0) - 1.0; };
    const int problems = setting.kind == solver::ExecutorKind::host ? 40 : 5;
    double worst = 0.0;
    for (int i = 0; i < problems; ++i) {
      RandomProblem problem = random_problem(random);
      const auto tested = setting.make(problem.source, problem.parameters);
      solver::ReferenceExecutor reference(problem.source, problem.parameters);
      for (int draw = 0; draw < 2; ++draw) {
        for (solver::Executor* level_set : {tested.get(), static_cast<solver::Executor*>(&reference)}) {
          QCOMPARE(failure(level_set->set_parameters(problem.parameters)), QString());
        }
        set_phi(*tested, problem.source->geometry,
                [&](glm::dvec3) { return tested->band() * std::pow(uniform(), 5.0); });
        QCOMPARE(failure(reference.restore(tested->snapshot().value())), QString());
        run(*tested, 1);
        QVERIFY(reference.advance({}));
        const std::vector<float> values = tested->snapshot().value().dense();
        worst = std::max(worst, largest_difference(values, reference.values()) / tested->band());
        problem.parameters = random_parameters(random);
      }
    }
    qInfo("T5: largest difference of a step from noise %.1e of the band in %d settings", worst, 2 * problems);
    // Shaders compute the data term in single precision, too, which shows where phi is this steep.
    QVERIFY(worst <= (setting.kind == solver::ExecutorKind::host ? 1e-5 : 2e-5));
  }

  void free_runs_end_in_the_same_mask() {  // T5
    const Evolution evolution;
    const auto host = evolution.start(solver::ExecutorKind::host, 2);
    const auto reference = evolution.start(solver::ExecutorKind::reference, 1);
    run(*host, 500);
    run(*reference, 500);
    const double overlap = dice(host->snapshot().value().mask(), reference->snapshot().value().mask());
    qInfo("T5: Dice after 500 steps %.5f", overlap);
    QVERIFY(overlap >= 0.999);
    QVERIFY(host->snapshot().value().mask().count() > 5000);
  }

  void the_bits_do_not_depend_on_threads_or_chunks() {
    const Evolution evolution;
    const auto expected = evolution.start(solver::ExecutorKind::host, 1);
    run(*expected, 210);
    const solver::Field phi = expected->snapshot().value();
    for (const int threads : {2, 5}) {
      const auto other = evolution.start(solver::ExecutorKind::host, threads);
      run(*other, 210);
      QVERIFY(same_bits(phi, other->snapshot().value()));
    }
    for (const int chunk : {1, 7, 30}) {
      const auto other = evolution.start(solver::ExecutorKind::host, 2);
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
      const auto made =
          solver::make_executor(solver::ExecutorKind::host, evolution.source, evolution.parameters);
      if (!made) {
        // This processor lacks it: the reason says so, and nothing else may fail.
        QCOMPARE(made.error().kind, ErrorKind::capability);
        qWarning("%s", made.error().message.c_str());
        continue;
      }
      QVERIFY((*made)->paint({centre_of(evolution.geometry), 5.0}, solver::Brush::add));
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
    const auto made =
        solver::make_executor(solver::ExecutorKind::host, evolution.source, evolution.parameters);
    qunsetenv("TIDEMARK_SIMD");
    QVERIFY(!made);
    QCOMPARE(made.error().kind, ErrorKind::usage);
  }

  void a_saved_level_set_resumes_to_the_same_voxels() {
    const Evolution evolution;
    const auto unbroken = evolution.start(solver::ExecutorKind::host, 2);
    run(*unbroken, 60);
    const solver::Field saved =
        solver::Field::from_dense(evolution.geometry, unbroken->snapshot().value().dense(), unbroken->band());
    const auto resumed = executor(solver::ExecutorKind::host, evolution.source, evolution.parameters);
    QCOMPARE(failure(resumed->restore(saved)), QString());
    run(*unbroken, 60);
    run(*resumed, 60);
    QCOMPARE(unbroken->snapshot().value().mask().voxels, resumed->snapshot().value().mask().voxels);
    QVERIFY(resumed->validate());
  }
};

TIDEMARK_TEST(AgreementTest)

}  // namespace tidemark::test::agreement_test

#include "agreement_test.moc"
