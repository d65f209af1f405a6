// What drives a level set, and what holds it, can be changed, taken back and made again.
#include "document/drive.h"

#include "core/index_walk.h"
#include "solver/speed/speed_registry.h"
#include "tests/document/cases.h"
#include "tests/support/test_program.h"

namespace tidemark::test::drive_test {

class DriveTest : public QObject {
  Q_OBJECT

  // The phi of a voxel in the middle of that wall.
  static float phi_at(const document::Case& document, glm::dvec3 off_mm) {
    const Volume& volume = *document.volume();
    const glm::dvec3 voxel = volume.geometry.to_voxel(ball_at(volume, off_mm, 1.0).centre_mm);
    return document.level_set().executor().snapshot().value().at(Index3(glm::round(voxel)));
  }

 private slots:
  void a_wall_holds_and_undo_takes_it_away() {
    auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    const glm::dvec3 place{1.3, -0.7, 0.4};  // in the middle of the seed
    run(level_set, 10);
    QVERIFY(phi_at(*document, place) > 0.0F);
    QCOMPARE(failure(level_set.set_drive(with_wall(*document, place, 3.0))), QString());
    QCOMPARE(undo_text(*document), std::string("walls and anchors"));
    QVERIFY(phi_at(*document, place) < 0.0F);
    run(level_set, 50);
    QVERIFY(phi_at(*document, place) < 0.0F);
    const Seen held(level_set);
    QCOMPARE(failure(document->undo()), QString());  // the steps
    QCOMPARE(failure(document->undo()), QString());
    QVERIFY(!level_set.drive().constraints);
    QVERIFY(!level_set.executor().constraints());
    QVERIFY(phi_at(*document, place) > 0.0F);
    QCOMPARE(failure(document->redo()), QString());
    QCOMPARE(failure(document->redo()), QString());
    QVERIFY(level_set.drive().constraints);
    QVERIFY(Seen(level_set) == held);
  }

  void a_wall_that_follows_the_eraser_is_one_entry_with_it() {
    auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    run(level_set, 5);
    const Seen before(level_set);
    const glm::dvec3 place{1.3, -0.7, 0.4};
    const std::uint64_t gesture = 77;
    QCOMPARE(
        failure(level_set.paint(ball_at(*document->volume(), place, 3.0), solver::Brush::erase, gesture)),
        QString());
    QCOMPARE(failure(level_set.set_drive(with_wall(*document, place, 3.0), gesture)), QString());
    QCOMPARE(failure(document->history().close()), QString());
    QCOMPARE(undo_text(*document), std::string("erase"));
    QCOMPARE(failure(document->undo()), QString());
    QVERIFY(Seen(level_set) == before);
    QVERIFY(!level_set.drive().constraints);
  }

  void strokes_are_an_entry_before_there_is_a_surface() {
    auto document = make_case(lumpy_volume());
    document::LevelSet& level_set = document->level_set();
    document::Drive drive;
    drive.strokes = std::make_shared<const solver::Strokes>(solver::Strokes{{1, 2, 3}, {}});
    QCOMPARE(failure(level_set.set_drive(drive, 5)), QString());
    QCOMPARE(failure(level_set.set_drive(drive, 6)), QString());  // nothing new
    QCOMPARE(undo_text(*document), std::string("examples"));
    QVERIFY(document->changed_since_save());
    QCOMPARE(failure(document->undo()), QString());
    QVERIFY(!level_set.drive().strokes);
    QVERIFY(!document->history().undo_description());
    QCOMPARE(failure(document->redo()), QString());
    QCOMPARE(level_set.drive().strokes, drive.strokes);
    // A start, and its undo, leave them.
    QCOMPARE(failure(level_set.begin(seed_in(*document->volume()))), QString());
    QCOMPARE(level_set.drive().strokes, drive.strokes);
    QCOMPARE(failure(document->undo()), QString());
    QCOMPARE(level_set.drive().strokes, drive.strokes);
  }

