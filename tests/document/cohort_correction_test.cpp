// The correction of a case of a cohort by a person, and what people say of cases.
#include <fstream>
#include <thread>

#include "core/atomic_file.h"
#include "document/cohort/case_run.h"
#include "document/cohort/correction.h"
#include "document/cohort/decisions.h"
#include "document/cohort/lease.h"
#include "document/cohort/review_list.h"
#include "document/cohort/runner.h"
#include "document/replay.h"
#include "imaging/files/volume_file.h"
#include "imaging/load_study.h"
#include "imaging/results/results.h"
#include "tests/document/cases.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cohort_correction_test {

using cohort::CaseStatus;
using cohort::CohortFolder;
using cohort::Decision;
using Verdict = cohort::Decision::Verdict;

namespace {

namespace fs = std::filesystem;

// Two lumpy balls that a run has computed; the third case cannot be read.
class LumpyCohort {
 public:
  LumpyCohort() {
    const auto volume = lumpy_volume();
    if (!imaging::write_volume_file(*volume, folder_ / "lumpy.nii.gz")) qFatal("no volume was written");
    std::ofstream(folder_ / "broken.nii.gz") << "no volume";
    for (const char* id : {"one", "two", "broken"}) {
      cohort::WorkRow row;
      row.id = id;
      row.input = folder_ / (row.id == "broken" ? "broken.nii.gz" : "lumpy.nii.gz");
      const solver::Parameters parameters = lumpy_parameters();
      row.target = parameters.target;
      row.range = parameters.range;
      row.alpha = parameters.alpha;
      const solver::Sphere seed = ball_at(*volume, {1.3, -0.7, 0.4}, 5.0);
      row.seeds_mm = {{seed.centre_mm, seed.radius_mm}};
      row.steps = 40;
      list_.rows.push_back(row);
    }
    plan_.outputs = {cohort::CaseOutput::surface};
    if (!folder().write_plan(plan_, list_, {})) qFatal("no plan was written");
    if (const auto ran = run(); !ran) qFatal("%s", ran.error().message.c_str());
  }

  [[nodiscard]] CohortFolder folder() const { return CohortFolder(folder_ / "cohort"); }
  [[nodiscard]] const cohort::CohortPlan& plan() const { return plan_; }
  [[nodiscard]] const cohort::WorkRow& row(std::size_t number) const { return list_.rows[number]; }
  [[nodiscard]] Result<cohort::RunTally> run() const {
    const cohort::CaseRun computing{plan_, 1, 0, "0"};
    return cohort::run_cohort(folder(), list_, {}, [&](const cohort::WorkRow& row, const fs::path& place) {
      return cohort::run_case(computing, row, place);
    });
  }
  // The case as the desktop opens it.
  [[nodiscard]] Result<document::SessionContents> opened(const std::string& id) const {
    auto volume = imaging::load_volume(folder_ / "lumpy.nii.gz");
    if (!volume) return pass_on(volume);
    auto recipe = document::Recipe::load(folder().case_recipe(id));
    if (!recipe) return pass_on(recipe);
    return document::replay(std::move(*recipe), std::make_shared<const Volume>(std::move(*volume)), {});
  }
  // The same with a part cut off, by somebody who has seen what is there now, or something else.
  Result<CaseStatus> correct(std::size_t number, double cut_mm) const {
    return correct(number, cut_mm, status(folder().status(row(number).id)));
  }
  Result<CaseStatus> correct(std::size_t number, double cut_mm, const std::optional<CaseStatus>& seen,
                             const std::string& from = "one") const {
    auto contents = opened(from);
    if (!contents) return pass_on(contents);
    const auto volume = imaging::load_volume(folder_ / "lumpy.nii.gz");
    const Geometry& grid = volume->geometry;
    const solver::Sphere ball = ball_at(*volume, {6.0, 0.0, 0.0}, cut_mm);
    const double band = contents->phi->band;
    std::vector<float> values = contents->phi->dense();
    for (std::int64_t at = 0; at < grid.voxel_count(); ++at) {
      const glm::dvec3 place = grid.to_patient(glm::dvec3(grid.voxel_at(at)));
      const double outside = std::clamp(glm::distance(place, ball.centre_mm) - ball.radius_mm, -band, band);
      float& phi = values[static_cast<std::size_t>(at)];
      phi = std::min(phi, static_cast<float>(outside));
    }
    const solver::Field cut = solver::Field::from_dense(grid, values, band);
    const cohort::CaseResult result{*volume, cut, solver::measure(cut), contents->recipe, {}};
    return cohort::correct_case(folder(), plan_, row(number), seen, result, "1");
  }
  [[nodiscard]] CaseStatus status(const fs::path& file) const {
    auto status = CaseStatus::load(file);
    if (!status) qFatal("%s", status.error().message.c_str());
    return std::move(*status);
  }
  [[nodiscard]] int leases() const {
    return static_cast<int>(std::distance(fs::directory_iterator(folder().leases()), {}));
  }

