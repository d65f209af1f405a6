// Studies are found and loaded in the background, and whatever is given up is not heard of again.
#include "engine/study_loader.h"

#include <QSignalSpy>

#include "engine/background_job.h"
#include "heartbeat.h"
#include "imaging/phantom/phantom.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::study_loader_test {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

namespace {

constexpr int kPatience = 120'000;  // ms; under a sanitizer everything takes longer

// The outcome of whatever the loader is doing: a study, or the message of what went wrong.
struct Outcome {
  std::shared_ptr<const engine::LoadedStudy> study;
  std::shared_ptr<const imaging::Catalogue> catalogue;
  QString message;
};

Outcome wait_for(engine::StudyLoader& loader) {
  Outcome outcome;
  QObject scope;
  bool done = false;
  QObject::connect(&loader, &engine::StudyLoader::loaded, &scope, [&](const auto& study) {
    outcome.study = study;
    done = true;
  });
  QObject::connect(&loader, &engine::StudyLoader::found, &scope, [&](const auto& catalogue) {
    outcome.catalogue = catalogue;
    done = true;
  });
  QObject::connect(&loader, &engine::StudyLoader::failed, &scope, [&](const QString& message) {
    outcome.message = message;
    done = true;
  });
  if (!QTest::qWaitFor([&] { return done; }, kPatience)) outcome.message = "nothing came";
  return outcome;
}

}  // namespace

class StudyLoaderTest : public QObject {
  Q_OBJECT

  test::TemporaryFolder folder_;
  imaging::Phantom sphere_;

 private slots:
  void initTestCase() {
    auto phantom = imaging::make_phantom("sphere");
    QCOMPARE(test::failure(phantom), QString());
    sphere_ = std::move(*phantom);
    QCOMPARE(test::failure(imaging::write_phantom(sphere_, folder_.path())), QString());
  }

  // What one test started does not run into the next.
  void cleanup() { QVERIFY(engine::BackgroundJob::finish_all(60s)); }

  void a_folder_is_scanned() {
    engine::StudyLoader loader;
    loader.scan(folder_.path());
    QVERIFY(loader.busy());
    const Outcome outcome = wait_for(loader);
    QCOMPARE(outcome.message, QString());
    QVERIFY(!loader.busy());
    QCOMPARE(outcome.catalogue->series.size(), std::size_t{2});  // the images, and the truth
  }

  void a_series_becomes_a_study() {
    engine::StudyLoader loader;
    QSignalSpy progress(&loader, &engine::StudyLoader::progressed);
    loader.load(folder_ / "series", {});
    const Outcome outcome = wait_for(loader);
    QCOMPARE(outcome.message, QString());
    const engine::LoadedStudy& study = *outcome.study;
    QCOMPARE(study.volume->values(), sphere_.volume.values());
    QCOMPARE(study.origin.path, folder_ / "series");
    QVERIFY(!study.origin.series_uid.empty());
    QVERIFY(study.origin.phantom.empty());
    QCOMPARE(study.name, QString::fromStdString(sphere_.volume.description));
    QCOMPARE(study.summary.highest, sphere_.volume.range().second);
    QVERIFY(!study.start);
    // Otsu's bright class is the ball.
    QVERIFY2(std::abs(study.parameters.target - sphere_.target) < sphere_.range,
             qPrintable(QString::number(study.parameters.target)));
    QCOMPARE(test::failure(solver::check(study.parameters)), QString());
    QVERIFY(!progress.isEmpty());
    for (const auto& said : progress) {
      QVERIFY(said[0].toDouble() >= 0.0 && said[0].toDouble() <= 1.0);
      QVERIFY2(said[1].toString().front().isUpper(), qPrintable(said[1].toString()));
    }
  }

  void a_series_that_was_found_is_found_again_at_its_origin() {
    engine::StudyLoader loader;
    loader.scan(folder_.path());
    const auto catalogue = wait_for(loader).catalogue;
    for (const imaging::Series& series : catalogue->series) {
      loader.load(series);
      const Outcome first = wait_for(loader);
      QCOMPARE(first.message, QString());
      loader.load(first.study->origin.path, first.study->origin.series_uid);
      const Outcome again = wait_for(loader);
      QCOMPARE(again.message, QString());
      QCOMPARE(again.study->volume->values(), first.study->volume->values());
    }
  }