  void another_executor_is_driven_and_held_as_the_one_before() {
    auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    document::Drive drive = with_wall(*document, {6.0, 0.0, 0.0}, 3.0);
    drive.setting.terms = {{"edges", {}}};
    QCOMPARE(failure(level_set.set_drive(drive)), QString());
    const auto speed = solver::make_speed(drive.setting, {document->volume(), {}, {}, nullptr, nullptr});
    QCOMPARE(failure(speed), QString());
    QCOMPARE(failure(level_set.set_speed(*speed)), QString());
    QCOMPARE(failure(level_set.change_executor(solver::ExecutorKind::reference, {})), QString());
    QVERIFY(level_set.executor().speed());
    QCOMPARE(level_set.executor().constraints(), drive.constraints);
    // With the tent again there is no function.
    drive.setting = {};
    QCOMPARE(failure(level_set.set_drive(drive)), QString());
    QCOMPARE(undo_text(*document), std::string("speed function"));
    QVERIFY(!level_set.executor().speed());
  }

  void a_state_knows_what_drives_and_holds_it() {
    auto document = begun_case();
    document::Drive drive = with_wall(*document, {6.0, 0.0, 0.0}, 3.0);
    drive.setting.terms = {{"tent", {}}, {"edges", {}}};
    drive.setting.combine = solver::Combine::product;
    QCOMPARE(failure(document->level_set().set_drive(drive)), QString());
    QCOMPARE(failure(document->history().close()), QString());
    const auto states = document->history().states();
    QVERIFY(states.front().steering.drive == document::DriveSummary());
    const document::DriveSummary& known = states.back().steering.drive;
    QVERIFY(known.setting == drive.setting);
    QVERIFY(known.has_walls && !known.has_anchors);
    QCOMPARE(document::describe(drive), std::string("the product of tent and edges, walls"));
  }

  void a_setting_that_makes_no_sense_changes_nothing() {
    auto document = begun_case();
    document::Drive drive;
    drive.setting.terms = {{"witchcraft", {}}};
    QVERIFY(failure(document->level_set().set_drive(drive)).contains("witchcraft"));
    QVERIFY(document->level_set().drive().setting.is_tent());
  }

  void steps_back_and_restart_keep_what_drives_it() {
    auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    run(level_set, 20);
    const document::Drive drive = with_wall(*document, {8.0, 0.0, 0.0}, 3.0);
    QCOMPARE(failure(level_set.set_drive(drive)), QString());
    run(level_set, 5);
    QCOMPARE(failure(level_set.step_back(3)), QString());
    QCOMPARE(level_set.drive().constraints, drive.constraints);
    QCOMPARE(level_set.executor().constraints(), drive.constraints);
    QCOMPARE(failure(level_set.restart()), QString());
    QCOMPARE(level_set.step(), std::int64_t{0});
    QCOMPARE(level_set.executor().constraints(), drive.constraints);
  }

  // What is shown, measured and saved is phi as the executor has it.
  void a_restart_is_known_as_later_walls_leave_it_data() { add_executors(); }
  void a_restart_is_known_as_later_walls_leave_it() {
    auto document = begun_case(this_executor());
    document::LevelSet& level_set = document->level_set();
    run(level_set, 20);
    const document::Drive drive = with_wall(*document, {1.3, -0.7, 0.4}, 3.0);
    QCOMPARE(failure(level_set.set_drive(drive)), QString());
    run(level_set, 5);
    QCOMPARE(failure(level_set.restart()), QString());
    const std::vector<float> held = values_of(level_set);
    const auto known = level_set.checkpoint();
    QCOMPARE(failure(known), QString());
    QVERIFY((*known)->dense() == held);
    QVERIFY(level_set.phi_at(document->history().last_state()).dense() == held);
    for_each_index(Index3(0), document->volume()->geometry.size, [&](Index3 voxel) {
      if (drive.constraints->at(voxel) == solver::Constraint::wall) QVERIFY((*known)->at(voxel) < 0.0F);
    });
    run(level_set, 5);
    QCOMPARE(failure(document->undo()), QString());
    QVERIFY(values_of(level_set) == held);
  }
};

TIDEMARK_TEST(DriveTest)

}  // namespace tidemark::test::drive_test

#include "drive_test.moc"
