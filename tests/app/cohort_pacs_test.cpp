// Cohorts whose studies a PACS has.
#include <QJsonArray>
#include <QTest>

#include "core/atomic_file.h"
#include "imaging/load_study.h"
#include "imaging/pacs/configuration.h"
#include "tests/app/cli_runner.h"
#include "tests/imaging/pacs/archives.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cohort_pacs_test {

namespace {

constexpr int kStudies = 2;
const QStringList kDrive{"--target", "1000", "--range", "400", "--alpha", "0.6"};
const QStringList kParameters = kDrive + QStringList{"--max-steps", "60", "--auto-start"};

// Some studies, on this disk.
class Studies {
 public:
  Studies() {
    for (int i = 0; i < kStudies; ++i) {
      must_run({"phantom", "sphere", "--random-seed", QString::number(i + 1), "--out",
                text(series(i).parent_path())});
    }
  }
  [[nodiscard]] std::filesystem::path series(int number) const {
    return folder_ / ("study" + std::to_string(number)) / "series";
  }

 private:
  TemporaryFolder folder_;
};

// An archive that has them, and a file of servers with its name.
class Site {
 public:
  explicit Site(const Studies& studies, bool by_move = false) : archive_(start_dcmqrscp()) {
    imaging::PacsConfiguration configuration;
    configuration.servers.push_back(by_move ? archive_->server_by_move() : archive_->server());
    configuration.limits.free_bytes = 1 << 20;
    if (!imaging::write_pacs_configuration(configuration, folder_ / "pacs.json")) {
      qFatal("no file of servers");
    }
    for (int i = 0; i < kStudies; ++i) {
      must_run(QStringList{"pacs", "send", "dcmqrscp", text(studies.series(i))} + use());
    }
  }

  [[nodiscard]] QStringList use() const { return {"--servers", text(folder_ / "pacs.json")}; }
  void shut_down() { archive_.reset(); }
  // Plans all that it has.
  void plan(const std::filesystem::path& out, const QStringList& more = {}) const {
    must_run(QStringList{"cohort", "plan", "pacs:dcmqrscp", "--modality", "MR", "--out", text(out)} + use() +
             kParameters + more);
  }

 private:
  TemporaryFolder folder_;
  std::unique_ptr<Archive> archive_;
};

// The id of the case of a series, which is its UID.
QString id_of(const std::filesystem::path& series) {
  return json_of(must_run({"info", text(series), "--json"}).out)["series"][0]["uid"].toString();
}

QJsonObject status_of(const std::filesystem::path& cohort, const QString& id) {
  return json_of(bytes_of(cohort / "cases" / id.toStdString() / "status.json"));
}

}  // namespace

class CohortPacsTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { site_ = std::make_unique<Site>(studies_); }
  void cases_have_the_masks_of_segment_and_leave_no_image_behind_data() {
    QTest::addColumn<bool>("by_move");
    QTest::newRow("get") << false;
    QTest::newRow("move") << true;
  }
  void cases_have_the_masks_of_segment_and_leave_no_image_behind();
  void a_server_that_is_away_is_no_fault_of_a_case();
  void a_series_that_is_not_there_is_refused();
  void a_case_that_is_ended_leaves_no_image_behind();
  void rejected_cases_are_planned_with_the_servers_that_they_came_from();
  void a_query_that_finds_nothing_or_makes_no_sense_is_told_data();
  void a_query_that_finds_nothing_or_makes_no_sense_is_told();

 private:
  const Studies studies_;
  std::unique_ptr<Site> site_;
};

void CohortPacsTest::cases_have_the_masks_of_segment_and_leave_no_image_behind() {
  QFETCH(bool, by_move);
  const auto moving = by_move ? std::make_unique<Site>(studies_, true) : nullptr;
  const Site& site = by_move ? *moving : *site_;
  const TemporaryFolder folder;
  const auto out = folder / "cohort";
  std::filesystem::create_directory(folder / "temporary");
  RunOptions options;
  options.environment.insert("TMPDIR", text(folder / "temporary"));
  site.plan(out, {"--output", "seg"});
  // Servers that send to a port of this machine have one for all that run.
  const QJsonObject tally =
      json_of(must_run({"cohort", "run", text(out), "--jobs", "3", "--json"}, options).out);
  QCOMPARE(tally["done"].toInt(), kStudies);
  QCOMPARE(names_in(folder / "temporary"), QStringList());
  for (int i = 0; i < kStudies; ++i) {
    const auto series = studies_.series(i);
    const QString id = id_of(series);
    const QJsonObject status = status_of(out, id);
    QCOMPARE(status["outcome"].toString(), QString("done"));
    QVERIFY2(status["input"].toString().startsWith("pacs:dcmqrscp/"), qPrintable(status["input"].toString()));
    const auto alone = folder / "alone.nii.gz";
    must_run(QStringList{"segment", text(series), "--executor", "host", "--out", text(alone)} + kParameters);
    const auto expected = imaging::load_mask(alone);
    const auto found = imaging::load_mask(out / "cases" / id.toStdString() / "mask.nii.gz");
    QCOMPARE(failure(found), QString());
    QVERIFY(expected->voxels == found->voxels && expected->geometry == found->geometry);
    QVERIFY(found->count() > 0);
    QVERIFY(std::filesystem::exists(out / "cases" / id.toStdString() / "seg.dcm"));
  }
  must_run({"cohort", "report", text(out), "--bids", text(folder / "masks")});
  const QJsonObject description = json_of(bytes_of(folder / "masks/dataset_description.json"));
  QCOMPARE(description["SourceDatasets"][0]["URL"].toString(), QString("pacs:dcmqrscp"));
}

