// Bad slices among good ones: a series does without none of them in silence. Single bad files:
// bad_dicom_structure_test, bad_dicom_pixels_test.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <fstream>
#include <functional>
#include <memory>

#include "imaging/dicom/dicom.h"
#include "imaging/dicom/header_reader.h"
#include "imaging/dicom/pixels.h"
#include "tests/imaging/dicom/dicom_bytes.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::dicom_damage_test {

namespace fs = std::filesystem;

namespace {

using Damage = std::function<void(DcmDataset&)>;

Damage text(const DcmTagKey& key, const char* value) {
  return [=](DcmDataset& dataset) { dataset.putAndInsertString(DcmTag(key), value); };
}
Damage number(const DcmTagKey& key, Uint16 value) {
  return [=](DcmDataset& dataset) { dataset.putAndInsertUint16(DcmTag(key), value); };
}
Damage without(const DcmTagKey& key) {
  return [=](DcmDataset& dataset) { delete dataset.remove(key); };
}
Damage pixels(std::size_t bytes) {
  return [=](DcmDataset& dataset) {
    const std::vector<Uint8> data(bytes, 1);
    dataset.putAndInsertUint8Array(DcmTag(DCM_PixelData, EVR_OB), data.data(),
                                   static_cast<unsigned long>(bytes));
  };
}

void write_bytes(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace

class DicomDamageTest : public QObject {
  Q_OBJECT

 private slots:
  void a_bad_attribute_is_refused_by_file_and_field_data() {
    QTest::addColumn<Damage>("damage");
    QTest::addColumn<QString>("reason");
    const auto row = [](const char* name, const Damage& damage, const char* reason) {
      QTest::newRow(name) << damage << reason;
    };
    row("no position", without(DCM_ImagePositionPatient), "ImagePositionPatient (0020,0032) is missing");
    row("no orientation", without(DCM_ImageOrientationPatient),
        "ImageOrientationPatient (0020,0037) is missing");
    row("no spacing", without(DCM_PixelSpacing), "PixelSpacing (0028,0030) is missing");
    row("two coordinates", text(DCM_ImagePositionPatient, "1\\2"),
        "ImagePositionPatient (0020,0032) is '1\\2'");
    row("position far away", text(DCM_ImagePositionPatient, "1\\2\\1e9"),
        "ImagePositionPatient (0020,0032) is 1");
    row("five cosines", text(DCM_ImageOrientationPatient, "1\\0\\0\\0\\1"), "(0020,0037) is '1\\0\\0\\0\\1'");
    row("no number among cosines", text(DCM_ImageOrientationPatient, "1\\0\\nan\\0\\1\\0"),
        "(0020,0037) is '1");
    row("position nan", text(DCM_ImagePositionPatient, "1\\nan\\3"), "(0020,0032) is '1\\nan\\3'");
    row("zero cosines", text(DCM_ImageOrientationPatient, "0\\0\\0\\0\\0\\0"), "perpendicular unit vectors");
    row("same cosines", text(DCM_ImageOrientationPatient, "1\\0\\0\\1\\0\\0"), "perpendicular unit vectors");
    row("long cosines", text(DCM_ImageOrientationPatient, "2\\0\\0\\0\\1\\0"), "perpendicular unit vectors");
    row("zero spacing", text(DCM_PixelSpacing, "0\\1"), "PixelSpacing (0028,0030) is 0 mm");
    row("negative spacing", text(DCM_PixelSpacing, "1\\-1"), "PixelSpacing (0028,0030) is -1 mm");
    row("spacing nan", text(DCM_PixelSpacing, "nan\\1"), "PixelSpacing (0028,0030) is 'nan\\1'");
    row("spacing inf", text(DCM_PixelSpacing, "inf\\1"), "PixelSpacing (0028,0030) is 'inf\\1'");
    row("spacing 1e400", text(DCM_PixelSpacing, "1e400\\1"), "PixelSpacing (0028,0030) is '1e400\\1'");
    row("spacing 1e9", text(DCM_PixelSpacing, "1e9\\1"), "PixelSpacing (0028,0030) is 1");
    row("one spacing", text(DCM_PixelSpacing, "1"), "PixelSpacing (0028,0030) is '1'");
    row("spacing with comma", text(DCM_PixelSpacing, "0,5\\0,5"), "PixelSpacing (0028,0030) is '0,5\\0,5'");
    row("slope 0", text(DCM_RescaleSlope, "0"), "RescaleSlope (0028,1053) is 0");
    row("slope nan", text(DCM_RescaleSlope, "nan"), "RescaleSlope (0028,1053) is 'nan'");
    row("slope 1e400", text(DCM_RescaleSlope, "1e400"), "RescaleSlope (0028,1053) is '1e400'");
    row("two slopes", text(DCM_RescaleSlope, "1\\2"), "RescaleSlope (0028,1053) is '1\\2'");
    row("intercept 1e999", text(DCM_RescaleIntercept, "1e999"), "RescaleIntercept (0028,1052) is '1e999'");
    row(
        "rows differ",
        [](DcmDataset& d) {
          number(DCM_Rows, 4)(d);
          pixels(56)(d);
        },
        "the size (Rows, Columns)");
    row("mosaic", text(DCM_ImageType, "ORIGINAL\\PRIMARY\\MOSAIC"), "mosaic");
    row("enhanced", text(DCM_SOPClassUID, UID_EnhancedMRImageStorage), "EnhancedMRImageStorage");
    row("position as the neighbour", text(DCM_ImagePositionPatient, "-101.25\\37.5\\512.125"),
        "at the same position");
  }

  void a_bad_attribute_is_refused_by_file_and_field() {
    QFETCH(Damage, damage);
    QFETCH(QString, reason);
    const test::TemporaryFolder folder;
    const auto files = test::write_series(test::sample_volume({7, 5, 4}), folder / "series");
    test::edit(files[2], damage);
    const imaging::Series series = test::only_series(folder.path());
    QVERIFY(!series.loadable);
    const QString said = QString::fromStdString(series.reason);
    QVERIFY2(said.contains("slice-00003.dcm"), qPrintable(said));
    QVERIFY2(said.contains(reason), qPrintable(said));
    QVERIFY2(!said.contains('\n'), qPrintable(said));
    const auto loaded = imaging::load_dicom(series);
    QVERIFY(!loaded);
    QCOMPARE(loaded.error().kind, ErrorKind::input);
  }

  void sizes_may_come_as_longer_integers() {
    const test::TemporaryFolder folder;
    const Volume written = test::sample_volume({7, 5, 2});
    for (const fs::path& file : test::write_series(written, folder / "series")) {
      test::edit(file, [](DcmDataset& dataset) {
        delete dataset.remove(DCM_Rows);
        auto rows = std::make_unique<DcmUnsignedLong>(DcmTag(DCM_Rows, EVR_UL));
        rows->putUint32(5);
        dataset.insert(rows.release(), OFTrue);
      });
    }
    const auto read = imaging::load_dicom(test::only_series(folder.path()));
    QCOMPARE(test::failure(read), QString());
    QVERIFY(read->voxels == written.voxels);
  }

  // Wherever the last slice ends: its series must not be taken for a shorter one.
  void a_truncated_slice_never_goes_unnoticed() {
    const test::TemporaryFolder folder;
    const auto files = test::write_series(test::sample_volume({7, 5, 3}), folder / "series");
    const auto whole = fs::file_size(files[2]);
    const test::TemporaryFolder safe;
    fs::copy_file(files[2], safe / "whole.dcm");
    for (std::uintmax_t kept = 0; kept < whole; kept += kept + 64 < whole ? 16 : 1) {
      fs::copy_file(safe / "whole.dcm", files[2], fs::copy_options::overwrite_existing);
      test::truncate(files[2], kept);
      const imaging::Series series = test::only_series(folder.path());
      const std::string said =
          series.loadable && !series.warnings.empty() ? series.warnings.front() : series.reason;
      QVERIFY2(said.find("slice-00003.dcm") != std::string::npos,
               qPrintable(QString::number(kept) + ": " + said.c_str()));
      if (series.loadable) QCOMPARE(series.files.size(), std::size_t{2});
    }
  }

  // The header survives, the pixels do not: an error when the series was listed before.
  void damaged_files_beside_a_series_are_one_warning() {
    const test::TemporaryFolder folder;
    test::write_series(test::sample_volume({7, 5, 4}), folder / "series");
    for (const char* name : {"a.dcm", "b.dcm", "c.dcm"}) write_bytes(folder / "series" / name, "lost");
    const imaging::Series series = test::only_series(folder.path());
    QVERIFY2(series.loadable, series.reason.c_str());
    QCOMPARE(series.warnings.size(), std::size_t{1});
    const QString warning = QString::fromStdString(series.warnings.front());
    QCOMPARE(warning, QString("a.dcm lies in the same folder and is not a DICOM file (and 2 more cannot be "
                              "read): a slice may be missing"));
  }

  void a_slice_that_shrinks_after_the_scan_is_an_error() {
    const test::TemporaryFolder folder;
    const auto files = test::write_series(test::sample_volume({7, 5, 3}), folder / "series");
    const imaging::Series series = test::only_series(folder.path());
    test::truncate(files[1], fs::file_size(files[1]) - 20);
    const auto loaded = imaging::load_dicom(series);
    QVERIFY(!loaded);
    QVERIFY2(loaded.error().message.find("slice-00002.dcm") != std::string::npos,
             loaded.error().message.c_str());
    fs::remove(files[1]);
    QVERIFY(!imaging::load_dicom(series));
  }

  void what_is_not_dicom_is_skipped_with_a_reason() {
    const test::TemporaryFolder folder;
    test::write_series(test::sample_volume({7, 5, 2}), folder / "series");
    const fs::path notes = folder.path() / "series" / "notes.txt";
    write_bytes(notes, "Not an image.\n");
    write_bytes(folder / "empty.dcm", "");
    write_bytes(folder / "preamble", test::preamble());
    write_bytes(folder / "noise.dcm", test::preamble() + std::string(500, '\x42'));
    const auto found = imaging::scan_dicom(folder.path());
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), std::size_t{1});
    QVERIFY2(found->series[0].loadable, found->series[0].reason.c_str());
    QVERIFY(found->series[0].warnings.empty());
    QCOMPARE(found->skipped.size(), std::size_t{4});
    for (const imaging::SkippedFile& skipped : found->skipped) QVERIFY(!skipped.reason.empty());
    const auto alone = imaging::scan_dicom(notes);
    QVERIFY(!alone);
    QCOMPARE(alone.error().message, notes.string() + ": is not a DICOM file");
    QVERIFY(!imaging::looks_like_dicom(notes));
    QVERIFY(!imaging::looks_like_dicom(folder / "empty.dcm"));
    QVERIFY(imaging::looks_like_dicom(folder / "preamble"));
  }

