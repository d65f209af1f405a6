// A case is compared with a known answer from a file or with one of its labels, while its surface moves.
#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QFileDialog>
#include <QLabel>

#include "core/region.h"
#include "imaging/files/volume_file.h"
#include "imaging/results/results.h"
#include "imaging/results/segments.h"
#include "tests/support/test_program.h"
#include "tests/ui/file_dialog.h"
#include "tests/ui/main/results_desktop.h"
#include "ui/main/message_bar.h"
#include "ui/main/truth_reader.h"
#include "ui/panels/evolution_figures.h"

namespace tidemark::test::truth_story_test {
namespace {

constexpr double kRadius = 8.0;  // mm, of the surface

Mask ball(const Geometry& grid, glm::dvec3 middle_mm, double radius_mm) {
  Mask mask{grid, std::vector<std::uint8_t>(static_cast<std::size_t>(grid.voxel_count()))};
  std::size_t voxel = 0;
  for (std::int64_t k = 0; k < grid.size.z; ++k) {
    for (std::int64_t j = 0; j < grid.size.y; ++j) {
      for (std::int64_t i = 0; i < grid.size.x; ++i) {
        const bool inside = glm::distance(grid.to_patient({i, j, k}), middle_mm) <= radius_mm;
        mask.voxels[voxel++] = inside ? 1 : 0;
      }
    }
  }
  return mask;
}

}  // namespace

class TruthStoryTest : public QObject, ResultsDesktop {
  Q_OBJECT

 private slots:
  void init();
  void cleanup() { close(); }
  void a_mask_from_a_file_is_the_truth();
  void one_of_several_regions_is_chosen();
  void a_label_is_compared_with_as_it_is_now();
  void a_mask_is_of_the_case_for_which_it_was_read();
  void what_does_not_fit_is_said_and_changes_nothing();
  void a_session_keeps_it_until_it_is_taken_back();

