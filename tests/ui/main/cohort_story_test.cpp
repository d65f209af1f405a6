// A cohort in the desktop: a person goes through its cases, accepts, rejects, corrects and comments.
#include <QDockWidget>
#include <QLineEdit>
#include <QListView>
#include <fstream>

#include "document/cohort/case_run.h"
#include "document/cohort/decisions.h"
#include "document/cohort/runner.h"
#include "document/evolution.h"
#include "imaging/files/volume_file.h"
#include "imaging/load_study.h"
#include "imaging/phantom/phantom.h"
#include "imaging/results/results.h"
#include "tests/support/test_program.h"
#include "tests/ui/file_dialog.h"
#include "tests/ui/main/desktop.h"
#include "tests/ui/main/story_language.h"
#include "tests/ui/main/student.h"
#include "ui/cohort/cohort_panel.h"
#include "ui/main/cohort_review.h"
#include "ui/widgets/work_line.h"

namespace tidemark::test::cohort_story_test {

using Verdict = cohort::Decision::Verdict;

namespace {

namespace fs = std::filesystem;

// Four studies with a ball, of which the last cannot be read; a run has computed all of them.
class Balls {
 public:
  Balls() {
    const auto phantom = imaging::make_phantom("sphere");
    if (!phantom) qFatal("%s", phantom.error().message.c_str());
    const auto& [i, j, k, radius_mm] = *phantom->seed;
    const glm::dvec3 seed = phantom->volume.geometry.to_patient({i, j, k});
    for (const char* id : {"anna", "berta", "clara", "dora"}) {
      cohort::WorkRow row;
      row.id = id;
      row.input = folder_ / (row.id + ".nii.gz");
      if (row.id == "dora") {
        std::ofstream(row.input) << "no volume";
      } else if (!imaging::write_volume_file(phantom->volume, row.input)) {
        qFatal("no volume was written");
      }
      row.target = 800.0;
      row.range = 300.0;
      row.alpha = 0.5;
      row.seeds_mm = {{seed, radius_mm}};
      row.steps = 40 + 20 * static_cast<std::int64_t>(list_.rows.size());
      list_.rows.push_back(row);
    }
    const cohort::CohortPlan plan;
    if (!folder().write_plan(plan, list_, {})) qFatal("no plan was written");
    const cohort::CaseRun computing{plan, 2, 0, "0"};
    const auto ran =
        cohort::run_cohort(folder(), list_, {}, [&](const cohort::WorkRow& row, const fs::path& place) {
          return cohort::run_case(computing, row, place);
        });
    if (!ran) qFatal("%s", ran.error().message.c_str());
  }

  [[nodiscard]] cohort::CohortFolder folder() const { return cohort::CohortFolder(folder_ / "cohort"); }
  [[nodiscard]] QString path() const { return QString::fromStdString(folder().path().string()); }
  [[nodiscard]] cohort::CaseStatus status(const std::string& id) const {
    auto status = cohort::CaseStatus::load(folder().status(id));
    if (!status) qFatal("%s", status.error().message.c_str());
    return std::move(*status);
  }
  // What the folder keeps of a case.
  [[nodiscard]] cohort::Decision said_of(const std::string& id) const {
    const auto decisions = cohort::load_decisions(folder());
    if (!decisions) qFatal("%s", decisions.error().message.c_str());
    for (const cohort::Decision& decision : *decisions) {
      if (decision.id == id) return decision;
    }
    return {id, Verdict::none, {}};
  }
  [[nodiscard]] bool is_said(const std::string& id, Verdict verdict, const std::string& comment = {}) const {
    return Desktop::wait_for([&] { return said_of(id) == cohort::Decision{id, verdict, comment}; });
  }

 private:
  test::TemporaryFolder folder_;
  cohort::WorkList list_;
};

}  // namespace

class CohortStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { balls_ = std::make_unique<Balls>(); }
  void cases_are_looked_at_and_spoken_of();
  void a_surface_is_corrected();
  void nothing_is_said_of_a_case_that_is_not_seen();
  void a_changed_surface_is_not_left_without_a_question();
  void a_second_correction_is_not_left_without_a_question();
  void what_the_cohort_does_not_keep_stays_open();
  void a_measurement_is_not_lost_with_the_surface_data();
  void a_measurement_is_not_lost_with_the_surface();
  void it_stays_open_when_the_language_changes();
  void a_folder_that_is_no_cohort_is_refused();