 private:
  test::TemporaryFolder folder_;
  cohort::WorkList list_;
  cohort::CohortPlan plan_;
};

}  // namespace

class CohortCorrectionTest : public QObject {
  Q_OBJECT

 private slots:
  void a_case_opens_as_the_run_has_left_it() {
    const LumpyCohort cohort;
    const auto contents = cohort.opened("one");
    QCOMPARE(failure(contents), QString());
    const Geometry& grid = contents->geometry;
    const auto mask = imaging::load_any_mask(cohort.folder().case_folder("one") / "mask.nii.gz", &grid);
    QCOMPARE(failure(mask), QString());
    QVERIFY(contents->phi->mask().voxels == mask->mask.voxels);
    QCOMPARE(contents->recipe.steps, std::int64_t{40});
  }

  void a_correction_takes_the_runs_place_and_both_are_kept() {
    const LumpyCohort cohort;
    const fs::path place = cohort.folder().case_folder("one");
    const QByteArray mask = bytes_of(place / "mask.nii.gz");
    const QByteArray recipe = bytes_of(place / "recipe.json");
    const CaseStatus before = cohort.status(place / "status.json");
    QVERIFY(!before.corrected);

    const auto corrected = cohort.correct(0, 6.0);
    QCOMPARE(failure(corrected), QString());
    const CaseStatus now = cohort.status(place / "status.json");
    QVERIFY(now == *corrected);
    QVERIFY(now.corrected);
    QCOMPARE(now.input_checksum, before.input_checksum);
    QVERIFY(now.figures->volume_ml < 0.99 * before.figures->volume_ml);
    QVERIFY(now.figures->mean_inside && now.figures->mean_inside != before.figures->mean_inside);
    for (const std::string& file : now.files) QVERIFY2(fs::exists(place / file), file.c_str());
    QCOMPARE(now.files.size(), std::size_t{4});  // mask, surface, recipe, picture
    QVERIFY(bytes_of(place / "mask.nii.gz") != mask);
    QCOMPARE(bytes_of(place / "automatic" / "mask.nii.gz"), mask);
    QCOMPARE(bytes_of(place / "automatic" / "recipe.json"), recipe);
    QVERIFY(cohort.status(place / "automatic" / "status.json") == before);

    // However often: the run's stays.
    const QByteArray first = bytes_of(place / "mask.nii.gz");
    QCOMPARE(failure(cohort.correct(0, 4.0)), QString());
    QVERIFY(bytes_of(place / "mask.nii.gz") != first);
    QCOMPARE(bytes_of(place / "automatic" / "mask.nii.gz"), mask);
    QVERIFY(!fs::exists(place / "automatic" / "automatic"));

    // A run has nothing to do with it any more.
    const auto ran = cohort.run();
    QCOMPARE(failure(ran), QString());
    QCOMPARE(ran->computed(), std::int64_t{0});
    QVERIFY(cohort.status(place / "status.json").corrected);
    QCOMPARE(cohort.leases(), 0);
  }

  void a_case_without_a_result_gets_one() {
    const LumpyCohort cohort;
    QCOMPARE(failure(cohort.correct(2, 4.0)), QString());
    const fs::path place = cohort.folder().case_folder("broken");
    const CaseStatus now = cohort.status(place / "status.json");
    QCOMPARE(now.outcome, cohort::CaseOutcome::done);
    QVERIFY(now.reason.empty());
    QCOMPARE(cohort.status(place / "automatic" / "status.json").outcome, cohort::CaseOutcome::refused);
  }