 private:
  void choose_file(const QString& file);
  [[nodiscard]] QLabel* figure(const QString& name);
  [[nodiscard]] QString problem() { return desktop_->window().findChild<ui::MessageBar*>()->text(); }
  [[nodiscard]] double dice_now() { return desktop_->state().dice.value_or(-1.0); }
};

void TruthStoryTest::init() {
  open();
  document::Start start;
  start.seeds.push_back({kLeft, kRadius});
  desktop_->proxy().begin(start);
  desktop_->wait_until_idle();
  QVERIFY(!desktop_->state().dice);
}

void TruthStoryTest::choose_file(const QString& file) {
  desktop_->choose("File", desktop_->menu_entry("File", "Compare with a mask"));
  auto* dialog = desktop_->window().findChild<QFileDialog*>();
  QVERIFY(dialog);
  name_file(*dialog, file);
}

// The value beside that name.
QLabel* TruthStoryTest::figure(const QString& name) {
  auto* figures = desktop_->window().findChild<ui::EvolutionFigures*>();
  for (QLabel* value : figures->findChildren<QLabel*>()) {
    if (value->accessibleName() == name && value->isVisible()) return value;
  }
  return nullptr;
}

void TruthStoryTest::a_mask_from_a_file_is_the_truth() {
  const Mask truth = ball(grid(), kLeft + glm::dvec3(2.0, 0.0, 0.0), kRadius);
  QCOMPARE(failure(imaging::write_mask_file(truth, folder_ / "expert.nii.gz")), QString());
  choose_file(path("expert.nii.gz"));
  QVERIFY(Desktop::wait_for([&] { return desktop_->state().dice.has_value(); }, kPatience));
  const double expected = dice(desktop_->state().phi->mask(), truth);
  QVERIFY(expected > 0.5 && expected < 0.95);
  QCOMPARE(dice_now(), expected);
  QVERIFY(desktop_->proxy().display().settings().truth);

  // The panel shows it, with distances.
  QVERIFY(Desktop::wait_for([&] { return figure("Dice") && figure("Hausdorff 95"); }));
  QTRY_COMPARE(figure("Dice")->text().toDouble(), std::round(expected * 1000.0) / 1000.0);
  const auto measured = [&] { return figure("Hausdorff 95")->text().section(QChar(QChar::Nbsp), 0, 0); };
  QVERIFY(Desktop::wait_for([&] { return measured().toDouble() > 0.5; }, kPatience));
  QVERIFY2(measured().toDouble() < 3.0, qPrintable(measured()));
  for (auto* check : desktop_->window().findChildren<QCheckBox*>()) {
    if (check->text() == "Distances to the truth" && check->isVisible()) check->click();
  }
  QVERIFY(desktop_->proxy().display().settings().truth_error);
  desktop_->screenshot("truth-from-a-file");

  // It follows the surface.
  desktop_->proxy().step(5);
  desktop_->wait_until_idle();
  QCOMPARE(dice_now(), dice(desktop_->state().phi->mask(), truth));
  QVERIFY(desktop_->state().curve.points()->back().dice.has_value());

  // Another one takes its place, and the curve is no mixture of both.
  QCOMPARE(failure(imaging::write_mask_file(desktop_->state().phi->mask(), folder_ / "same.nrrd")),
           QString());
  choose_file(path("same.nrrd"));
  QVERIFY(Desktop::wait_for([&] { return dice_now() == 1.0; }, kPatience));
  for (const document::CurvePoint& point : *desktop_->state().curve.points()) QVERIFY(!point.dice);
}

void TruthStoryTest::one_of_several_regions_is_chosen() {
  imaging::Segments segments = imaging::segments_of(ball(grid(), kRight, 5.0), "Cyst");
  segments.list.push_back(imaging::segments_of(ball(grid(), kLeft, kRadius), "Kidney").list[0]);
  const auto map = imaging::label_map_of(segments);
  QVERIFY(map.has_value());
  Volume labels = desktop_->proxy().volume();
  labels.voxels = std::vector<std::int16_t>(map->voxels.begin(), map->voxels.end());
  labels.slope = 1.0;
  labels.intercept = 0.0;
  QCOMPARE(failure(imaging::write_volume_file(labels, folder_ / "labels.nii")), QString());
  choose_file(path("labels.nii"));
  QDialog* question = nullptr;
  QVERIFY(Desktop::wait_for(
      [&] {
        question = desktop_->window().findChild<QDialog*>("true-region");
        return question && question->isVisible();
      },
      kPatience));
  auto* regions = question->findChild<QComboBox*>();
  QCOMPARE(regions->count(), 3);
  desktop_->screenshot_at_once("truth-of-several");
  regions->setCurrentIndex(2);
  question->accept();
  QVERIFY(Desktop::wait_for([&] { return dice_now() > 0.9; }, kPatience));
  QVERIFY(Region(*desktop_->proxy().truth()) == Region(ball(grid(), kLeft, kRadius)));
}

void TruthStoryTest::a_label_is_compared_with_as_it_is_now() {
  QVERIFY(!desktop_->menu_entry("File", "Compare with the chosen label")->isEnabled());
  desktop_->proxy().accept_surface(0, document::Take::free_voxels, "Kidney");
  desktop_->wait_until_idle();
  const Mask label = desktop_->state().phi->mask();
  desktop_->proxy().step(40);
  desktop_->wait_until_idle();
  QVERIFY(!desktop_->state().dice);
  desktop_->choose("File", desktop_->menu_entry("File", "Compare with the chosen label"));
  QVERIFY(Desktop::wait_for([&] { return desktop_->state().dice.has_value(); }, kPatience));
  QVERIFY(dice_now() < 1.0);
  QCOMPARE(dice_now(), dice(desktop_->state().phi->mask(), label));
  QVERIFY(Region(*desktop_->proxy().truth()) == Region(label));
  // What becomes of the label later is another answer, for whoever asks again.
  desktop_->proxy().accept_surface(desktop_->state().labels.front().id);
  desktop_->wait_until_idle();
  QVERIFY(Region(*desktop_->proxy().truth()) == Region(label));
  desktop_->choose("File", desktop_->menu_entry("File", "Stop comparing"));
  desktop_->wait_until_idle();
  QVERIFY(!desktop_->state().dice);
}

// Another case is compared with its label before the mask has been read.
void TruthStoryTest::a_mask_is_of_the_case_for_which_it_was_read() {
  const Mask truth = ball(grid(), kLeft, 6.0);
  QCOMPARE(failure(imaging::write_mask_file(truth, folder_ / "expert.nii.gz")), QString());
  engine::CaseProxy& first = desktop_->proxy();
  ui::CaseWindow* other = desktop_->open_phantom("sphere");
  desktop_->begin(10.0);
  desktop_->proxy().accept_surface(0, document::Take::free_voxels, "Ball");
  desktop_->wait_until_idle();
  const Mask label = desktop_->state().phi->mask();
  auto* reader = desktop_->window().findChild<ui::TruthReader*>();
  reader->read(*window_, path("expert.nii.gz"));
  reader->compare_with_label(*other);
  QVERIFY(Desktop::wait_for([&] { return first.truth() && other->proxy().truth(); }, kPatience));
  QVERIFY(Region(*first.truth()) == Region(truth));
  QVERIFY(Region(*other->proxy().truth()) == Region(label));
  QCOMPARE(desktop_->window().active_case(), other);
  desktop_->wait_until_idle();
  QCOMPARE(dice_now(), 1.0);
}

void TruthStoryTest::what_does_not_fit_is_said_and_changes_nothing() {
  Geometry other = grid();
  other.size.z -= 1;
  QCOMPARE(failure(imaging::write_mask_file(ball(other, kLeft, kRadius), folder_ / "thinner.nii")),
           QString());
  choose_file(path("thinner.nii"));
  QVERIFY(Desktop::wait_for([&] { return !problem().isEmpty(); }, kPatience));
  QVERIFY2(problem().contains("thinner.nii") && problem().contains("grid"), qPrintable(problem()));
  qInfo("%s", qPrintable(problem()));
  QCOMPARE(failure(imaging::write_mask_file(ball(grid(), kLeft, -1.0), folder_ / "empty.nii")), QString());
  choose_file(path("empty.nii"));
  QVERIFY(Desktop::wait_for([&] { return problem().contains("empty.nii"); }, kPatience));
  qInfo("%s", qPrintable(problem()));
  QVERIFY(!desktop_->proxy().truth());
  QVERIFY(!desktop_->state().dice);
}

void TruthStoryTest::a_session_keeps_it_until_it_is_taken_back() {
  const auto stop = [&] { return desktop_->menu_entry("File", "Stop comparing"); };
  QVERIFY(!stop()->isEnabled());
  const Mask truth = ball(grid(), kLeft, 6.0);
  QCOMPARE(failure(imaging::write_mask_file(truth, folder_ / "expert.nii.gz")), QString());
  choose_file(path("expert.nii.gz"));
  QVERIFY(Desktop::wait_for([&] { return dice_now() > 0.0; }, kPatience));
  const double expected = dice_now();
  const auto save = [&](const char* name) {
    window_->session_file = path(name);
    desktop_->press(Qt::Key_S, Qt::ControlModifier);
    const auto is_saved = [&] { return QFile::exists(path(name)) && !desktop_->state().modified; };
    QVERIFY(Desktop::wait_for(is_saved, kPatience));
  };
  const auto open_again = [&](const char* name) {
    desktop_->press(Qt::Key_W, Qt::ControlModifier);
    QVERIFY(Desktop::wait_for([&] { return desktop_->window().cases().isEmpty(); }));
    window_ = desktop_->open(path(name));
    QVERIFY(window_);
    desktop_->wait_until_idle();
  };
  // It would be lost, too.
  save("before.tidemark");
  desktop_->choose("File", stop());
  QVERIFY(Desktop::wait_for([&] { return desktop_->state().modified; }));
  choose_file(path("expert.nii.gz"));
  QVERIFY(Desktop::wait_for([&] { return dice_now() == expected; }, kPatience));
  QVERIFY(desktop_->state().modified);
  save("compared.tidemark");
  // The mask's file is not asked for again.
  std::filesystem::remove(folder_ / "expert.nii.gz");
  open_again("compared.tidemark");
  QVERIFY(desktop_->proxy().truth());
  QVERIFY(Region(*desktop_->proxy().truth()) == Region(truth));
  QVERIFY(Desktop::wait_for([&] { return dice_now() == expected; }, kPatience));
  desktop_->screenshot("truth-from-a-session");

  QVERIFY(Desktop::wait_for([&] { return stop()->isEnabled(); }));
  desktop_->choose("File", stop());
  QVERIFY(Desktop::wait_for([&] { return !desktop_->proxy().truth() && !desktop_->state().dice; }));
  desktop_->wait_until_idle();
  QVERIFY(!desktop_->state().dice);
  QVERIFY(!stop()->isEnabled());
  QVERIFY(!figure("Dice"));
  save("alone.tidemark");
  open_again("alone.tidemark");
  QVERIFY(!desktop_->proxy().truth());
}

TIDEMARK_TEST(TruthStoryTest)

}  // namespace tidemark::test::truth_story_test

#include "truth_story_test.moc"