 private:
  static ui::CohortPanel* panel(Desktop& desktop) { return desktop.window().findChild<ui::CohortPanel*>(); }
  static bool opens(Desktop& desktop, const std::string& id);
  bool open(Desktop& desktop) const;
  // A row of the list by its text.
  static int row_of(Desktop& desktop, const QString& id);
  static void click_row(Desktop& desktop, int row, bool twice);
  static bool enabled(Desktop& desktop, const QString& button);

  std::unique_ptr<Balls> balls_;
};

// By the menu and its dialog.
bool CohortStoryTest::open(Desktop& desktop) const {
  name_file_when_asked(QString::fromStdString(balls_->folder().path().string()));
  desktop.window().actions().open_cohort->trigger();
  return Desktop::wait_for([&] { return panel(desktop) && panel(desktop)->isVisible(); });
}

bool CohortStoryTest::opens(Desktop& desktop, const std::string& id) {
  const bool opened = Desktop::wait_for(
      [&] {
        const auto* active = desktop.window().active_case();
        return active && active->isVisible() && !panel(desktop)->work().working() &&
               desktop.proxy().origin().path.stem().stem() == id;
      },
      60000);
  desktop.wait_until_idle();
  return opened;
}

int CohortStoryTest::row_of(Desktop& desktop, const QString& id) {
  const auto* model = panel(desktop)->findChild<QListView*>()->model();
  for (int row = 0; row < model->rowCount(); ++row) {
    if (model->index(row, 0).data().toString().startsWith(id)) return row;
  }
  return -1;
}

void CohortStoryTest::click_row(Desktop& desktop, int row, bool twice) {
  auto* list = panel(desktop)->findChild<QListView*>();
  const QModelIndex index = list->model()->index(row, 0);
  list->scrollTo(index);
  const QPoint at = list->visualRect(index).center();
  QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, at);
  if (twice) QTest::mouseDClick(list->viewport(), Qt::LeftButton, {}, at);
}

bool CohortStoryTest::enabled(Desktop& desktop, const QString& button) {
  const auto* found = find_seen<QAbstractButton>(*panel(desktop), button);
  return found && found->isEnabled();
}

void CohortStoryTest::cases_are_looked_at_and_spoken_of() {
  Desktop desktop(story_executor(), {1382, 858});
  QVERIFY(open(desktop));
  desktop.wait_until_idle();
  desktop.screenshot("cohort-1-list");
  QCOMPARE(row_of(desktop, "dora"), 0);  // without a result, hence before all others
  QVERIFY(!enabled(desktop, in_story_language("&Reject the case")));  // none is chosen
  click_row(desktop, 0, false);
  QVERIFY(!enabled(desktop, in_story_language("&Accept the case")));
  QVERIFY(enabled(desktop, in_story_language("&Reject the case")));
  QTest::mouseClick(find_seen<QAbstractButton>(*panel(desktop), in_story_language("&Reject the case")),
                    Qt::LeftButton);
  QVERIFY(balls_->is_said("dora", Verdict::rejected));

  // By its picture alone, before any is open.
  click_row(desktop, row_of(desktop, "clara"), false);
  QVERIFY(enabled(desktop, in_story_language("&Accept the case")));
  QTest::mouseClick(find_seen<QAbstractButton>(*panel(desktop), in_story_language("&Accept the case")),
                    Qt::LeftButton);
  QVERIFY(balls_->is_said("clara", Verdict::accepted));

  // One is opened with its result, to the last bit.
  click_row(desktop, row_of(desktop, "anna"), true);
  QVERIFY(opens(desktop, "anna"));
  QVERIFY(desktop.state().begun);
  QVERIFY(!desktop.state().modified);
  QCOMPARE(desktop.state().step, std::int64_t{40});
  const auto mask = imaging::load_any_mask(balls_->folder().case_folder("anna") / "mask.nii.gz",
                                           &desktop.proxy().volume().geometry);
  QVERIFY(mask);
  QVERIFY(desktop.state().phi->mask().voxels == mask->mask.voxels);
  desktop.screenshot("cohort-2-case");
  auto* comment = find_seen<QLineEdit>(*panel(desktop), in_story_language("Comment on the case"));
  QVERIFY(comment);
  comment->setFocus();
  QTest::keyClicks(comment, "small, but right");
  QTest::keyClick(comment, Qt::Key_Return);
  QVERIFY(balls_->is_said("anna", Verdict::none, "small, but right"));
  desktop.window().active_case()->setFocus();
  desktop.press(Qt::Key_A, Qt::ShiftModifier);
  QVERIFY(balls_->is_said("anna", Verdict::accepted, "small, but right"));

  // N goes on, and takes the case before away.
  const int next = row_of(desktop, "anna") + 1;
  desktop.press(Qt::Key_N);
  const QString id = panel(desktop)->findChild<QListView*>()->model()->index(next, 0).data().toString();
  QVERIFY(opens(desktop, id.section('\n', 0, 0).toStdString()));
  QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().size() == 1; }));
  desktop.press(Qt::Key_N, Qt::ShiftModifier);
  QVERIFY(opens(desktop, "anna"));
  desktop.screenshot("cohort-3-said");

  // A panel that was closed comes back by the menu.
  auto* dock = desktop.window().findChild<QDockWidget*>("cohort");
  dock->close();
  QVERIFY(!panel(desktop)->isVisible());
  desktop.window().actions().show_cohort->trigger();
  QVERIFY(panel(desktop)->isVisible());
}