  void a_phantom_brings_its_parameters_and_its_start() {
    engine::StudyLoader loader;
    loader.make_phantom("sphere");
    const Outcome outcome = wait_for(loader);
    QCOMPARE(outcome.message, QString());
    const engine::LoadedStudy& study = *outcome.study;
    QCOMPARE(study.volume->values(), sphere_.volume.values());
    QCOMPARE(study.origin.phantom, std::string("sphere"));
    QVERIFY(study.origin.path.empty());
    QCOMPARE(study.parameters.target, sphere_.target);
    QCOMPARE(study.parameters.range, sphere_.range);
    QCOMPARE(study.parameters.alpha, sphere_.alpha);
    QVERIFY(study.start && study.start->seed == sphere_.seed);
    QVERIFY(study.start->threshold == sphere_.init_threshold);
  }

  void what_cannot_be_opened_is_said() {
    const test::TemporaryFolder empty;
    engine::StudyLoader loader;
    loader.scan(empty.path());
    QVERIFY(wait_for(loader).message.contains("holds no DICOM series, volume file or picture"));
    loader.load(empty / "nowhere", {});
    QVERIFY(wait_for(loader).message.contains("no such file or folder"));
    loader.make_phantom("unicorn");
    QVERIFY(wait_for(loader).message.contains("unknown phantom 'unicorn'"));
    QVERIFY(!loader.busy());
  }

  void a_damaged_slice_is_named() {
    const test::TemporaryFolder damaged;
    fs::copy(folder_ / "series", damaged / "series");
    engine::StudyLoader loader;
    loader.scan(damaged.path());
    const imaging::Series series = wait_for(loader).catalogue->series.front();
    const fs::path slice = series.files.at(40);
    fs::resize_file(slice, fs::file_size(slice) / 2);
    for (const bool listed_before : {true, false}) {
      if (listed_before) {
        loader.load(series);
      } else {
        loader.load(damaged.path(), {});
      }
      const QString message = wait_for(loader).message;
      QVERIFY2(message.contains(QString::fromStdString(slice.filename().string())), qPrintable(message));
    }
  }

  void a_single_file_that_cannot_be_loaded_is_no_choice() {
    const test::TemporaryFolder damaged;
    fs::copy(folder_ / "series", damaged / "series");
    const fs::path slice = *fs::directory_iterator(damaged / "series");
    fs::resize_file(slice, fs::file_size(slice) / 2);
    engine::StudyLoader loader;
    loader.scan(slice);
    const Outcome outcome = wait_for(loader);
    QVERIFY(!outcome.catalogue);
    QVERIFY2(outcome.message.contains(QString::fromStdString(slice.filename().string())),
             qPrintable(outcome.message));
  }

  void nothing_is_heard_of_a_load_that_was_cancelled() {
    engine::StudyLoader loader;
    QSignalSpy cancelled(&loader, &engine::StudyLoader::cancelled);
    QSignalSpy loaded(&loader, &engine::StudyLoader::loaded);
    QSignalSpy failed(&loader, &engine::StudyLoader::failed);
    QSignalSpy progress(&loader, &engine::StudyLoader::progressed);
    loader.cancel();
    QCOMPARE(cancelled.size(), 0);  // nothing to give up
    loader.load(folder_ / "series", {});
    QVERIFY(QTest::qWaitFor([&] { return !progress.isEmpty(); }, kPatience));
    loader.cancel();
    QVERIFY(!loader.busy());
    QCOMPARE(cancelled.size(), 1);
    QVERIFY(engine::BackgroundJob::finish_all(60s));
    QCoreApplication::processEvents();
    QCOMPARE(loaded.size() + failed.size(), 0);
    loader.load(folder_ / "series", {});
    QCOMPARE(wait_for(loader).message, QString());
  }

