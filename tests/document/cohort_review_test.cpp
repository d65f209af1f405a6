// The review of a cohort: what is unusual, and text from outside that stays text.
#include "core/atomic_file.h"
#include "core/csv.h"
#include "document/cohort/decisions.h"
#include "document/cohort/report_page.h"
#include "document/cohort/review.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cohort_review_test {

using cohort::CaseOutcome;
using cohort::CaseStatus;

namespace {

CaseStatus done(const std::string& id, double volume_ml) {
  CaseStatus status;
  status.id = id;
  status.outcome = CaseOutcome::done;
  status.input = "/data/" + id;
  status.figures.emplace();
  status.figures->volume_ml = volume_ml;
  status.figures->surface_mm2 = 10.0 * volume_ml;
  return status;
}

// A cohort of that many cases of about 100 ml, without anything computed.
class SmallCohort {
 public:
  explicit SmallCohort(int count) {
    for (int i = 0; i < count; ++i) add(done(fmt::format("case{}", i), 100.0 + i));
  }
  void add(const CaseStatus& status) {
    const auto path = folder().case_folder(status.id);
    std::filesystem::create_directories(path);
    if (!write_file(path / "status.json", status.to_text())) qFatal("no status was written");
    cohort::WorkRow row;
    row.id = status.id;
    list_.rows.push_back(row);
  }
  void add_open(const std::string& id) {
    cohort::WorkRow row;
    row.id = id;
    list_.rows.push_back(row);
  }
  [[nodiscard]] cohort::CohortFolder folder() const { return cohort::CohortFolder(folder_.path()); }
  [[nodiscard]] cohort::Review review() const {
    auto made = cohort::review(folder(), list_);
    if (!made) qFatal("%s", made.error().message.c_str());
    return std::move(*made);
  }

 private:
  test::TemporaryFolder folder_;
  cohort::WorkList list_;
};

QString page_of(const SmallCohort& cohort, const cohort::CohortPlan& plan = {}) {
  const auto page = cohort::report_page(cohort.folder(), plan, cohort.review(), cohort::PagePictures::embed);
  if (!page) qFatal("%s", page.error().message.c_str());
  return QString::fromStdString(*page);
}

}  // namespace

class CohortReviewTest : public QObject {
  Q_OBJECT

 private slots:
  void the_robust_scale_is_that_of_iglewicz_and_hoaglin();
  void many_equal_values_have_a_spread_all_the_same();
  void the_most_unusual_case_comes_first();
  void cases_without_a_result_come_before_all();
  void cases_without_a_surface_come_next_and_are_no_measure_for_others();
  void a_status_that_cannot_be_read_loses_no_other();
  void a_status_is_read_as_it_was_written();
  void the_page_begins_with_what_was_said();
  void the_page_of_another_plan_or_result_has_another_mark();
  void text_of_a_hostile_case_stays_text();
  void a_table_holds_no_formula();
  void pictures_are_in_the_page();
  void decisions_are_read_back();
  void wrong_decisions_are_named_by_line_data();
  void wrong_decisions_are_named_by_line();
};

void CohortReviewTest::the_robust_scale_is_that_of_iglewicz_and_hoaglin() {
  const auto scale = cohort::RobustScale::of({1.0, 2.0, 3.0, 4.0, 100.0});
  QCOMPARE(scale.median, 3.0);
  QCOMPARE(scale.z(4.0), 0.6745);  // the MAD is 1
  QCOMPARE(scale.z(100.0), 97.0 * 0.6745);
  QCOMPARE(cohort::RobustScale::of({1.0, 3.0}).median, 2.0);
  QCOMPARE(cohort::RobustScale::of({}).z(5.0), 0.0);
}

void CohortReviewTest::many_equal_values_have_a_spread_all_the_same() {
  const auto scale = cohort::RobustScale::of({5.0, 5.0, 5.0, 5.0, 9.0});
  QVERIFY(scale.z(9.0) > 3.0);
  QCOMPARE(scale.z(5.0), 0.0);
  QCOMPARE(cohort::RobustScale::of({5.0, 5.0}).z(6.0), 0.0);  // nothing is known of how they vary
}

void CohortReviewTest::the_most_unusual_case_comes_first() {
  SmallCohort cohort(20);
  cohort.add(done("leaked", 900.0));
  cohort.add_open("open");
  const cohort::Review review = cohort.review();
  QCOMPARE(review.cases.size(), std::size_t{21});
  QCOMPARE(QString::fromStdString(review.cases.front().status.id), QString("leaked"));
  QVERIFY(review.cases.front().unusual > 50.0);
  QCOMPARE(review.not_done, std::vector<std::string>{"open"});
}

