// The balance of the speed terms foretells the next step on real studies.
#include "imaging/filters/filters.h"
#include "imaging/load_study.h"
#include "tests/solver/balance_check.h"
#include "tests/support/test_program.h"

namespace tidemark::test::balance_studies_test {

class BalanceStudiesTest : public QObject {
  Q_OBJECT

 private slots:
  void a_studys_next_step_is_the_sum_data() {
    QTest::addColumn<QString>("image");
    QTest::addColumn<double>("target");
    QTest::addColumn<double>("range");
    QTest::addColumn<QList<int>>("seed");  // a voxel
    QTest::newRow("MR, tumour, slices of 6 mm")
        << "d03_mr_tumour_brainix/FLAIR" << 440.0 << 140.0 << QList<int>{188, 149, 13};
    QTest::newRow("CT, liver") << "d02_ct_body_j2k_siemens/example_ct_dicom" << 95.0 << 30.0
                               << QList<int>{212, 208, 9};
    QTest::newRow("MR, brain") << "v01_head_mr_brain_skull/MR.nii.gz" << 203.0 << 143.0
                               << QList<int>{75, 99, 77};
  }
  void a_studys_next_step_is_the_sum() {
    QFETCH(QString, image);
    QFETCH(double, target);
    QFETCH(double, range);
    QFETCH(QList<int>, seed);
    auto volume = imaging::load_volume(studies_folder() / image.toStdString());
    QCOMPARE(failure(volume), QString());
    solver::Parameters parameters;
    parameters.target = target;
    parameters.range = range;
    parameters.alpha = 0.7;
    const auto source = std::make_shared<const Volume>(std::move(*volume));
    solver::ExecutorOptions options;
    options.skip_quiet_pages = false;
    auto level_set = solver::make_executor(solver::ExecutorKind::host, source, parameters, options);
    QCOMPARE(failure(level_set), QString());
    const auto sphere = solver::sphere_at_voxel(source->geometry, {seed[0], seed[1], seed[2]}, 20.0);
    QCOMPARE(failure((*level_set)->paint(sphere, solver::Brush::add)), QString());
    QCOMPARE(failure((*level_set)->advance({.steps = 40})), QString());
    expect_balances_foretell_a_step(**level_set, source);
  }
};

TIDEMARK_STUDY_TEST(BalanceStudiesTest)

}  // namespace tidemark::test::balance_studies_test

#include "balance_studies_test.moc"
