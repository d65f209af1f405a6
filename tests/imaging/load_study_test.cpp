// The one way in: folders and files, DICOM or not.
#include <sys/stat.h>

#include <fstream>
#include <glm/geometric.hpp>
#include <limits>

#include "imaging/dicom/dicom.h"
#include "imaging/files/volume_file.h"
#include "imaging/load_study.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::load_study_test {

namespace fs = std::filesystem;

class LoadStudyTest : public QObject {
  Q_OBJECT

  // An axis-aligned volume of voxel values 0, 1, 2, ...
  static Volume counting_volume(Index3 size) {
    Volume volume;
    volume.geometry.size = size;
    volume.geometry.spacing_mm = {1.0, 2.0, 3.0};
    std::vector<std::int16_t> voxels(static_cast<std::size_t>(volume.geometry.voxel_count()));
    for (std::size_t v = 0; v < voxels.size(); ++v) voxels[v] = static_cast<std::int16_t>(v);
    volume.voxels = std::move(voxels);
    return volume;
  }

 private slots:
  void a_path_that_does_not_exist_is_said_so() {
    const test::TemporaryFolder folder;
    const fs::path nowhere = folder / "nowhere";
    for (const auto& error : {imaging::find_series(nowhere).error(), imaging::load_volume(nowhere).error(),
                              imaging::load_mask(nowhere).error()}) {
      QCOMPARE(error.kind, ErrorKind::input);
      QCOMPARE(error.message, nowhere.string() + ": no such file or folder");
    }
  }

  // Opening it would wait for a writer.
  void a_pipe_is_refused() {
    const test::TemporaryFolder folder;
    const fs::path pipe = folder / "pipe";
    QCOMPARE(::mkfifo(pipe.c_str(), 0600), 0);
    QCOMPARE(imaging::load_volume(pipe).error().message, pipe.string() + ": is neither a file nor a folder");
    QVERIFY(!imaging::scan_dicom(pipe));
    QCOMPARE(imaging::find_series(folder.path()).error().kind, ErrorKind::input);
  }

  void a_folder_without_images_is_said_so() {
    const test::TemporaryFolder folder;
    const std::string expected = folder.path().string() + ": holds no DICOM series, volume file or picture";
    QCOMPARE(imaging::find_series(folder.path()).error().message, expected);
    std::ofstream(folder / "notes.txt") << "Not an image.\n";
    const auto found = imaging::find_series(folder.path());
    QVERIFY(!found);
    QCOMPARE(found.error().kind, ErrorKind::input);
    QCOMPARE(found.error().message, expected);
    const auto alone = imaging::load_volume(folder / "notes.txt");
    QVERIFY(!alone);
    QCOMPARE(alone.error().message,
             (folder / "notes.txt").string() +
                 ": is neither a DICOM image, a volume file, a picture nor a zip archive");
  }