void CohortPacsTest::a_server_that_is_away_is_no_fault_of_a_case() {
  Site site(studies_);
  const TemporaryFolder folder;
  const auto out = folder / "cohort";
  site.plan(out);
  site.shut_down();
  const Outcome outcome = run_cli({"cohort", "run", text(out), "--jobs", "2"});
  QVERIFY2(outcome.failed_in_one_line(3) && outcome.err.contains("dcmqrscp"), outcome.told());
  QCOMPARE(names_in(out / "cases"), QStringList());
  QCOMPARE(names_in(out / "staging"), QStringList());
}

void CohortPacsTest::a_series_that_is_not_there_is_refused() {
  const TemporaryFolder folder;
  const auto out = folder / "cohort";
  const std::string known = id_of(studies_.series(0)).toStdString();
  site_->plan(folder / "all");
  std::string study;
  for (const QByteArray& line : bytes_of(folder / "all" / "work.csv").split('\n')) {
    if (line.startsWith(known.c_str())) study = line.split(',')[3].toStdString();
  }
  QVERIFY(!study.empty());
  QVERIFY(write_file(folder / "list.csv", "id,server,study,series\nthere,dcmqrscp," + study + "," + known +
                                              "\ngone,dcmqrscp," + study + ",1.2.3\n"));
  must_run(QStringList{"cohort", "plan", text(folder / "list.csv"), "--out", text(out)} + site_->use() +
           kParameters);
  const QJsonObject tally = json_of(must_run({"cohort", "run", text(out), "--json"}).out);
  QCOMPARE(tally["done"].toInt(), 1);
  QCOMPARE(tally["refused"].toInt(), 1);
  const QJsonObject status = status_of(out, "gone");
  QCOMPARE(status["outcome"].toString(), QString("refused"));
  QVERIFY2(!status["reason"].toString().contains("/tmp"), qPrintable(status["reason"].toString()));
}

void CohortPacsTest::a_case_that_is_ended_leaves_no_image_behind() {
  const TemporaryFolder folder;
  const auto out = folder / "cohort";
  std::filesystem::create_directory(folder / "temporary");
  RunOptions options;
  options.environment.insert("TMPDIR", text(folder / "temporary"));
  must_run(QStringList{"cohort", "plan", "pacs:dcmqrscp", "--modality", "MR", "--out", text(out), "--steps",
                       "900000000", "--seed-mm", "0,0,0,5"} +
           site_->use() + kDrive);
  const QJsonObject tally =
      json_of(must_run({"cohort", "run", text(out), "--timeout", "5", "--json"}, options).out);
  QCOMPARE(tally["timed_out"].toInt(), kStudies);
  QCOMPARE(names_in(folder / "temporary"), QStringList());
}

void CohortPacsTest::rejected_cases_are_planned_with_the_servers_that_they_came_from() {
  const TemporaryFolder folder;
  site_->plan(folder / "first");
  const std::string rejected = id_of(studies_.series(1)).toStdString();
  QVERIFY(write_file(folder / "said.csv", "id,decision,comment\n" + rejected + ",reject,\n"));
  must_run({"cohort", "plan", text(folder / "first"), "--rejected", text(folder / "said.csv"), "--out",
            text(folder / "second")});
  QCOMPARE(bytes_of(folder / "second" / "work.csv").count('\n'), 2);
  QCOMPARE(json_of(bytes_of(folder / "second" / "plan.json"))["servers"].toString(), site_->use()[1]);
}

void CohortPacsTest::a_query_that_finds_nothing_or_makes_no_sense_is_told_data() {
  QTest::addColumn<QStringList>("arguments");
  QTest::addColumn<int>("code");
  QTest::addColumn<QByteArray>("said");
  QTest::newRow("no modality") << QStringList{"pacs:dcmqrscp"} << 2 << QByteArray("--modality");
  QTest::newRow("no server") << QStringList{"pacs:other", "--modality", "MR"} << 2
                             << QByteArray("no PACS server 'other'");
  QTest::newRow("nothing") << QStringList{"pacs:dcmqrscp", "--modality", "PT"} << 3
                           << QByteArray("holds no case");
  QTest::newRow("no such series") << QStringList{"pacs:dcmqrscp", "--modality", "MR", "--series-description",
                                                 "Liver*"}
                                  << 3 << QByteArray("holds no case");
  QTest::newRow("mask") << QStringList{"pacs:dcmqrscp", "--modality", "MR", "--mask", "x"} << 2
                        << QByteArray("--mask");
  QTest::newRow("folder") << QStringList{"/tmp", "--modality", "MR"} << 2 << QByteArray("pacs:main");
}

void CohortPacsTest::a_query_that_finds_nothing_or_makes_no_sense_is_told() {
  QFETCH(QStringList, arguments);
  QFETCH(int, code);
  QFETCH(QByteArray, said);
  const TemporaryFolder folder;
  const Outcome outcome = run_cli(QStringList{"cohort", "plan"} + arguments + site_->use() + kParameters +
                                  QStringList{"--out", text(folder / "cohort")});
  QVERIFY2(outcome.failed_in_one_line(code) && outcome.err.contains(said), outcome.told());
  QVERIFY(!std::filesystem::exists(folder / "cohort"));
}

TIDEMARK_TEST(CohortPacsTest)

}  // namespace tidemark::test::cohort_pacs_test

#include "cohort_pacs_test.moc"
