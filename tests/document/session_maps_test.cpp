// Sessions of a surface that a given map drives: the map is found again, or its absence is told.
#include "document/checksum.h"
#include "document/session_file.h"
#include "document/session_images.h"
#include "document/speed_map.h"
#include "imaging/files/volume_file.h"
#include "tests/document/cases.h"
#include "tests/support/test_program.h"

namespace tidemark::test::session_maps_test {

namespace {

// Probable in a ball of that radius beside the middle of the lumpy volume.
Volume probability(double radius_mm) {
  const auto lumpy = lumpy_volume();
  const auto ball = ball_at(*lumpy, {3.0, 1.0, 0.0}, radius_mm);
  Volume volume;
  volume.geometry = lumpy->geometry;
  std::vector<float> values;
  for (std::int64_t offset = 0; offset < volume.geometry.voxel_count(); ++offset) {
    const glm::dvec3 place = volume.geometry.to_patient(glm::dvec3(volume.geometry.voxel_at(offset)));
    values.push_back(glm::distance(place, ball.centre_mm) < ball.radius_mm ? 0.9F : 0.2F);
  }
  volume.voxels = std::move(values);
  return volume;
}

void write(const Volume& volume, const std::filesystem::path& file) {
  if (const Status written = imaging::write_volume_file(volume, file); !written)
    qFatal("%s", written.error().message.c_str());
}

void drive_by(document::LevelSet& level_set, const std::filesystem::path& file) {
  auto map = document::load_speed_map(file, level_set.source()->geometry);
  if (!map) qFatal("%s", map.error().message.c_str());
  document::Drive drive;
  drive.setting.terms = {{"image", {}}};
  drive.map = std::move(*map);
  const auto speed = document::make_speed(drive, level_set.source(), level_set.parameters());
  if (!speed) qFatal("%s", speed.error().message.c_str());
  if (!level_set.set_drive(drive) || !level_set.set_speed(*speed)) qFatal("it is not driven");
}

// A folder with the files of two maps, and the session of a case that both have driven, one after the other.
struct SavedCase {
  TemporaryFolder folder;
  std::filesystem::path session = folder / "a/sessions/one.tidemark";
  std::unique_ptr<document::Case> document = begun_case();

  SavedCase() {
    std::filesystem::create_directories(folder / "a/sessions");
    write(probability(7.0), folder / "a/first.nrrd");
    write(probability(9.0), folder / "a/second.nrrd");
    document::LevelSet& level_set = document->level_set();
    drive_by(level_set, folder / "a/first.nrrd");
    run(level_set, 5);
    drive_by(level_set, folder / "a/second.nrrd");
    run(level_set, 10);
    save(*document);
  }
  void save(document::Case& saved) const {
    auto contents = document::snapshot_of(saved);
    if (!contents) qFatal("%s", contents.error().message.c_str());
    contents->origin.phantom = "lumpy";
    if (!document::write_session(*contents, session)) qFatal("no session could be written");
  }
};

document::SessionContents loaded(const std::filesystem::path& file) {
  auto contents = document::load_session(file);
  if (!contents) qFatal("%s", contents.error().message.c_str());
  return std::move(*contents);
}

std::unique_ptr<document::Case> restored(const document::SessionContents& contents) {
  solver::ExecutorOptions options;
  options.threads = 1;
  auto made = document::restore_case(contents, lumpy_volume(), solver::ExecutorKind::host, options);
  if (!made) qFatal("%s", made.error().message.c_str());
  return std::move(*made);
}

}  // namespace

class SessionMapsTest : public QObject {
  Q_OBJECT

 private slots:
  void maps_come_back_and_steps_go_on_as_before() {
    const SavedCase saved;
    document::SessionContents contents = loaded(saved.session);
    QVERIFY(contents.recipe.final_drive()->map);
    QVERIFY(!contents.recipe.final_drive()->map->volume);
    QCOMPARE(document::find_images(contents).size(), std::size_t{0});
    QCOMPARE(contents.recipe.final_drive()->map->name, std::string("second.nrrd"));
    const auto document = restored(contents);
    run(document->level_set(), 8);
    QVERIFY(document->level_set().executor().speed());
    run(saved.document->level_set(), 8);
    QVERIFY(values_of(document->level_set()) == values_of(saved.document->level_set()));
    // To where the first map drove it: computed again from the recipe.
    QCOMPARE(failure(document->level_set().step_back(20)), QString());
    QCOMPARE(failure(saved.document->level_set().step_back(20)), QString());
    QVERIFY(values_of(document->level_set()) == values_of(saved.document->level_set()));
  }

  void maps_are_found_when_all_has_moved() {
    const SavedCase saved;
    std::filesystem::rename(saved.folder / "a", saved.folder / "b");
    document::SessionContents contents = loaded(saved.folder / "b/sessions/one.tidemark");
    QCOMPARE(document::find_images(contents).size(), std::size_t{0});
    QVERIFY(contents.recipe.final_drive()->map->volume);
  }