  void a_folder_may_hold_dicom_and_volume_files() {
    const test::TemporaryFolder folder;
    const Volume small = counting_volume({3, 4, 5});
    const Volume large = test::sample_volume({9, 8, 7});
    test::write_series(large, folder / "series");
    QCOMPARE(test::failure(imaging::write_volume_file(small, folder / "small.nrrd")), QString());
    const auto found = imaging::find_series(folder.path());
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), std::size_t{2});
    QVERIFY(found->skipped.empty());
    for (const imaging::Series& series : found->series) QVERIFY2(series.loadable, series.reason.c_str());

    const auto most = imaging::load_volume(folder.path());
    QCOMPARE(test::failure(most), QString());
    QVERIFY(most->voxels == large.voxels);
    QVERIFY2(!most->changes.empty() && most->changes[0].find("has the most voxels") != std::string::npos,
             "the choice is not mentioned");
    for (const imaging::Series& series : found->series) {
      const auto chosen = imaging::load_volume(folder.path(), series.uid);
      QCOMPARE(test::failure(chosen), QString());
      QVERIFY(chosen->voxels == (series.modality == "CT" ? large.voxels : small.voxels));
    }
    const auto unknown = imaging::load_volume(folder.path(), "1.2.3");
    QVERIFY(!unknown);
    QCOMPARE(unknown.error().kind, ErrorKind::input);
    for (const imaging::Series& series : found->series) {
      QVERIFY2(unknown.error().message.find(series.uid) != std::string::npos,
               unknown.error().message.c_str());
    }
  }

  void a_single_file_is_loaded_with_its_series() {
    const test::TemporaryFolder folder;
    const Volume written = test::sample_volume({9, 8, 3});
    const auto files = test::write_series(written, folder / "series");
    const auto volume = imaging::load_volume(files[2]);
    QCOMPARE(test::failure(volume), QString());
    QVERIFY(volume->voxels == written.voxels);
    QCOMPARE(test::failure(imaging::write_volume_file(written, folder / "same.nii.gz")), QString());
    const auto file = imaging::load_volume(folder / "same.nii.gz");
    QCOMPARE(test::failure(file), QString());
    QVERIFY(same_grid(file->geometry, written.geometry, 1e-3));
    QCOMPARE(file->value(Index3{4, 3, 2}), written.value(Index3{4, 3, 2}));
  }

  // Not even where the series cannot be loaded: the scout is not what was asked for.
  void a_scout_beside_a_series_is_listed_and_only_read_by_its_uid() {
    const test::TemporaryFolder folder;
    const auto scout = test::write_series(test::sample_volume({40, 40, 2}), folder / "scout");
    fs::remove(scout[1]);
    const auto alone = imaging::load_volume(folder.path());
    QCOMPARE(test::failure(alone), QString());
    QCOMPARE(alone->geometry.size, (Index3{40, 40, 1}));

    const auto files = test::write_series(test::sample_volume({9, 8, 4}), folder / "series");
    const auto found = imaging::find_series(folder.path());
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), std::size_t{2});
    for (const imaging::Series& series : found->series) QVERIFY2(series.loadable, series.reason.c_str());
    const auto series = imaging::load_volume(folder.path());
    QCOMPARE(test::failure(series), QString());
    QCOMPARE(series->geometry.size, (Index3{9, 8, 4}));
    const auto is_scout = [](const imaging::Series& one) { return one.sources.size() == 1; };
    const auto listed = std::find_if(found->series.begin(), found->series.end(), is_scout);
    QCOMPARE(imaging::load_volume(folder.path(), listed->uid)->geometry.size, (Index3{40, 40, 1}));

    fs::remove(files[1]);
    const auto gap = imaging::load_volume(folder.path());
    QVERIFY(!gap);
    QVERIFY2(gap.error().message.find("missing between") != std::string::npos, gap.error().message.c_str());
    const auto catalogue = imaging::find_series(folder.path());
    QVERIFY(imaging::find_fillable(*catalogue, {}) != nullptr);
  }

  void a_series_that_cannot_be_loaded_gives_its_reason() {
    const test::TemporaryFolder folder;
    const auto files = test::write_series(test::sample_volume({9, 8, 4}), folder / "series");
    fs::remove(files[1]);
    const auto found = imaging::find_series(folder.path());
    QCOMPARE(test::failure(found), QString());
    const auto volume = imaging::load_volume(folder.path());
    QVERIFY(!volume);
    QCOMPARE(volume.error().kind, ErrorKind::input);
    QCOMPARE(volume.error().message, folder.path().string() + ": " + found->series.at(0).reason);
  }

  void a_file_at_fault_is_named_once() {
    const test::TemporaryFolder folder;
    const fs::path file = folder / "text.nii";
    std::ofstream(file) << "hello";
    for (const fs::path& path : {file, folder.path()}) {
      const auto volume = imaging::load_volume(path);
      QVERIFY(!volume);
      const QString message = QString::fromStdString(volume.error().message);
      QVERIFY2(message.startsWith(QString::fromStdString(path.string() + ": ")), qPrintable(message));
      QVERIFY2(message.count("text.nii") == 1, qPrintable(message));
      QVERIFY2(message.contains("not a NIfTI file"), qPrintable(message));
    }
  }

  void values_that_are_not_finite_are_refused() {
    const test::TemporaryFolder folder;
    Volume volume = counting_volume({3, 4, 5});
    std::vector<float> floats(60, 1.0F);
    floats[3 + 3 * 2] = std::numeric_limits<float>::quiet_NaN();  // (0, 3, 0)
    volume.voxels = floats;
    QCOMPARE(test::failure(imaging::write_volume_file(volume, folder / "nan.nrrd")), QString());
    const auto refused = imaging::load_volume(folder / "nan.nrrd");
    QVERIFY(!refused);
    QCOMPARE(refused.error().kind, ErrorKind::input);
    QVERIFY2(refused.error().message.find("(0, 3, 0)") != std::string::npos, refused.error().message.c_str());

    const auto files = test::write_series(test::sample_volume({4, 3, 2}), folder / "series");
    for (const fs::path& file : files) test::set_text(file, 0x0028, 0x1053, "1e38");
    const auto infinite = imaging::load_volume(folder / "series");
    QVERIFY(!infinite);
    QVERIFY2(infinite.error().message.find("not finite") != std::string::npos,
             infinite.error().message.c_str());
  }

  // Of a DICOM series the other slices need not even be there.
  void a_slice_is_loaded_alone() {
    const test::TemporaryFolder folder;
    const Volume volume = test::sample_volume({5, 4, 3});
    test::write_series(volume, folder / "series");
    QCOMPARE(test::failure(imaging::write_volume_file(volume, folder / "volume.nrrd")), QString());
    for (const char* name : {"series", "volume.nrrd"}) {
      const auto found = imaging::find_series(folder / name);
      QCOMPARE(test::failure(found), QString());
      const imaging::Series& series = found->series.front();
      const auto whole = imaging::load_series(series);
      QCOMPARE(test::failure(whole), QString());
      QVERIFY(same_grid(whole->geometry, volume.geometry, 1e-4));
      if (series.files.size() > 1) {
        fs::remove(series.files.at(0));
        fs::remove(series.files.at(2));
      }
      const auto slice = imaging::load_slice(series, 1);
      QCOMPARE(test::failure(slice), QString());
      const std::vector<float> all = whole->values();
      QCOMPARE(slice->values(), std::vector<float>(all.begin() + 20, all.begin() + 40));
      QCOMPARE(slice->geometry.size, Index3(5, 4, 1));
      QVERIFY(glm::distance(slice->geometry.origin_mm, volume.geometry.to_patient({0.0, 0.0, 1.0})) < 1e-4);
      for (const std::int64_t outside : {-1, 3}) {
        QCOMPARE(imaging::load_slice(series, outside).error().kind, ErrorKind::usage);
      }
    }
    imaging::Series damaged;
    damaged.reason = "a slice is missing";
    QVERIFY(
        imaging::load_slice(damaged, 0).error().message.ends_with("cannot be loaded: a slice is missing"));
    QVERIFY(imaging::load_series(damaged).error().message.ends_with("cannot be loaded: a slice is missing"));
  }

  void the_studys_date_is_listed_when_it_is_one() {
    const test::TemporaryFolder folder;
    const auto files = test::write_series(test::sample_volume({4, 3, 2}), folder / "series");
    const std::pair<const char*, const char*> dates[] = {
        {"20040731", "2004-07-31"}, {"2004.07.31", "2004-07-31"}, {"", ""}, {"July", ""}, {"2004073", ""}};
    for (const auto& [written, listed] : dates) {
      for (const fs::path& file : files) test::set_text(file, 0x0008, 0x0020, written);
      const auto found = imaging::find_series(folder / "series");
      QCOMPARE(test::failure(found), QString());
      QCOMPARE(found->series.front().date, std::string(listed));
    }
  }

  void whatever_is_not_zero_is_inside_a_mask() {
    const test::TemporaryFolder folder;
    Volume volume = counting_volume({3, 4, 5});
    auto& voxels = std::get<std::vector<std::int16_t>>(volume.voxels);
    for (std::size_t v = 0; v < voxels.size(); ++v) voxels[v] = static_cast<std::int16_t>(v % 3 - 1);
    QCOMPARE(test::failure(imaging::write_volume_file(volume, folder / "labels.nii.gz")), QString());
    const auto mask = imaging::load_mask(folder / "labels.nii.gz");
    QCOMPARE(test::failure(mask), QString());
    QCOMPARE(mask->count(), std::int64_t{40});
    for (std::size_t v = 0; v < voxels.size(); ++v) QCOMPARE(mask->voxels[v] != 0, voxels[v] != 0);
    QVERIFY(same_grid(mask->geometry, volume.geometry, 1e-4));
  }
};

TIDEMARK_TEST(LoadStudyTest)

}  // namespace tidemark::test::load_study_test

#include "load_study_test.moc"