void CohortStoryTest::a_surface_is_corrected() {
  Desktop desktop(story_executor(), {1382, 858});
  desktop.window().open(balls_->path());
  QVERIFY(Desktop::wait_for([&] { return panel(desktop) != nullptr; }));
  click_row(desktop, row_of(desktop, "berta"), true);
  QVERIFY(opens(desktop, "berta"));
  const cohort::CaseStatus before = balls_->status("berta");
  const fs::path place = balls_->folder().case_folder("berta");
  const QByteArray mask = bytes_of(place / "mask.nii.gz");

  // A part is taken away with the brush.
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial);
  desktop.press(Qt::Key_E);
  const glm::dvec3 middle = desktop.proxy().display().settings().cursor_mm;
  Desktop::drag(*axial, {middle, middle + glm::dvec3(3, 0, 0), middle + glm::dvec3(6, 0, 0)});
  desktop.wait_until_idle();
  QVERIFY(desktop.state().modified);
  QVERIFY(Desktop::wait_for([&] { return enabled(desktop, in_story_language("Accept the correction")); }));
  desktop.screenshot("cohort-4-changed");
  QTest::mouseClick(find_seen<QAbstractButton>(*panel(desktop), in_story_language("Accept the correction")),
                    Qt::LeftButton);
  QVERIFY(balls_->is_said("berta", Verdict::accepted));
  const cohort::CaseStatus now = balls_->status("berta");
  QVERIFY(now.corrected);
  QVERIFY(now.figures->volume_ml < before.figures->volume_ml);
  QVERIFY(bytes_of(place / "mask.nii.gz") != mask);
  QCOMPARE(bytes_of(place / "automatic" / "mask.nii.gz"), mask);
  QVERIFY(Desktop::wait_for([&] { return !desktop.state().modified; }));
  QVERIFY(Desktop::wait_for([&] { return enabled(desktop, in_story_language("&Accept the case")); }));
  desktop.screenshot("cohort-5-corrected");
  Desktop::keep_picture(*desktop.window().findChild<QDockWidget*>("cohort"));

  // The recipe beside it makes the same voxels.
  const auto contents = document::Recipe::load(place / "recipe.json");
  QCOMPARE(failure(contents), QString());
  const auto volume = imaging::load_volume(before.input);
  QVERIFY(volume);
  const auto again = document::evolve(*contents, std::make_shared<const Volume>(*volume), {});
  QCOMPARE(failure(again), QString());
  const auto corrected = imaging::load_any_mask(place / "mask.nii.gz", &volume->geometry);
  QVERIFY(corrected);
  QVERIFY(again->phi.mask().voxels == corrected->mask.voxels);

  // Opened again it is the corrected one. It was left without a question.
  click_row(desktop, row_of(desktop, "anna"), true);
  QVERIFY(opens(desktop, "anna"));
  click_row(desktop, row_of(desktop, "berta"), true);
  QVERIFY(opens(desktop, "berta"));
  QVERIFY(desktop.state().phi->mask().voxels == corrected->mask.voxels);
}