void CohortReviewTest::cases_without_a_result_come_before_all() {
  SmallCohort cohort(5);
  cohort.add(done("leaked", 9000.0));
  CaseStatus failed;
  failed.id = "failed";
  failed.outcome = CaseOutcome::timed_out;
  cohort.add(failed);
  QCOMPARE(QString::fromStdString(cohort.review().cases.front().status.id), QString("failed"));
}

void CohortReviewTest::cases_without_a_surface_come_next_and_are_no_measure_for_others() {
  SmallCohort cohort(5);
  cohort.add(done("leaked", 9000.0));
  for (int i = 0; i < 20; ++i) {
    CaseStatus vanished = done(fmt::format("vanished{}", i), 0.0);
    vanished.warnings = {cohort::CaseWarning::vanished};
    cohort.add(vanished);
  }
  CaseStatus failed;
  failed.id = "failed";
  failed.outcome = CaseOutcome::failed;
  cohort.add(failed);
  const cohort::Review review = cohort.review();
  QCOMPARE(QString::fromStdString(review.cases[0].status.id), QString("failed"));
  for (std::size_t i = 1; i <= 20; ++i) QVERIFY(review.cases[i].status.id.starts_with("vanished"));
  QCOMPARE(QString::fromStdString(review.cases[21].status.id), QString("leaked"));
  QCOMPARE(review.scales[0].median, 102.5);
}

void CohortReviewTest::a_status_that_cannot_be_read_loses_no_other() {
  SmallCohort cohort(3);
  cohort.add(done("bad", 1.0));
  QVERIFY(write_file(cohort.folder().status("bad"), "{\"format\": \"tidemark case status\"}"));
  const cohort::Review review = cohort.review();
  QCOMPARE(review.cases.size(), std::size_t{3});
  QCOMPARE(review.unreadable.size(), std::size_t{1});
  QVERIFY(QString::fromStdString(review.unreadable[0]).contains("version"));
}

void CohortReviewTest::a_status_is_read_as_it_was_written() {
  CaseStatus status = done("a", 12.5);
  status.figures->dice = 0.875;
  status.figures->mean_inside = -3.25;
  status.figures->solver_outcome = "converged";
  status.warnings = {cohort::CaseWarning::touches_border, cohort::CaseWarning::not_converged};
  status.remarks = {"slices sorted by position"};
  status.files = {"mask.nii.gz"};
  status.attempt = 3;
  status.peak_memory_bytes = 1 << 30;
  const auto read = CaseStatus::parse(status.to_text(), "status.json");
  QCOMPARE(test::failure(read), QString());
  QVERIFY(*read == status);
}

void CohortReviewTest::the_page_begins_with_what_was_said() {
  const SmallCohort cohort(3);
  std::filesystem::create_directories(cohort.folder().leases());
  QVERIFY(cohort::decide(cohort.folder(), {"case1", {}, {}},
                         {"case1", cohort::Decision::Verdict::rejected, "a \"leak\""}));
  const QString page = page_of(cohort);
  QVERIFY(
      page.contains("data-id=\"case1\" data-finished=\"\" data-outcome=\"done\" data-decision=\"reject\" "
                    "data-comment=\"a &quot;leak&quot;\""));
  QCOMPARE(page.count("data-decision=\""), 1);
  // A damaged table loses nothing else, and is named.
  QVERIFY(write_file(cohort.folder().decisions(), "no table\r\n"));
  const cohort::Review review = cohort.review();
  QCOMPARE(review.cases.size(), std::size_t{3});
  QCOMPARE(review.unreadable.size(), std::size_t{1});
  QVERIFY(review.unreadable.front().find("decisions.csv") != std::string::npos);
}

// A browser keeps decisions by them.
void CohortReviewTest::the_page_of_another_plan_or_result_has_another_mark() {
  SmallCohort cohort(1);
  CaseStatus status = done("again", 1.0);
  status.finished = "2026-03-01T12:00:00Z";
  cohort.add(status);
  cohort::CohortPlan plan;
  plan.planned = "2026-02-01T12:00:00Z";
  plan.recipe_checksum = "abc";
  QVERIFY(page_of(cohort, plan).contains("<body data-plan=\"2026-02-01T12:00:00Z abc\">"));
  plan.recipe_checksum = "def";
  const QString page = page_of(cohort, plan);
  QVERIFY(page.contains("<body data-plan=\"2026-02-01T12:00:00Z def\">"));
  QVERIFY(page.contains("data-id=\"again\" data-finished=\"2026-03-01T12:00:00Z\""));
}