  void a_missing_map_is_named_in_one_line_and_found_later() {
    const SavedCase saved;
    std::filesystem::rename(saved.folder / "a/second.nrrd", saved.folder / "a/elsewhere.nrrd");
    document::SessionContents contents = loaded(saved.session);
    const auto problems = document::find_images(contents);
    QCOMPARE(problems.size(), std::size_t{1});
    const QString problem = QString::fromStdString(problems.front());
    QVERIFY2(problem.startsWith("the map \"second.nrrd\" is missing: ") && !problem.contains('\n'),
             qPrintable(problem));
    // The surface is there, and stands still. Saved again, it finds the map once the file is back.
    const auto document = restored(contents);
    QVERIFY(document->level_set().begun());
    QVERIFY(!document->level_set().executor().speed());
    const auto step = document->level_set().advance({.steps = 1});
    QVERIFY(!step);
    QVERIFY2(failure(step).contains("the map \"second.nrrd\" is missing"), qPrintable(failure(step)));
    saved.save(*document);
    std::filesystem::rename(saved.folder / "a/elsewhere.nrrd", saved.folder / "a/second.nrrd");
    document::SessionContents later = loaded(saved.session);
    QCOMPARE(document::find_images(later).size(), std::size_t{0});
    const auto found = restored(later);
    run(found->level_set(), 1);
    QVERIFY(found->level_set().executor().speed());
  }

  void a_file_with_other_values_is_not_the_map() {
    const SavedCase saved;
    write(probability(8.0), saved.folder / "a/second.nrrd");
    document::SessionContents contents = loaded(saved.session);
    const auto problems = document::find_images(contents);
    QCOMPARE(problems.size(), std::size_t{1});
    QVERIFY(QString::fromStdString(problems.front()).contains("has other values now"));
    QVERIFY(!contents.recipe.final_drive()->map->volume);
  }

  void a_map_that_only_another_state_uses_is_found() {
    const SavedCase saved;
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    const std::uint64_t without = document->history().position();
    drive_by(level_set, saved.folder / "a/first.nrrd");
    run(level_set, 5);
    QCOMPARE(failure(level_set.end_run()), QString());
    QCOMPARE(failure(document->history().go_to(without)), QString());
    saved.save(*document);
    document::SessionContents contents = loaded(saved.session);
    QVERIFY(!contents.recipe.has_drive());
    QCOMPARE(document::find_images(contents).size(), std::size_t{0});
    const auto opened = restored(contents);
    QCOMPARE(failure(opened->history().go_to(opened->history().states().back().id)), QString());
    QVERIFY(opened->level_set().drive().map->volume);
    run(opened->level_set(), 3);
    QVERIFY(opened->level_set().executor().speed());
    // Saved from there, its states have what they share once.
    QCOMPARE(failure(opened->level_set().end_run()), QString());
    const auto is_shared = [](const document::SavedHistory& history) {
      const document::SavedState& last = history.states.back();
      return last.recipe.events.front() == history.states[*last.parent].recipe.events.front();
    };
    saved.save(*opened);
    document::SessionContents again = loaded(saved.session);
    QVERIFY(is_shared(again.history));
    QCOMPARE(document::find_images(again).size(), std::size_t{0});
    QVERIFY(is_shared(again.history));
    // Without its file it is missed, once.
    std::filesystem::remove(saved.folder / "a/first.nrrd");
    contents = loaded(saved.session);
    QCOMPARE(document::find_images(contents).size(), std::size_t{1});
  }

  void a_map_that_waits_for_its_function_is_found() {
    const SavedCase saved;
    const auto document = begun_case();
    document::Drive drive;
    drive.map =
        document::load_speed_map(saved.folder / "a/second.nrrd", document->volume()->geometry).value();
    QCOMPARE(failure(document->level_set().set_drive(drive)), QString());
    saved.save(*document);
    document::SessionContents contents = loaded(saved.session);
    QVERIFY(!contents.recipe.has_drive());
    QCOMPARE(document::find_images(contents).size(), std::size_t{0});
    const auto opened = restored(contents);
    QVERIFY(opened->level_set().drive().map);
    QCOMPARE(opened->level_set().drive().map->name, std::string("second.nrrd"));
    QVERIFY(opened->level_set().drive().map->volume);
  }

  void bad_places_are_refused_with_their_field() {
    const SavedCase saved;
    document::SessionContents contents = loaded(saved.session);
    contents.recipe.change_drives([](document::Drive& drive) {
      auto bad = std::make_shared<document::SpeedMap>(*drive.map);
      bad->path = std::string("nul\0byte", 8);
      drive.map = std::move(bad);
    });
    QCOMPARE(failure(document::write_session(contents, saved.session)), QString());
    const auto read = document::load_session(saved.session);
    QVERIFY(!read);
    QVERIFY2(failure(read).contains("maps[0]"), qPrintable(failure(read)));
  }
};

TIDEMARK_TEST(SessionMapsTest)

}  // namespace tidemark::test::session_maps_test

#include "session_maps_test.moc"
