// A GPU is tried before a surface is left to it.
#include "solver/trial.h"

#include <QTest>

#include "gpu/device.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::trial_test {

namespace {

// The processor plays a GPU, which `automatic` would take.
solver::ExecutorOptions on_a_gpu() {
  auto device = gpu::Device::create_headless({gpu::GlVersion::gl45, false, true});
  if (!device) qFatal("%s", device.error().message.c_str());
  solver::ExecutorOptions options;
  options.device = *device;
  return options;
}

auto made(solver::ExecutorKind kind, const solver::ExecutorOptions& options) {
  return solver::make_executor(kind, solver::trial_source(), solver::trial_parameters(), options);
}

}  // namespace

class TrialTest : public QObject {
  Q_OBJECT

 private slots:
  // Before any driver has passed: one that has is not tried again.
  void a_gpu_that_fails_is_not_taken() {
    const solver::ExecutorOptions automatic = on_a_gpu();
    automatic.device->lose_at_check(40);
    const auto taken = made(solver::ExecutorKind::automatic, automatic);
    QVERIFY2(taken, taken ? "" : taken.error().message.c_str());
    QVERIFY(automatic.device->lost());
    QCOMPARE((*taken)->name(), std::string_view("host"));

    const solver::ExecutorOptions asked_for = on_a_gpu();
    asked_for.device->lose_at_check(40);
    const auto refused = made(solver::ExecutorKind::compute, asked_for);
    QVERIFY(!refused);
    QCOMPARE(refused.error().kind, ErrorKind::capability);
    const std::string& message = refused.error().message;
    QVERIFY2(message.starts_with("the graphics driver lost its context while "), message.c_str());
  }

  void one_that_passes_is_taken() {
    const solver::ExecutorOptions options = on_a_gpu();
    const auto taken = made(solver::ExecutorKind::automatic, options);
    QVERIFY2(taken, taken ? "" : taken.error().message.c_str());
    QCOMPARE((*taken)->name(), std::string_view("compute"));
  }

  void every_executor_passes_data() {
    QTest::addColumn<QString>("name");
    for (const char* name : {"reference", "compute", "stream"}) QTest::newRow(name) << name;
  }
  void every_executor_passes() {
    QFETCH(const QString, name);
    const auto tried = made(*solver::executor_named(name.toStdString()), {});
    const auto trusted = made(solver::ExecutorKind::host, {});
    QVERIFY(tried && trusted);
    const Status same = solver::compare_in_trial(**tried, **trusted);
    QVERIFY2(same, same ? "" : same.error().message.c_str());
    // There was something to get wrong: memory grew, and the cut is there.
    QVERIFY((*trusted)->memory().resident_pages > 100);
    const Mask mask = (*trusted)->snapshot()->mask();
    QVERIFY(mask.count() > 8000);
  }

  void one_that_goes_another_way_fails() {
    solver::Parameters others = solver::trial_parameters();
    others.alpha = 0.7;
    const auto tried = solver::make_executor(solver::ExecutorKind::host, solver::trial_source(), others, {});
    const auto trusted = made(solver::ExecutorKind::host, {});
    QVERIFY(tried && trusted);
    const Status same = solver::compare_in_trial(**tried, **trusted);
    QVERIFY(!same);
    QCOMPARE(same.error().kind, ErrorKind::capability);
    QVERIFY2(same.error().message.find("Dice") != std::string::npos, same.error().message.c_str());
  }
};

TIDEMARK_TEST(TrialTest)

}  // namespace tidemark::test::trial_test

#include "trial_test.moc"