void CohortStoryTest::nothing_is_said_of_a_case_that_is_not_seen() {
  Desktop desktop(story_executor(), {1382, 858});
  desktop.window().open(balls_->path());
  QVERIFY(Desktop::wait_for([&] { return panel(desktop) != nullptr; }));
  click_row(desktop, row_of(desktop, "anna"), true);
  QVERIFY(opens(desktop, "anna"));
  QVERIFY(enabled(desktop, in_story_language("&Reject the case")));
  // Another row is chosen, and not opened.
  click_row(desktop, row_of(desktop, "clara"), false);
  QVERIFY(!enabled(desktop, in_story_language("&Reject the case")));
  QVERIFY(!enabled(desktop, in_story_language("&Accept the case")));
  const cohort::Decision before = balls_->said_of("clara");
  desktop.press(Qt::Key_R, Qt::ShiftModifier);
  desktop.wait_until_idle();
  QVERIFY(balls_->said_of("clara") == before);
  // Another study is the active one.
  click_row(desktop, row_of(desktop, "anna"), false);
  QVERIFY(enabled(desktop, in_story_language("&Reject the case")));
  QVERIFY(desktop.open_phantom("sphere"));
  QVERIFY(Desktop::wait_for([&] { return !enabled(desktop, in_story_language("&Reject the case")); }));
  const cohort::Decision anna = balls_->said_of("anna");
  desktop.press(Qt::Key_R, Qt::ShiftModifier);
  desktop.wait_until_idle();
  QVERIFY(balls_->said_of("anna") == anna);
}

void CohortStoryTest::a_changed_surface_is_not_left_without_a_question() {
  Desktop desktop(story_executor(), {1382, 858});
  desktop.window().open(balls_->path());
  QVERIFY(Desktop::wait_for([&] { return panel(desktop) != nullptr; }));
  click_row(desktop, row_of(desktop, "clara"), true);
  QVERIFY(opens(desktop, "clara"));
  desktop.proxy().step(3);
  desktop.wait_until_idle();
  QVERIFY(desktop.state().modified);
  Desktop::answer(QMessageBox::Cancel);
  click_row(desktop, row_of(desktop, "anna"), true);
  desktop.wait_until_idle();
  QCOMPARE(desktop.window().cases().size(), 1);
  QCOMPARE(desktop.proxy().origin().path.stem().stem().string(), std::string("clara"));
  QCOMPARE(panel(desktop)->row(), row_of(desktop, "clara"));
  Desktop::answer(QMessageBox::Discard);
  click_row(desktop, row_of(desktop, "anna"), true);
  QVERIFY(opens(desktop, "anna"));
  QVERIFY(!balls_->status("clara").corrected);
}

// In place of the first one, which was taken back: with as many steps and edits.
void CohortStoryTest::a_second_correction_is_not_left_without_a_question() {
  Desktop desktop(story_executor(), {1382, 858});
  desktop.window().open(balls_->path());
  QVERIFY(Desktop::wait_for([&] { return panel(desktop) != nullptr; }));
  click_row(desktop, row_of(desktop, "anna"), true);
  QVERIFY(opens(desktop, "anna"));
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial);
  desktop.press(Qt::Key_S);
  const glm::dvec3 middle = desktop.proxy().display().settings().cursor_mm;
  const auto add_sphere = [&](double x) {
    const glm::dvec3 place = middle + glm::dvec3(x, 0.0, 0.0);
    Desktop::drag(*axial, {place, place + glm::dvec3(5.0, 0.0, 0.0)});
    desktop.wait_until_idle();
  };
  const auto is_correction = [&] { return enabled(desktop, in_story_language("Accept the correction")); };
  add_sphere(26.0);
  QVERIFY(Desktop::wait_for(is_correction));
  desktop.press(Qt::Key_A, Qt::ShiftModifier);
  QVERIFY(Desktop::wait_for(
      [&] { return !desktop.state().modified && enabled(desktop, in_story_language("&Accept the case")); }));
  QVERIFY(balls_->status("anna").corrected);

  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  add_sphere(-26.0);
  QVERIFY(Desktop::wait_for(is_correction));
  Desktop::answer(QMessageBox::Cancel);
  click_row(desktop, row_of(desktop, "berta"), true);
  desktop.wait_until_idle();
  QCOMPARE(desktop.window().cases().size(), 1);
  QCOMPARE(desktop.proxy().origin().path.stem().stem().string(), std::string("anna"));
}