  // Whether slices may be lost with it: what the reader knows, not what its message says.
  void a_refused_file_is_damaged_or_something_else() {
    using test::Dataset;
    const test::TemporaryFolder folder;
    const auto kind = [&](const std::string& bytes) {
      write_bytes(folder / "file", bytes);
      const auto read = imaging::read_slice_headers(folder / "file");
      return read ? std::nullopt : std::optional(read.error().file_kind);
    };
    using Kind = imaging::Refusal::Kind;
    QVERIFY(kind(test::file(Dataset::slice())) == std::nullopt);
    QVERIFY(kind("Not an image.\n") == Kind::not_dicom);
    QVERIFY(kind(test::preamble()) == Kind::damaged);
    QVERIFY(kind(test::preamble() + std::string(500, '\x42')) == Kind::damaged);
    Dataset report;
    report.put_text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.88.11");
    QVERIFY(kind(test::file(report)) == Kind::no_slice);
    fs::remove(folder / "file");
    const auto missing = imaging::read_slice_headers(folder / "file");
    QVERIFY(!missing && missing.error().file_kind == Kind::damaged);
  }

  // As old archives keep it: the dataset alone, with neither preamble nor meta header.
  void a_file_without_preamble_is_read() {
    const test::TemporaryFolder folder;
    const Volume written = test::sample_volume({7, 5, 2});
    for (const fs::path& file : test::write_series(written, folder / "series")) {
      DcmFileFormat loaded;
      QVERIFY(loaded.loadFile(file.c_str()).good());
      loaded.loadAllDataIntoMemory();
      QVERIFY(loaded.getDataset()->saveFile(file.c_str(), EXS_LittleEndianImplicit).good());
      QVERIFY(imaging::looks_like_dicom(file));
    }
    const auto read = imaging::load_dicom(test::only_series(folder.path()));
    QCOMPARE(test::failure(read), QString());
    QVERIFY(read->voxels == written.voxels);
  }