  void the_next_request_takes_the_place_of_the_one_before() {
    engine::StudyLoader loader;
    QSignalSpy loaded(&loader, &engine::StudyLoader::loaded);
    loader.load(folder_ / "series", {});
    loader.load(folder_ / "truth.nii.gz", {});
    const Outcome outcome = wait_for(loader);
    QCOMPARE(outcome.message, QString());
    QCOMPARE(outcome.study->name, QString("truth.nii.gz"));
    QVERIFY(engine::BackgroundJob::finish_all(60s));
    QCoreApplication::processEvents();
    QCOMPARE(loaded.size(), 1);
  }

  void a_loader_can_go_while_it_works() {
    test::Heartbeat heartbeat;
    for (int round = 0; round < 20; ++round) {
      auto loader = std::make_unique<engine::StudyLoader>();
      loader->load(folder_ / "series", {});
      QTest::qWait(round);
    }
    qInfo("destroying loaders at work: the largest gap of a 5 ms timer was %.1f ms",
          heartbeat.largest_gap_ms());
    QVERIFY(engine::BackgroundJob::finish_all(60s));
    QCoreApplication::processEvents();
  }

  void the_user_interface_stays_alive_meanwhile() {
    engine::StudyLoader loader;
    test::Heartbeat making;
    loader.make_phantom("tumour");
    QCOMPARE(wait_for(loader).message, QString());
    qInfo("making a phantom of 256 x 256 x 175: the largest gap of a 5 ms timer was %.1f ms",
          making.largest_gap_ms());
    QVERIFY2(making.busy_share() < 0.25, qPrintable(QString::number(making.busy_share())));
    test::Heartbeat loading;
    loader.load(folder_.path(), {});
    QCOMPARE(wait_for(loader).message, QString());
    qInfo("loading 81 slices: the largest gap of a 5 ms timer was %.1f ms", loading.largest_gap_ms());
    QVERIFY2(loading.busy_share() < 0.25, qPrintable(QString::number(loading.busy_share())));
  }

  void names_are_never_the_patients() {
    imaging::Series series;
    series.transfer_syntaxes = {"1.2.840.10008.1.2"};
    series.files = {"/data/DOE_JOHN/DOE_JOHN_1.dcm"};
    series.description = "DOE_JOHN_1.dcm";  // what a series without a description is listed under
    series.modality = "CT";
    series.date = "2004-07-31";
    QCOMPARE(engine::StudyLoader::name_of(series), QString("CT 2004-07-31"));
    series.date.clear();
    QCOMPARE(engine::StudyLoader::name_of(series), QString("CT"));
    series.description = "Liver 3 mm";
    QCOMPARE(engine::StudyLoader::name_of(series), QString("Liver 3 mm"));
    // The file that named it is not the first one once slices are sorted.
    series.description = "MUELLER_0007.dcm";
    series.files = {"study/MUELLER_0001.dcm", "study/MUELLER_0007.dcm"};
    QCOMPARE(engine::StudyLoader::name_of(series), QString("CT"));
  }

  void a_series_lies_in_the_folder_that_holds_all_its_files() {
    imaging::Series series;
    series.transfer_syntaxes = {"1.2.840.10008.1.2"};
    series.files = {"/data/a/1.dcm", "/data/a/2.dcm"};
    QCOMPARE(engine::StudyLoader::place_of(series), fs::path("/data/a"));
    series.files.push_back("/data/b/c/3.dcm");
    QCOMPARE(engine::StudyLoader::place_of(series), fs::path("/data"));
    series.files.push_back("/data/ab.dcm");
    QCOMPARE(engine::StudyLoader::place_of(series), fs::path("/data"));
    series.transfer_syntaxes.clear();
    series.files = {"/data/brain.nii"};
    QCOMPARE(engine::StudyLoader::place_of(series), fs::path("/data/brain.nii"));
  }
};

TIDEMARK_TEST(StudyLoaderTest)

}  // namespace tidemark::test::study_loader_test

#include "study_loader_test.moc"
