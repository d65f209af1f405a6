// A cohort in the desktop whose study a PACS has.
#include <QListView>

#include "document/cohort/case_run.h"
#include "document/cohort/pacs_cases.h"
#include "document/cohort/runner.h"
#include "imaging/phantom/phantom.h"
#include "imaging/results/results.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/imaging/pacs/archives.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/cohort/cohort_panel.h"
#include "ui/settings.h"
#include "ui/widgets/work_line.h"

namespace tidemark::test::cohort_pacs_story_test {

namespace {

namespace fs = std::filesystem;

// One study with a ball, which an archive has; a run has computed it.
class Ball {
 public:
  Ball() : archive_(start_dcmqrscp()) {
    const auto phantom = imaging::make_phantom("sphere");
    if (!phantom) qFatal("%s", phantom.error().message.c_str());
    if (!imaging::send_files(archive_->server(), write_series(phantom->volume, folder_ / "sent"))) {
      qFatal("the series was not sent");
    }
    imaging::PacsConfiguration servers;
    servers.servers.push_back(archive_->server());
    servers.limits.free_bytes = 1 << 20;
    cohort::CohortPlan plan;
    plan.servers_file = folder_ / "pacs.json";
    if (!imaging::write_pacs_configuration(servers, plan.servers_file)) qFatal("no file of servers");
    auto list = cohort::find_in_pacs(archive_->server(), {}, servers.limits);
    if (!list || list->rows.size() != 1) qFatal("the series is not found");
    const auto& [i, j, k, radius_mm] = *phantom->seed;
    row_ = list->rows.front();
    row_.target = 800.0;
    row_.range = 300.0;
    row_.alpha = 0.5;
    row_.seeds_mm = {{phantom->volume.geometry.to_patient({i, j, k}), radius_mm}};
    row_.steps = 40;
    list->rows = {row_};
    if (!folder().write_plan(plan, *list, {})) qFatal("no plan was written");
    const cohort::CaseRun computing{plan, 2, 0, "0", servers};
    const auto ran =
        cohort::run_cohort(folder(), *list, {}, [&](const cohort::WorkRow& row, const fs::path& place) {
          return cohort::run_case(computing, row, place);
        });
    if (!ran || ran->without_result() > 0) qFatal("the case has no result");
  }

  [[nodiscard]] cohort::CohortFolder folder() const { return cohort::CohortFolder(folder_ / "cohort"); }
  [[nodiscard]] const cohort::WorkRow& row() const { return row_; }
  void shut_down() { archive_.reset(); }

 private:
  TemporaryFolder folder_;
  std::unique_ptr<Archive> archive_;
  cohort::WorkRow row_;
};

}  // namespace

class CohortPacsStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_study_comes_from_its_server_once();
};

void CohortPacsStoryTest::a_study_comes_from_its_server_once() {
  Ball ball;
  const TemporaryFolder came;
  Desktop desktop(story_executor(), {1382, 858});
  ui::settings::retrieval_folder().set(QString::fromStdString(came.path().string()));
  desktop.window().open(QString::fromStdString(ball.folder().path().string()));
  const auto panel = [&] { return desktop.window().findChild<ui::CohortPanel*>(); };
  const auto open = [&] {
    auto* list = panel()->findChild<QListView*>();
    const QPoint at = list->visualRect(list->model()->index(0, 0)).center();
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, at);
    QTest::mouseDClick(list->viewport(), Qt::LeftButton, {}, at);
    return Desktop::wait_for([&] { return desktop.window().active_case() && !panel()->work().working(); },
                             60000);
  };
  QVERIFY(Desktop::wait_for([&] { return panel() && panel()->isVisible(); }));
  QVERIFY(open());
  desktop.wait_until_idle();
  QVERIFY(desktop.proxy().origin().path.parent_path() == came.path());
  const auto mask = imaging::load_any_mask(ball.folder().case_folder(ball.row().id) / "mask.nii.gz",
                                           &desktop.proxy().volume().geometry);
  QVERIFY(mask);
  QVERIFY(desktop.state().phi->mask().voxels == mask->mask.voxels);
  desktop.screenshot("cohort-server");

  // The next time it is there.
  ball.shut_down();
  desktop.window().active_case()->close_saved();
  QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().isEmpty(); }));
  QVERIFY(Desktop::wait_for([&] { return desktop.window().actions().accept_case->isEnabled(); }));
  QVERIFY(open());
  desktop.wait_until_idle();
  QVERIFY(desktop.state().phi->mask().voxels == mask->mask.voxels);
}

TIDEMARK_TEST(CohortPacsStoryTest)

}  // namespace tidemark::test::cohort_pacs_story_test

#include "cohort_pacs_story_test.moc"