  void sequences_64_deep_are_read() {
    for (const bool has_lengths : {false, true}) {
      const test::TemporaryFolder folder;
      const std::string deep = test::nested(64, "SQ", test::kExplicit, has_lengths);
      write_bytes(folder / "deep.dcm", test::file(test::Dataset::slice().put(0x00081140, deep)));
      QCOMPARE(test::failure(imaging::decode_frame(folder / "deep.dcm")), QString());
    }
  }

  // They say nothing about where or what the image is.
  void what_is_unknown_and_does_no_harm_is_read() {
    using test::element;
    const test::TemporaryFolder folder;
    test::Dataset slice = test::Dataset::slice();
    slice.put_text(0x00080005, "CS", "ISO_IR 4711")
        .put_text(0x0008103e, "LO",
                  "R\xfc"
                  "ckgrat");
    slice.put(0x00091010, element(0x00091010, "ZZ", "abcd"));
    slice.put(0x00091011, element(0x00091011, "??", "abcd"));
    slice.put(0x00091012, element(0x00091012, "UN", "\xfe\xff"));
    write_bytes(folder / "odd.dcm", test::file(slice));
    const auto read = imaging::decode_frame(folder / "odd.dcm");
    QCOMPARE(test::failure(read), QString());
    QCOMPARE(read->header.description, std::string("R?ckgrat"));
    QCOMPARE(read->pixels.stored.back(), 1100);
  }

