// Sessions with further images: they are found again, what is missing is named, and nothing is lost.
#include "document/session_images.h"

#include "document/checksum.h"
#include "document/evolution.h"
#include "document/measures.h"
#include "document/session_file.h"
#include "imaging/files/volume_file.h"
#include "tests/document/cases.h"
#include "tests/support/test_program.h"

namespace tidemark::test::session_images_test {

namespace {

// Bright in a ball beside the middle of the lumpy one, on coarser voxels that reach beyond it.
Volume second_volume() {
  const auto lumpy = lumpy_volume();
  const glm::dvec3 centre = ball_at(*lumpy, {4.0, -2.0, 0.0}, 1.0).centre_mm;
  Volume volume;
  volume.geometry.size = {25, 24, 22};
  volume.geometry.spacing_mm = {2.0, 2.0, 2.5};
  volume.geometry.origin_mm = {-18.0, -2.0, 25.0};
  std::vector<float> values;
  for (std::int64_t z = 0; z < 22; ++z) {
    for (std::int64_t y = 0; y < 24; ++y) {
      for (std::int64_t x = 0; x < 25; ++x)
        values.push_back(glm::distance(volume.geometry.to_patient({x, y, z}), centre) < 8.0 ? 50.0F : 5.0F);
    }
  }
  volume.voxels = std::move(values);
  return volume;
}

std::shared_ptr<const document::CaseImage> image_at(const std::filesystem::path& file) {
  auto image = std::make_shared<document::CaseImage>();
  image->name = "Second";
  image->volume = std::make_shared<const Volume>(second_volume());
  image->checksum = document::checksum_of(*image->volume);
  image->path = file;
  image->to_case[3] = {1.0, 0.5, -0.5, 1.0};  // it was registered
  return image;
}

document::Drive learning(const Volume& volume, std::shared_ptr<const document::CaseImage> image) {
  auto strokes = std::make_shared<solver::Strokes>();
  const auto inside = ball_at(volume, {4.0, -2.0, 0.0}, 6.0);
  for (std::int64_t offset = 0; offset < volume.geometry.voxel_count(); offset += 7) {
    const glm::dvec3 at = volume.geometry.to_patient(glm::dvec3(volume.geometry.voxel_at(offset)));
    const double away = glm::distance(at, inside.centre_mm);
    if (away < 6.0) strokes->inside.push_back(offset);
    if (away > 11.0) strokes->outside.push_back(offset);
  }
  document::Drive drive;
  drive.setting.terms = {{"examples", {{"trees", 12.0}, {"sharpness", 1.0}, {"edges", 20.0}}}};
  drive.strokes = std::move(strokes);
  drive.images = {std::move(image)};
  return drive;
}

// As the engine does it.
void learn(document::LevelSet& level_set, const document::Drive& drive) {
  const auto speed = document::make_speed(drive, level_set.source(), level_set.parameters());
  if (!speed) qFatal("%s", speed.error().message.c_str());
  if (!level_set.set_drive(drive) || !level_set.set_speed(*speed)) qFatal("it is not driven");
}

// A folder with the image's file and the session of a case that learned from it.
struct SavedCase {
  TemporaryFolder folder;
  std::filesystem::path session = folder / "a/sessions/one.tidemark";
  std::unique_ptr<document::Case> document = begun_case();