  void a_case_that_no_run_has_computed_has_no_automatic_result() {
    const LumpyCohort cohort;
    fs::remove_all(cohort.folder().case_folder("one"));
    QCOMPARE(failure(cohort.correct(0, 6.0, std::nullopt, "two")), QString());
    QCOMPARE(failure(cohort.correct(0, 4.0)), QString());
    QVERIFY(!fs::exists(cohort.folder().automatic("one")));
  }

  void who_has_seen_another_result_replaces_nothing() {
    const LumpyCohort cohort;
    const CaseStatus seen = cohort.status(cohort.folder().status("one"));
    QCOMPARE(failure(cohort.correct(0, 6.0)), QString());
    const QByteArray mask = bytes_of(cohort.folder().case_folder("one") / "mask.nii.gz");
    const QString told("one: has another result now; open it again");
    QCOMPARE(failure(cohort.correct(0, 4.0, seen)), told);
    QCOMPARE(failure(cohort.correct(0, 4.0, std::nullopt)), told);
    QCOMPARE(bytes_of(cohort.folder().case_folder("one") / "mask.nii.gz"), mask);
  }

  void what_cannot_be_a_correction_changes_nothing() {
    const LumpyCohort cohort;
    const fs::path place = cohort.folder().case_folder("one");
    const QByteArray mask = bytes_of(place / "mask.nii.gz");
    QCOMPARE(failure(cohort.correct(0, 100.0)), QString("one: nothing is inside of the surface"));
    {
      const auto held = cohort::Lease::take(cohort.folder().leases(), "one", 300.0);
      QVERIFY(held && *held);
      QCOMPARE(failure(cohort.correct(0, 6.0)), QString("one: is computed by a run now"));
    }
    QCOMPARE(bytes_of(place / "mask.nii.gz"), mask);
    QVERIFY(!fs::exists(cohort.folder().automatic("one")));
  }

  void what_was_said_is_kept_case_by_case() {
    const LumpyCohort cohort;
    const CohortFolder folder = cohort.folder();
    QVERIFY(cohort::load_decisions(folder)->empty());
    const Decision leaks{"two", Verdict::rejected, "leaks, \"much\"\nbelow"};
    const Decision right{"one", Verdict::accepted, "-5 HU"};  // no formula of a spreadsheet
    QVERIFY(cohort::decide(folder, {"two", {}, {}}, leaks));
    QVERIFY(cohort::decide(folder, {"one", {}, {}}, right));
    QVERIFY(cohort::decide(folder, leaks, {"two", Verdict::accepted, "after all"}));
    QCOMPARE(failure(cohort::decide(folder, leaks, {"two", Verdict::rejected, {}})),
             QString("two: somebody else has spoken of this case meanwhile"));
    const auto decisions = cohort::load_decisions(folder);
    QCOMPARE(failure(decisions), QString());
    QVERIFY((*decisions == std::vector<Decision>{right, {"two", Verdict::accepted, "after all"}}));
    QVERIFY(cohort::decide(folder, right, {"one", Verdict::none, {}}));
    QCOMPARE(cohort::load_decisions(folder)->size(), std::size_t{1});

    const auto list = cohort::load_review_list(folder);
    QCOMPARE(failure(list), QString());
    QCOMPARE(list->entries.size(), std::size_t{3});
    QCOMPARE(list->entries.front().row.id, std::string("broken"));  // no result comes first
    const auto two = std::find_if(list->entries.begin(), list->entries.end(),
                                  [](const auto& entry) { return entry.row.id == "two"; });
    QCOMPARE(two->decision.comment, std::string("after all"));
  }

  void nothing_is_lost_where_many_speak_at_once() {
    const LumpyCohort cohort;
    std::vector<std::thread> people;
    for (int person = 0; person < 4; ++person) {
      people.emplace_back([&, person] {
        for (int i = 0; i < 10; ++i) {
          const std::string id = fmt::format("p{}-{}", person, i);
          const Status said = cohort::decide(cohort.folder(), {id, {}, {}}, {id, Verdict::accepted, {}});
          if (!said) qFatal("%s", said.error().message.c_str());
        }
      });
    }
    for (std::thread& person : people) person.join();
    QCOMPARE(cohort::load_decisions(cohort.folder())->size(), std::size_t{40});
    QCOMPARE(cohort.leases(), 0);
  }
};

TIDEMARK_TEST(CohortCorrectionTest)

}  // namespace tidemark::test::cohort_correction_test

#include "cohort_correction_test.moc"