  void a_deflated_slice_is_read() {
    const test::TemporaryFolder folder;
    const std::string stream = test::deflated(test::Dataset::slice().bytes());
    write_bytes(folder / "deflated.dcm", test::file("1.2.840.10008.1.2.1.99", stream));
    const auto read = imaging::decode_frame(folder / "deflated.dcm");
    QCOMPARE(test::failure(read), QString());
    QCOMPARE(read->pixels.stored.back(), 1100);
  }

  void a_folder_of_very_many_files_is_listed() {
    const test::TemporaryFolder folder;
    test::write_series(test::sample_volume({7, 5, 2}), folder / "series");
    constexpr int kFiles = 5000;
    for (int k = 0; k < kFiles; ++k) write_bytes(folder.path() / "series" / std::to_string(k), "no image");
    const auto found = imaging::scan_dicom(folder.path());
    QCOMPARE(test::failure(found), QString());
    QVERIFY2(found->series.at(0).loadable, found->series[0].reason.c_str());
    QCOMPARE(found->skipped.size(), std::size_t{kFiles});
  }

  void links_in_circles_are_not_followed() {
    const test::TemporaryFolder folder;
    test::write_series(test::sample_volume({7, 5, 2}), folder / "series");
    fs::create_directory_symlink(folder.path(), folder.path() / "series" / "again");
    QVERIFY(test::only_series(folder.path()).loadable);
  }
};

TIDEMARK_TEST(DicomDamageTest)

}  // namespace tidemark::test::dicom_damage_test

#include "dicom_damage_test.moc"
