// Whole series on the disk: written, read back, shuffled, incomplete.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QProcess>
#include <algorithm>
#include <clocale>
#include <fstream>
#include <glm/geometric.hpp>
#include <mutex>

#include "imaging/dicom/dicom.h"
#include "imaging/load_study.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::dicom_series_test {

namespace fs = std::filesystem;

namespace {

bool says(const std::vector<std::string>& sentences, const char* text) {
  return std::any_of(sentences.begin(), sentences.end(),
                     [&](const std::string& one) { return one.find(text) != std::string::npos; });
}

}  // namespace

class DicomSeriesTest : public QObject {
  Q_OBJECT

 private slots:
  void what_is_written_is_read_back_data() {
    QTest::addColumn<QString>("modality");
    QTest::addColumn<bool>("is_signed");
    QTest::addColumn<double>("slope");
    QTest::addColumn<double>("intercept");
    QTest::newRow("CT int16") << "CT" << true << 1.0 << -1024.0;
    QTest::newRow("CT uint16") << "CT" << false << 0.5 << 3.25;
    QTest::newRow("MR int16") << "MR" << true << 1.0 << 0.0;
    QTest::newRow("MR uint16") << "MR" << false << 1.0 << 0.0;
    QTest::newRow("MR with slope") << "MR" << false << 2.5 << -7.0;
  }

  void what_is_written_is_read_back() {
    QFETCH(QString, modality);
    QFETCH(bool, is_signed);
    const Index3 size{7, 5, 4};
    Volume written = is_signed ? test::sample_volume(size) : test::sample_volume_uint16(size);
    written.slope = *static_cast<double*>(QTest::qData("slope", QMetaType::Double));
    written.intercept = *static_cast<double*>(QTest::qData("intercept", QMetaType::Double));
    const test::TemporaryFolder folder;
    test::write_series(written, folder / "series", modality.toUtf8());
    const imaging::Series series = test::only_series(folder.path());
    QCOMPARE(QString::fromStdString(series.reason), QString());
    QCOMPARE(series.modality, modality.toStdString());
    QCOMPARE(series.description, std::string("Sample"));
    QCOMPARE(series.scalar, std::string(written.scalar_name()));
    QVERIFY(series.changes.empty());
    QVERIFY(series.warnings.empty());
    const auto read = imaging::load_dicom(series);
    QCOMPARE(test::failure(read), QString());
    test::verify_same(*read, written);
    QVERIFY(read->window.has_value());
    QCOMPARE(read->window->centre, 40.0);
    QCOMPARE(read->window->width, 400.0);
  }

  void a_written_series_passes_the_validator() {
    for (const char* modality : {"CT", "MR"}) {
      const test::TemporaryFolder folder;
      const auto files = test::write_series(test::sample_volume({7, 5, 2}), folder / "series", modality);
      QProcess validator;
      validator.setProcessChannelMode(QProcess::MergedChannels);
      validator.start("dciodvfy", {QString::fromStdString(files.front().string())});
      QVERIFY2(validator.waitForFinished(), "dciodvfy (package dicom3tools) does not run");
      const QString said = validator.readAll();
      QVERIFY2(said.contains(modality), qPrintable(said));
      QVERIFY2(!said.contains("Error"), qPrintable(said));
    }
  }