void CohortReviewTest::text_of_a_hostile_case_stays_text() {
  SmallCohort cohort(2);
  CaseStatus hostile = done("x", 1.0);
  hostile.input = "/data/<script>alert(1)</script>\"' onload='x@CASES@";
  hostile.remarks = {"</article><img src=x onerror=alert(1)>"};
  cohort.add(hostile);
  CaseStatus failed;
  failed.id = "y";
  failed.reason = "<b>&amp;</b>";
  cohort.add(failed);
  const QString page = page_of(cohort);
  QCOMPARE(page.count("<script>"), 1);  // the page's own
  QVERIFY(!page.contains("<img src=x"));
  QVERIFY(!page.contains("<b>&amp;"));
  QVERIFY(page.contains("&lt;b&gt;&amp;amp;&lt;/b&gt;"));
  QCOMPARE(page.count("<article "), 4);
  QVERIFY(!page.contains("src=\"http"));
}

void CohortReviewTest::a_table_holds_no_formula() {
  SmallCohort cohort(1);
  CaseStatus hostile = done("a", 1.0);
  hostile.id = "b";
  hostile.input = "=HYPERLINK(\"http://x\",\"y\")";
  hostile.reason = "@SUM(1)";
  cohort.add(hostile);
  const std::string text = cohort::review_csv(cohort.review());
  const auto table = CsvTable::parse(text, "report.csv");
  QCOMPARE(test::failure(table), QString());
  for (const CsvRow& row : table->rows) {
    for (const std::string& field : row.fields) {
      QVERIFY2(field.empty() || std::string("=@").find(field[0]) == std::string::npos, field.c_str());
    }
  }
}

void CohortReviewTest::pictures_are_in_the_page() {
  SmallCohort cohort(1);
  CaseStatus status = done("p", 1.0);
  status.files = {"overview.png"};
  cohort.add(status);
  QVERIFY(write_file(cohort.folder().case_folder("p") / "overview.png", "PNG"));
  QVERIFY(page_of(cohort).contains("src=\"data:image/png;base64,UE5H\""));
  const auto linked = cohort::report_page(cohort.folder(), {}, cohort.review(), cohort::PagePictures::link);
  QVERIFY(QString::fromStdString(*linked).contains("src=\"cases/p/overview.png\""));
  QCOMPARE(cohort::suitable_pictures(cohort.folder(), cohort.review()), cohort::PagePictures::embed);
}

void CohortReviewTest::decisions_are_read_back() {
  const test::TemporaryFolder folder;
  QVERIFY(write_file(folder / "d.csv",
                     "id,decision,comment\r\na,accept,\"\"\r\nb,reject,\"leaks, \"\"low\"\"\"\r\n"
                     "c,,\"look\"\r\n"));
  const auto decisions = cohort::load_decisions(folder / "d.csv");
  QCOMPARE(test::failure(decisions), QString());
  QCOMPARE(decisions->size(), std::size_t{3});
  QCOMPARE((*decisions)[1].verdict, cohort::Decision::Verdict::rejected);
  QCOMPARE(QString::fromStdString((*decisions)[1].comment), QString("leaks, \"low\""));
}

void CohortReviewTest::wrong_decisions_are_named_by_line_data() {
  QTest::addColumn<QString>("text");
  QTest::addColumn<QString>("why");
  QTest::newRow("columns") << "id,comment\n"
                           << "line 1: the columns must be id, decision, comment";
  QTest::newRow("word") << "id,decision,comment\na,maybe,\n"
                        << "line 2: decision: 'maybe'";
  QTest::newRow("id") << "id,decision,comment\n../a,accept,\n"
                      << "line 2: id: '../a'";
}

void CohortReviewTest::wrong_decisions_are_named_by_line() {
  QFETCH(QString, text);
  QFETCH(QString, why);
  const test::TemporaryFolder folder;
  QVERIFY(write_file(folder / "d.csv", text.toStdString()));
  const QString error = test::failure(cohort::load_decisions(folder / "d.csv"));
  QVERIFY2(error.contains("d.csv: " + why), qPrintable(error));
}

TIDEMARK_TEST(CohortReviewTest)

}  // namespace tidemark::test::cohort_review_test

#include "cohort_review_test.moc"
