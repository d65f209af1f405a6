// Real studies, opened as the desktop opens them.
#include <QSignalSpy>

#include "engine/series_preview.h"
#include "engine/study_loader.h"
#include "heartbeat.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::study_loading_test {

class StudyLoadingTest : public QObject {
  Q_OBJECT

 private slots:
  void a_study_is_loaded_without_stopping_the_user_interface_data() {
    QTest::addColumn<QString>("folder");
    QTest::addColumn<qlonglong>("voxels");
    QTest::newRow("MR, 100 slices") << "d01_mrhead_ge_3d" << qlonglong{256 * 256 * 100};
    QTest::newRow("CT, JPEG 2000") << "d02_ct_body_j2k_siemens" << qlonglong{512 * 512 * 20};
    QTest::newRow("NIfTI") << "v04_ct_body_3mm" << qlonglong{122 * 101 * 112};
  }
  void a_study_is_loaded_without_stopping_the_user_interface() {
    QFETCH(QString, folder);
    QFETCH(qlonglong, voxels);
    engine::StudyLoader loader;
    QSignalSpy loaded(&loader, &engine::StudyLoader::loaded);
    QSignalSpy failed(&loader, &engine::StudyLoader::failed);
    QElapsedTimer clock;
    clock.start();
    Heartbeat heartbeat;
    loader.load(studies_folder() / folder.toStdString(), {});
    QTRY_VERIFY_WITH_TIMEOUT(!loaded.isEmpty() || !failed.isEmpty(), 60'000);
    qInfo("loaded in %lld ms; the largest gap of a 5 ms timer was %.1f ms", clock.elapsed(),
          heartbeat.largest_gap_ms());
    QVERIFY2(heartbeat.busy_share() < 0.25, qPrintable(QString::number(heartbeat.busy_share())));
    QVERIFY2(failed.isEmpty(), failed.isEmpty() ? "" : qPrintable(failed[0][0].toString()));
    const auto study = loaded[0][0].value<std::shared_ptr<const engine::LoadedStudy>>();
    QCOMPARE(qlonglong{study->volume->geometry.voxel_count()}, voxels);
    QVERIFY(!study->name.isEmpty());
    QCOMPARE(failure(solver::check(study->parameters)), QString());
    QVERIFY(study->parameters.target > study->summary.lowest);
    QVERIFY(study->parameters.target < study->summary.highest);
  }

  void every_loadable_series_has_a_picture() {
    engine::StudyLoader loader;
    QSignalSpy found(&loader, &engine::StudyLoader::found);
    Heartbeat heartbeat;
    loader.scan(studies_folder());
    QTRY_VERIFY_WITH_TIMEOUT(!found.isEmpty(), 60'000);
    const auto catalogue = found[0][0].value<std::shared_ptr<const imaging::Catalogue>>();
    engine::SeriesPreviews previews;
    QSignalSpy made(&previews, &engine::SeriesPreviews::made);
    int asked = 0;
    for (const imaging::Series& series : catalogue->series) {
      if (series.loadable) previews.request(asked++, series, 128);
    }
    QVERIFY(asked > 20);
    QTRY_COMPARE_WITH_TIMEOUT(made.size(), asked, 60'000);
    qInfo("%d pictures of %zu series; the largest gap of a 5 ms timer was %.1f ms", asked,
          catalogue->series.size(), heartbeat.largest_gap_ms());
    for (const auto& one : made) QVERIFY(!one[1].value<QImage>().isNull());
  }
};

TIDEMARK_STUDY_TEST(StudyLoadingTest)

}  // namespace tidemark::test::study_loading_test

#include "study_loading_test.moc"