void CohortStoryTest::what_the_cohort_does_not_keep_stays_open() {
  Desktop desktop(story_executor(), {1382, 858});
  desktop.window().open(balls_->path());
  QVERIFY(Desktop::wait_for([&] { return panel(desktop) != nullptr; }));
  click_row(desktop, row_of(desktop, "clara"), true);
  QVERIFY(opens(desktop, "clara"));
  ui::CaseWindow* const clara = desktop.window().active_case();
  clara->proxy().display().change([](engine::DisplaySettings& settings) {
    settings.measurements = {{engine::Measurement::Kind::distance, {glm::dvec3(0.0), glm::dvec3(5.0)}}};
  });
  QVERIFY(enabled(desktop, in_story_language("&Accept the case")));  // the surface is as it was
  click_row(desktop, row_of(desktop, "berta"), true);
  QVERIFY(opens(desktop, "berta"));
  QVERIFY(desktop.window().cases().contains(clara));
}

void CohortStoryTest::a_measurement_is_not_lost_with_the_surface_data() {
  QTest::addColumn<bool>("accepts");
  QTest::newRow("accepted") << true;
  QTest::newRow("discarded") << false;
}
void CohortStoryTest::a_measurement_is_not_lost_with_the_surface() {
  QFETCH(bool, accepts);
  Desktop desktop(story_executor(), {1382, 858});
  desktop.window().open(balls_->path());
  QVERIFY(Desktop::wait_for([&] { return panel(desktop) != nullptr; }));
  click_row(desktop, row_of(desktop, "anna"), true);
  QVERIFY(opens(desktop, "anna"));
  ui::CaseWindow* const anna = desktop.window().active_case();
  anna->proxy().display().change([](engine::DisplaySettings& settings) {
    settings.measurements = {{engine::Measurement::Kind::distance, {glm::dvec3(0.0), glm::dvec3(5.0)}}};
  });
  const glm::dvec3 middle = anna->proxy().display().settings().cursor_mm;
  anna->proxy().paint({middle + glm::dvec3(accepts ? 20.0 : -20.0, 0.0, 0.0), 5.0}, solver::Brush::add,
                      engine::CaseProxy::new_gesture());
  desktop.wait_until_idle();
  QVERIFY(Desktop::wait_for([&] { return enabled(desktop, in_story_language("Accept the correction")); }));
  if (accepts) {
    desktop.press(Qt::Key_A, Qt::ShiftModifier);
    QVERIFY(Desktop::wait_for([&] { return enabled(desktop, in_story_language("&Accept the case")); }));
    desktop.wait_until_idle();
    QVERIFY(desktop.state().modified);
  } else {
    Desktop::answer(QMessageBox::Discard);
  }
  click_row(desktop, row_of(desktop, "berta"), true);
  QVERIFY(opens(desktop, "berta"));
  QVERIFY(desktop.window().cases().contains(anna));
}

void CohortStoryTest::it_stays_open_when_the_language_changes() {
  const Variable language("TIDEMARK_STORY_LANGUAGE", "de");
  Desktop desktop(story_executor(), {1382, 858});
  desktop.window().open(balls_->path());
  QVERIFY(Desktop::wait_for([&] { return panel(desktop) != nullptr; }));
  click_row(desktop, row_of(desktop, "anna"), true);
  QVERIFY(opens(desktop, "anna"));
  const engine::CaseProxy* before = &desktop.proxy();
  for (QAction* action : desktop.window().actions().languages->actions()) {
    if (action->text() == "English") action->trigger();
  }
  QVERIFY(Desktop::wait_for(
      [&] { return panel(desktop) && enabled(desktop, in_story_language("&Reject the case")); }, 60000));
  // To make a window takes longer than an event may.
  WatchedApplication::instance().forget_held();
  QCOMPARE(&desktop.proxy(), before);
  QCOMPARE(panel(desktop)->row(), row_of(desktop, "anna"));
  QVERIFY(enabled(desktop, in_story_language("&Accept the case")));  // it was not changed
}

void CohortStoryTest::a_folder_that_is_no_cohort_is_refused() {
  const TemporaryFolder folder;
  Desktop desktop(story_executor(), {1000, 700});
  desktop.window().cohort().open(QString::fromStdString(folder.path().string()));
  QVERIFY(Desktop::wait_for([&] {
    for (const QLabel* label : desktop.window().findChildren<QLabel*>()) {
      if (label->isVisible() && label->text().contains("is no cohort")) return true;
    }
    return false;
  }));
  QVERIFY(!panel(desktop));
}

TIDEMARK_TEST(CohortStoryTest)

}  // namespace tidemark::test::cohort_story_test

#include "cohort_story_test.moc"