  // Positions and spacings go through decimal strings, written and parsed.
  void a_comma_locale_changes_nothing() {
    const test::TemporaryFolder locales;
    if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) {
      const QString made = QString::fromStdString((locales / "de_DE.UTF-8").string());
      QProcess::execute("localedef", {"-i", "de_DE", "-f", "UTF-8", made});
      qputenv("LOCPATH", QByteArray::fromStdString(locales.path().string()));
      std::setlocale(LC_ALL, "de_DE.UTF-8");
      qunsetenv("LOCPATH");
    }
    QVERIFY2(std::string(std::localeconv()->decimal_point) == ",",
             "there is no locale with a comma: install the package locales");
    const Volume written = test::sample_volume({7, 5, 3});
    const test::TemporaryFolder folder;
    test::write_series(written, folder / "series");
    const auto read = imaging::load_dicom(test::only_series(folder.path()));
    std::setlocale(LC_ALL, "C");
    QCOMPARE(test::failure(read), QString());
    test::verify_same(*read, written);
  }

  void slices_are_sorted_by_position_whatever_their_names() {
    const Volume written = test::sample_volume({7, 5, 5});
    const test::TemporaryFolder folder;
    const auto files = test::write_series(written, folder / "series");
    const char* names[] = {"d", "a", "e", "b", "c"};
    for (std::size_t k = 0; k < files.size(); ++k) fs::rename(files[k], files[k].parent_path() / names[k]);
    const imaging::Series series = test::only_series(folder.path());
    QVERIFY2(series.loadable, series.reason.c_str());
    for (std::size_t k = 0; k < files.size(); ++k) QCOMPARE(series.files[k].filename().string(), names[k]);
    QCOMPARE(series.changes, std::vector<std::string>{"slices sorted by position"});
    const auto read = imaging::load_dicom(series);
    QCOMPARE(test::failure(read), QString());
    test::verify_same(*read, written);
  }

  void a_left_handed_volume_is_read_back_right_handed_at_the_same_place() {
    Volume written = test::sample_volume({7, 5, 3});
    written.geometry.direction[2] = -written.geometry.direction[2];
    const test::TemporaryFolder folder;
    test::write_series(written, folder / "series");
    const auto read = imaging::load_dicom(test::only_series(folder.path()));
    QCOMPARE(test::failure(read), QString());
    QVERIFY(glm::dot(glm::cross(read->geometry.direction[0], read->geometry.direction[1]),
                     read->geometry.direction[2]) > 0.999);
    for (const Index3 v : {Index3{0, 0, 0}, Index3{6, 4, 2}, Index3{3, 1, 1}}) {
      const glm::dvec3 there = read->geometry.to_voxel(written.geometry.to_patient(glm::dvec3(v)));
      const Index3 same(glm::round(there));
      QVERIFY(glm::length(there - glm::dvec3(same)) < 1e-6);
      QCOMPARE(read->value(same), written.value(v));
    }
  }

  void two_slices_make_a_volume_and_one_is_a_slice_of_its_thickness() {
    const test::TemporaryFolder folder;
    const Volume written = test::sample_volume({7, 5, 2});
    const auto files = test::write_series(written, folder / "series");
    const imaging::Series two = test::only_series(folder.path());
    QVERIFY2(two.loadable, two.reason.c_str());
    QVERIFY(std::abs(two.geometry.spacing_mm.z - 2.5) < 1e-9);
    fs::remove(files[1]);
    const imaging::Series one = test::only_series(folder.path());
    QVERIFY2(one.loadable, one.reason.c_str());
    QCOMPARE(one.geometry.size, (Index3{7, 5, 1}));
    const auto slice = imaging::load_dicom(one);
    QCOMPARE(test::failure(slice), QString());
    for (std::int64_t v = 0; v < 35; ++v) QCOMPARE(slice->value(v), written.value(v));
    // Where the slice lay among others, and as thick as its file says.
    QVERIFY(glm::distance(slice->geometry.origin_mm, written.geometry.origin_mm) < 1e-3);
    for (int axis = 0; axis < 3; ++axis) {
      QVERIFY(glm::distance(slice->geometry.direction[axis], written.geometry.direction[axis]) < 1e-6);
    }
    QVERIFY(glm::distance(slice->geometry.spacing_mm, written.geometry.spacing_mm) < 1e-6);
    QVERIFY(says(slice->changes, "SliceThickness"));
    QVERIFY(
        imaging::by_policy(one, {imaging::GridPolicy::Tilt::keep, imaging::GridPolicy::Gaps::fill}).loadable);

    test::set_text(files[0], 0x0018, 0x0050, "");
    const imaging::Series thin = test::only_series(folder.path());
    QCOMPARE(thin.geometry.spacing_mm.z, 1.0);
    QVERIFY(says(thin.changes, "counts as 1 mm thick"));
  }

  // What a plain radiograph or a captured picture has.
  void a_single_image_without_a_place_is_a_slice_that_says_so() {
    const test::TemporaryFolder folder;
    const auto file = test::write_series(test::sample_volume({7, 5, 2}), folder / "series")[0];
    fs::remove(folder / "series" / "slice-00002.dcm");
    test::set_text(file, 0x0020, 0x0032, "");
    test::set_text(file, 0x0020, 0x0037, "");
    test::set_text(file, 0x0028, 0x0030, "");
    test::set_text(file, 0x0018, 0x1164, "0.2\\0.1");
    const imaging::Series detector = test::only_series(folder.path());
    QVERIFY2(detector.loadable, detector.reason.c_str());
    QCOMPARE(glm::dvec2(detector.geometry.spacing_mm), glm::dvec2(0.1, 0.2));
    QCOMPARE(detector.geometry.origin_mm, glm::dvec3(0.0));
    QVERIFY(detector.frame_of_reference_uid.empty());
    QVERIFY(says(detector.warnings, "lengths are those on the detector"));
    QVERIFY(says(detector.warnings, "does not say where it lies in the patient"));

    test::set_text(file, 0x0018, 0x1164, "");
    const imaging::Series nothing = test::only_series(folder.path());
    QCOMPARE(glm::dvec2(nothing.geometry.spacing_mm), glm::dvec2(1.0));
    QVERIFY(says(nothing.warnings, "PixelSpacing (0028,0030) is missing: a pixel counts as 1 mm"));
    const auto volume = imaging::load_dicom(nothing);
    QVERIFY(volume && !volume->geometry.oriented);
    QVERIFY(!imaging::by_policy(nothing, {}).geometry.oriented);
  }

  void several_images_without_a_place_are_no_volume_still() {
    const test::TemporaryFolder folder;
    for (const auto& file : test::write_series(test::sample_volume({7, 5, 2}), folder / "series")) {
      test::set_text(file, 0x0020, 0x0032, "");
    }
    const imaging::Series two = test::only_series(folder.path());
    QVERIFY(!two.loadable);
    QVERIFY2(two.reason.find("ImagePositionPatient (0020,0032) is missing") != std::string::npos,
             two.reason.c_str());
  }

  void a_missing_slice_is_refused_by_name() {
    const test::TemporaryFolder folder;
    const auto files = test::write_series(test::sample_volume({7, 5, 6}), folder / "series");
    fs::remove(files[2]);
    const imaging::Series series = test::only_series(folder.path());
    QVERIFY(!series.loadable);
    QCOMPARE(series.reason,
             std::string("1 slice is missing between slice-00002.dcm and slice-00004.dcm: they are "
                         "5.000 mm apart, others 2.500 mm"));
    const auto refused = imaging::load_dicom(series);
    QVERIFY(!refused);
    QCOMPARE(refused.error().kind, ErrorKind::input);
  }

  void a_copy_beside_its_original_is_left_out_and_named() {
    const test::TemporaryFolder folder;
    const auto files = test::write_series(test::sample_volume({7, 5, 4}), folder / "series");
    fs::copy_file(files[1], folder.path() / "series" / "slice-00002-copy.dcm");
    const imaging::Series series = test::only_series(folder.path());
    QVERIFY2(series.loadable, series.reason.c_str());
    QCOMPARE(series.files.size(), files.size());
    QCOMPARE(series.changes.size(), std::size_t{1});
    QVERIFY2(series.changes[0].find("is the same image as slice-00002") != std::string::npos,
             series.changes[0].c_str());
  }

  void two_series_in_one_folder_stay_apart() {
    const Volume small = test::sample_volume({7, 5, 3});
    const Volume large = test::sample_volume_uint16({9, 8, 4});
    const test::TemporaryFolder folder;
    const auto files = test::write_series(small, folder / "small");
    test::write_series(large, folder / "large", "MR");
    for (const fs::path& file : files)
      fs::rename(file, folder.path() / "large" / ("other-" + file.filename().string()));
    const auto found = imaging::scan_dicom(folder.path());
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), std::size_t{2});
    for (const imaging::Series& series : found->series) {
      QVERIFY2(series.loadable, series.reason.c_str());
      const auto read = imaging::load_dicom(series);
      QCOMPARE(test::failure(read), QString());
      test::verify_same(*read, series.modality == "CT" ? small : large);
    }
  }

  void one_slice_stands_for_its_series() {
    const Volume written = test::sample_volume({7, 5, 3});
    const test::TemporaryFolder folder;
    const auto files = test::write_series(written, folder / "series");
    test::write_series(test::sample_volume({7, 5, 3}), folder / "other");
    fs::rename(folder.path() / "other" / "slice-00001.dcm", folder.path() / "series" / "foreign.dcm");
    const imaging::Series series = test::only_series(files[1]);
    QVERIFY2(series.loadable, series.reason.c_str());
    QCOMPARE(series.files, files);
    QCOMPARE(series.changes.size(), std::size_t{1});
    QVERIFY2(series.changes.front().find("slice-00002.dcm is one of 3 images") != std::string::npos,
             series.changes.front().c_str());
  }

  void rescale_that_differs_from_slice_to_slice_is_applied() {
    Volume written = test::sample_volume({7, 5, 3});
    const test::TemporaryFolder folder;
    const auto files = test::write_series(written, folder / "series");
    test::set_text(files[1], 0x0028, 0x1053, "0.25");
    test::set_text(files[1], 0x0028, 0x1052, "100");
    const imaging::Series series = test::only_series(folder.path());
    QCOMPARE(series.scalar, std::string("float"));
    const auto read = imaging::load_dicom(series);
    QCOMPARE(test::failure(read), QString());
    QCOMPARE(read->slope, 1.0);
    QCOMPARE(read->value(Index3{3, 2, 0}), written.value(Index3{3, 2, 0}));
    QCOMPARE(read->value(Index3{3, 2, 1}), 0.25F * written.value(Index3{3, 2, 1}) + 100.0F);
    QCOMPARE(read->value(Index3{3, 2, 2}), written.value(Index3{3, 2, 2}));
    QVERIFY2(read->changes.at(0).find("differ from slice to slice") != std::string::npos,
             read->changes[0].c_str());
  }

  void eight_bits_and_inverted_colours_are_kept_as_values() {
    const test::TemporaryFolder folder;
    const auto files = test::write_series(test::sample_volume_uint16({7, 5, 2}), folder / "series");
    for (const fs::path& file : files) {
      test::edit(file, [](DcmDataset& dataset) {
        std::vector<Uint8> bytes(35);
        for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<Uint8>(i * 7 + 5);
        dataset.putAndInsertUint16(DCM_BitsAllocated, 8);
        dataset.putAndInsertUint16(DCM_BitsStored, 8);
        dataset.putAndInsertUint16(DCM_HighBit, 7);
        dataset.putAndInsertString(DCM_PhotometricInterpretation, "MONOCHROME1");
        dataset.putAndInsertUint8Array(DcmTag(DCM_PixelData, EVR_OB), bytes.data(), 35);
      });
    }
    const imaging::Series series = test::only_series(folder.path());
    QVERIFY2(series.loadable, series.reason.c_str());
    QVERIFY(!series.warnings.empty() && series.warnings[0].find("MONOCHROME1") != std::string::npos);
    const auto read = imaging::load_dicom(series);
    QCOMPARE(test::failure(read), QString());
    QCOMPARE(std::string(read->scalar_name()), std::string("uint16"));
    QCOMPARE(read->value(Index3{3, 2, 1}), 17.0F * 7.0F + 5.0F);
  }

  void bits_outside_those_stored_are_cut_and_signs_extended() {
    const test::TemporaryFolder folder;
    const auto files = test::write_series(test::sample_volume({2, 2, 2}), folder / "series");
    for (const fs::path& file : files) {
      test::edit(file, [](DcmDataset& dataset) {
        const Uint16 words[] = {0xf7ff, 0x0800, 0xffff, 0x5001};  // 12 bits: 2047, -2048, -1, 1
        dataset.putAndInsertUint16(DCM_BitsStored, 12);
        dataset.putAndInsertUint16(DCM_HighBit, 11);
        dataset.putAndInsertUint16Array(DcmTag(DCM_PixelData, EVR_OW), words, 4);
      });
    }
    const auto read = imaging::load_dicom(test::only_series(folder.path()));
    QCOMPARE(test::failure(read), QString());
    const std::vector<std::int16_t> expected{2047, -2048, -1, 1, 2047, -2048, -1, 1};
    QCOMPARE(std::get<std::vector<std::int16_t>>(read->voxels), expected);
    QVERIFY2(!read->changes.empty() && read->changes.back().find("2 slices") != std::string::npos,
             "the cut bits are not mentioned");
  }

  void values_without_sign_may_have_fewer_bits_than_their_words() {
    const test::TemporaryFolder folder;
    for (const fs::path& file :
         test::write_series(test::sample_volume_uint16({2, 2, 2}), folder / "series")) {
      test::edit(file, [](DcmDataset& dataset) {
        const Uint16 words[] = {0x7ff0, 0x000f, 0xfff0, 0x8010};  // the upper 12 bits
        dataset.putAndInsertUint16(DCM_BitsStored, 12);
        dataset.putAndInsertUint16(DCM_HighBit, 15);
        dataset.putAndInsertUint16Array(DcmTag(DCM_PixelData, EVR_OW), words, 4);
      });
    }
    const auto read = imaging::load_dicom(test::only_series(folder.path()));
    QCOMPARE(test::failure(read), QString());
    const std::vector<std::uint16_t> expected{0x7ff, 0, 0xfff, 0x801, 0x7ff, 0, 0xfff, 0x801};
    QCOMPARE(std::get<std::vector<std::uint16_t>>(read->voxels), expected);
    QVERIFY2(!read->changes.empty() && read->changes.back().find("2 slices") != std::string::npos,
             "the cut bits are not mentioned");
  }

  // As int16, because one slice has a sign: what the other's words hold fits, too.
  void slices_with_sign_and_without_make_one_volume() {
    const test::TemporaryFolder folder;
    const auto files = test::write_series(test::sample_volume({2, 2, 2}), folder / "series");
    test::edit(files[1], [](DcmDataset& dataset) {
      const Uint16 words[] = {0, 1, 4094, 4095};
      dataset.putAndInsertUint16(DCM_BitsStored, 12);
      dataset.putAndInsertUint16(DCM_HighBit, 11);
      dataset.putAndInsertUint16(DCM_PixelRepresentation, 0);
      dataset.putAndInsertUint16Array(DcmTag(DCM_PixelData, EVR_OW), words, 4);
    });
    const auto read = imaging::load_dicom(test::only_series(folder.path()));
    QCOMPARE(test::failure(read), QString());
    const auto& voxels = std::get<std::vector<std::int16_t>>(read->voxels);
    QCOMPARE(voxels[0], std::int16_t{-32768});
    QCOMPARE(std::vector(voxels.begin() + 4, voxels.end()), (std::vector<std::int16_t>{0, 1, 4094, 4095}));
  }

  void progress_is_reported_in_turn_and_work_can_be_stopped() {
    const test::TemporaryFolder folder;
    test::write_series(test::sample_volume({7, 5, 20}), folder / "series");
    double last = 0.0;
    int calls = 0;
    std::mutex busy;
    Progress progress;
    progress.report = [&](double fraction, std::string_view) {
      const std::unique_lock lock(busy, std::try_to_lock);
      QVERIFY(lock.owns_lock());
      QVERIFY(fraction >= last && fraction <= 1.0);
      last = fraction;
      ++calls;
    };
    const auto found = imaging::scan_dicom(folder.path(), progress);
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(last, 1.0);
    QCOMPARE(calls, 20);

    std::stop_source stop;
    Progress stopping;
    stopping.stop = stop.get_token();
    stopping.report = [&](double, std::string_view) { stop.request_stop(); };
    const auto stopped = imaging::load_dicom(found->series.front(), stopping);
    QVERIFY(!stopped);
    QCOMPARE(stopped.error().kind, ErrorKind::cancelled);
  }

  void a_failed_write_leaves_nothing_behind() {
    const test::TemporaryFolder folder;
    const Volume volume = test::sample_volume({7, 5, 20});
    std::stop_source stop;
    Progress progress;
    progress.stop = stop.get_token();
    progress.report = [&](double fraction, std::string_view) {
      if (fraction > 0.5) stop.request_stop();
    };
    const Status stopped = imaging::write_dicom_series(volume, {}, folder / "series", progress);
    QVERIFY(!stopped);
    QCOMPARE(stopped.error().kind, ErrorKind::cancelled);
    QVERIFY(fs::is_empty(folder.path()));

    fs::create_directory(folder / "series");
    std::ofstream(folder / "series" / "notes.txt") << "kept";
    const Status refused = imaging::write_dicom_series(volume, {}, folder / "series");
    QVERIFY(!refused);
    QCOMPARE(refused.error().kind, ErrorKind::write);
    QVERIFY2(refused.error().message.find("notes.txt") != std::string::npos, refused.error().message.c_str());

    Volume floats = volume;
    floats.voxels = std::vector<float>(700);
    QCOMPARE(imaging::write_dicom_series(floats, {}, folder / "floats").error().kind, ErrorKind::write);
  }

  void a_series_takes_the_place_of_an_older_one() {
    const test::TemporaryFolder folder;
    QVERIFY(imaging::write_dicom_series(test::sample_volume({7, 5, 3}), {}, folder / "series"));
    fs::create_directory_symlink(folder / "series", folder / "link");
    const Volume volume = test::sample_volume({6, 4, 5});
    QCOMPARE(test::failure(imaging::write_dicom_series(volume, {}, folder / "link/")), QString());
    QVERIFY(fs::is_symlink(folder / "link"));
    const auto read = imaging::load_dicom(test::only_series(folder / "series"));
    QCOMPARE(test::failure(read), QString());
    QVERIFY(read->voxels == volume.voxels);
    QCOMPARE(std::distance(fs::directory_iterator(folder.path()), {}), std::ptrdiff_t{2});
  }

  void what_a_killed_program_was_writing_is_no_series() {
    const test::TemporaryFolder folder;
    const Volume volume = test::sample_volume({6, 4, 5});
    QVERIFY(imaging::write_dicom_series(volume, {}, folder / "series"));
    QVERIFY(imaging::write_dicom_series(volume, {}, folder / ".tidemark-0123ab-series"));
    fs::copy_file(folder / ".tidemark-0123ab-series/slice-00001.dcm",
                  folder / "series/.tidemark-0123ab-slice-00001.dcm");
    const auto found = imaging::scan_dicom(folder.path());
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), std::size_t{1});
    QVERIFY(found->skipped.empty());
    QVERIFY2(found->series.front().loadable, found->series.front().reason.c_str());
  }
};

TIDEMARK_TEST(DicomSeriesTest)

}  // namespace tidemark::test::dicom_series_test

#include "dicom_series_test.moc"