  SavedCase() {
    std::filesystem::create_directories(folder / "a/sessions");
    const auto file = folder / "a/second.nrrd";
    if (const Status written = imaging::write_volume_file(second_volume(), file); !written)
      qFatal("%s", written.error().message.c_str());
    const auto image = image_at(file);
    document::LevelSet& level_set = document->level_set();
    run(level_set, 5);
    learn(level_set, learning(*document->volume(), image));
    run(level_set, 10);
    save(*document, {image});
  }
  void save(document::Case& saved, std::vector<std::shared_ptr<const document::CaseImage>> images) const {
    auto contents = document::snapshot_of(saved);
    if (!contents) qFatal("%s", contents.error().message.c_str());
    contents->origin.phantom = "lumpy";
    contents->images = std::move(images);
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

class SessionImagesTest : public QObject {
  Q_OBJECT

 private slots:
  void the_image_takes_part() {
    const auto volume = lumpy_volume();
    const auto document = make_case(volume);
    auto drive = learning(*volume, image_at({}));
    const auto with = document::make_speed(drive, volume, lumpy_parameters());
    drive.images.clear();
    const auto without = document::make_speed(drive, volume, lumpy_parameters());
    QVERIFY(with && without);
    const solver::VoxelBox box{{5, 5, 5}, {20, 20, 15}};
    std::vector<double> a(6000);
    std::vector<double> b(6000);
    (*with)->evaluate(box, a.data());
    (*without)->evaluate(box, b.data());
    QVERIFY(a != b);
  }

  // As descriptions of series are in some DICOM files.
  void a_long_name_comes_back() {
    const TemporaryFolder folder;
    const auto document = begun_case();
    auto contents = document::snapshot_of(*document);
    QCOMPARE(failure(contents), QString());
    contents->origin.phantom = "lumpy";
    auto image = std::make_shared<document::CaseImage>(*image_at({}));
    image->name = std::string(300, 'n');
    contents->images = {image};
    QCOMPARE(failure(document::write_session(*contents, folder / "one.tidemark")), QString());
    QCOMPARE(loaded(folder / "one.tidemark").images.front()->name, image->name);
  }

  void images_come_back_with_their_place_and_steps_go_on_as_before() {
    const SavedCase saved;
    document::SessionContents contents = loaded(saved.session);
    QCOMPARE(contents.images.size(), std::size_t{1});
    QVERIFY(!contents.images.front()->volume);
    QCOMPARE(document::find_images(contents).size(), std::size_t{0});
    const auto& image = contents.images.front();
    QVERIFY(image->volume);
    QCOMPARE(image->name, std::string("Second"));
    QCOMPARE(image->to_case[3].x, 1.0);
    QCOMPARE(contents.recipe.final_drive()->images.front(), image);
    const auto document = restored(contents);
    run(document->level_set(), 8);
    QVERIFY(document->level_set().executor().speed());
    run(saved.document->level_set(), 8);
    QVERIFY(values_of(document->level_set()) == values_of(saved.document->level_set()));
    // Further back than the session: it is computed again from the recipe, image and all.
    QCOMPARE(failure(document->level_set().step_back(10)), QString());
    QCOMPARE(failure(saved.document->level_set().step_back(10)), QString());
    QVERIFY(values_of(document->level_set()) == values_of(saved.document->level_set()));
  }

  void images_are_found_when_all_has_moved() {
    const SavedCase saved;
    std::filesystem::rename(saved.folder / "a", saved.folder / "b");
    document::SessionContents contents = loaded(saved.folder / "b/sessions/one.tidemark");
    QCOMPARE(document::find_images(contents).size(), std::size_t{0});
    QVERIFY(contents.images.front()->volume);
  }

  void a_missing_image_is_named_and_kept() {
    const SavedCase saved;
    std::filesystem::rename(saved.folder / "a/second.nrrd", saved.folder / "a/elsewhere.nrrd");
    document::SessionContents contents = loaded(saved.session);
    const auto problems = document::find_images(contents);
    QCOMPARE(problems.size(), std::size_t{1});
    const QString problem = QString::fromStdString(problems.front());
    QVERIFY2(problem.startsWith("the image \"Second\" is missing: ") && problem.contains("second.nrrd"),
             qPrintable(problem));
    // The surface is there, and so is what drove it.
    const auto document = restored(contents);
    QVERIFY(document->level_set().begun());
    QVERIFY(!document->level_set().executor().speed());
    QCOMPARE(document->level_set().drive().images.front()->name, std::string("Second"));
    QVERIFY(document->level_set().drive().strokes);
    // Saved again, it is found once the file is back.
    auto again = document::snapshot_of(*document);
    QVERIFY(again);
    again->images = contents.images;
    QCOMPARE(failure(document::write_session(*again, saved.session)), QString());
    std::filesystem::rename(saved.folder / "a/elsewhere.nrrd", saved.folder / "a/second.nrrd");
    document::SessionContents later = loaded(saved.session);
    QCOMPARE(document::find_images(later).size(), std::size_t{0});
    const auto found = restored(later);
    run(found->level_set(), 1);
    QVERIFY(found->level_set().executor().speed());
  }

  void a_file_with_other_voxels_is_not_the_image() {
    const SavedCase saved;
    Volume other = second_volume();
    std::get<std::vector<float>>(other.voxels)[100] += 1.0F;
    QCOMPARE(failure(imaging::write_volume_file(other, saved.folder / "a/second.nrrd")), QString());
    document::SessionContents contents = loaded(saved.session);
    const auto problems = document::find_images(contents);
    QCOMPARE(problems.size(), std::size_t{1});
    QVERIFY(QString::fromStdString(problems.front()).contains("has other voxels now"));
    QVERIFY(!contents.images.front()->volume);
  }

  // The display has it no more.
  void an_image_that_only_another_state_uses_is_found() {
    const SavedCase saved;
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    const std::uint64_t without = document->history().position();
    learn(level_set, learning(*document->volume(), image_at(saved.folder / "a/second.nrrd")));
    run(level_set, 5);
    QCOMPARE(failure(level_set.end_run()), QString());
    QCOMPARE(failure(document->history().go_to(without)), QString());
    saved.save(*document, {});
    document::SessionContents contents = loaded(saved.session);
    QVERIFY(contents.images.empty());
    QCOMPARE(document::find_images(contents).size(), std::size_t{0});
    QVERIFY(contents.images.empty());
    const auto opened = restored(contents);
    QCOMPARE(failure(opened->history().go_to(opened->history().states().back().id)), QString());
    const auto& image = opened->level_set().drive().images.front();
    QVERIFY(image->volume);
    QCOMPARE(image->to_case[3].x, 1.0);
    run(opened->level_set(), 3);
    QVERIFY(opened->level_set().executor().speed());
    // Without its file it is missed, once.
    std::filesystem::remove(saved.folder / "a/second.nrrd");
    contents = loaded(saved.session);
    const auto problems = document::find_images(contents);
    QCOMPARE(problems.size(), std::size_t{1});
    QVERIFY(QString::fromStdString(problems.front()).startsWith("the image \"Second\" is missing: "));
  }

  void only_images_that_meet_the_grid_are_measured() {
    const auto study = lumpy_volume();
    const auto near = image_at("second.nii.gz");
    auto far = std::make_shared<document::CaseImage>(*near);
    far->to_case[3] = {5000.0, 0.0, 0.0, 1.0};
    auto missing = std::make_shared<document::CaseImage>(*near);
    missing->volume = nullptr;
    const auto measured = document::images_on(study->geometry, {"study", study}, {far, missing, near});
    QVERIFY(measured);
    QCOMPARE(measured->size(), std::size_t{2});
    QCOMPARE(measured->front().name, std::string("study"));
    QCOMPARE(measured->back().name, near->name);
    QVERIFY(measured->back().volume->geometry == study->geometry);
    std::stop_source stop;
    stop.request_stop();
    const auto cancelled =
        document::images_on(study->geometry, {"study", study}, {near}, Progress{nullptr, stop.get_token()});
    QVERIFY(!cancelled && cancelled.error().kind == ErrorKind::cancelled);
  }

  // The image ends in the middle of the first region, and before the second.
  void an_image_is_measured_only_where_it_is() {
    auto study = std::make_shared<Volume>();
    study->geometry.size = Index3(16);
    study->voxels = std::vector<float>(static_cast<std::size_t>(study->geometry.voxel_count()), 0.0F);
    Volume pet;
    pet.geometry.size = {16, 16, 8};
    pet.unit = "SUVbw g/ml";
    std::vector<float> values;
    for (std::int64_t n = 0; n < pet.geometry.voxel_count(); ++n)
      values.push_back(n == 0 ? 1.0F : pet.geometry.voxel_at(n).z < 6 ? 5.0F : 6.0F);
    pet.voxels = std::move(values);
    auto image = std::make_shared<document::CaseImage>();
    image->name = "PET";
    image->volume = std::make_shared<const Volume>(std::move(pet));
    const auto images = document::images_on(study->geometry, {"study", study}, {image});
    QVERIFY(images);
    const auto measured = [&](std::int64_t low, std::int64_t high) {
      return document::measure(whole({Index3(5, 5, low), Index3(11, 11, high)}), study->geometry, *images);
    };
    const auto half = measured(4, 12);
    QCOMPARE(failure(half), QString());
    QCOMPARE(half->images.size(), std::size_t{2});
    QCOMPARE(half->images.front().covered, 1.0);
    const document::ImageValues& of_pet = half->images.back();
    QCOMPARE(of_pet.covered, 0.5);
    QCOMPARE(of_pet.values.smallest, 5.0);
    QCOMPARE(of_pet.values.largest, 6.0);
    QCOMPARE(of_pet.values.mean, 5.5);
    QCOMPARE(of_pet.values.standard_deviation, 0.5);
    QVERIFY(of_pet.values.uptake->peak > 5.3 && of_pet.values.uptake->peak <= 6.0);
    QCOMPARE(of_pet.values.uptake->total_glycolysis, 5.5 * 6 * 6 * 4 * 0.001);
    QCOMPARE(document::to_json(*half)["images"][1]["covered"].get<double>(), 0.5);
    const auto beyond = measured(10, 14);
    QCOMPARE(failure(beyond), QString());
    QCOMPARE(beyond->images.size(), std::size_t{1});
    // Speed functions see the image's minimum there, as before.
    QCOMPARE(document::on_grid(*image, study->geometry).value()->value({8, 8, 12}), 1.0F);
  }

  void bad_images_are_not_written_over_good_ones() {
    const SavedCase saved;
    document::SessionContents contents = loaded(saved.session);
    auto bad = std::make_shared<document::CaseImage>(*contents.images.front());
    bad->to_case[0] = {2.0, 0.0, 0.0, 0.0};
    contents.images = {bad};
    const Status written = document::write_session(contents, saved.session);
    QVERIFY2(failure(written).contains("images[0].to_case: is not a rotation and a shift"),
             qPrintable(failure(written)));
    QCOMPARE(written.error().kind, ErrorKind::write);
    QCOMPARE(failure(document::load_session(saved.session)), QString());
  }
};

TIDEMARK_TEST(SessionImagesTest)

}  // namespace tidemark::test::session_images_test

#include "session_images_test.moc"
