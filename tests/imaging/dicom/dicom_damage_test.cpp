// Bad files: none may crash the reader, and each is refused by a reason that names file and field.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcpixel.h>
#include <dcmtk/dcmdata/dcpixseq.h>
#include <dcmtk/dcmdata/dcpxitem.h>
#include <dcmtk/dcmdata/dctk.h>

#include <fstream>
#include <functional>
#include <memory>

#include "imaging/dicom/dicom.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"

using namespace tidemark;
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

Q_DECLARE_METATYPE(Damage)

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
    row("intercept 1e999", text(DCM_RescaleIntercept, "1e999"), "RescaleIntercept (0028,1052) is '1e999'");
    row("rows 0", number(DCM_Rows, 0), "Rows (0028,0010) is 0");
    row("rows 65535", number(DCM_Rows, 65535), "PixelData (7FE0,0010) holds 70 bytes where 7 x 65535 pixels");
    row("no columns", without(DCM_Columns), "Columns (0028,0011) is missing");
    row("rows 4", number(DCM_Rows, 4), "PixelData (7FE0,0010) holds 70 bytes where 7 x 4 pixels");
    row(
        "rows differ",
        [](DcmDataset& d) {
          number(DCM_Rows, 4)(d);
          pixels(56)(d);
        },
        "the size (Rows, Columns)");
    row("0 bits", number(DCM_BitsAllocated, 0), "BitsAllocated (0028,0100) is 0");
    row("12 bits allocated", number(DCM_BitsAllocated, 12), "BitsAllocated (0028,0100) is 12");
    row("64 bits", number(DCM_BitsAllocated, 64), "BitsAllocated (0028,0100) is 64");
    row("17 bits stored", number(DCM_BitsStored, 17), "BitsStored (0028,0101) is 17");
    row("no bits stored", number(DCM_BitsStored, 0), "BitsStored (0028,0101) is 0");
    row("high bit 16", number(DCM_HighBit, 16), "HighBit (0028,0102) is 16");
    row("high bit 3", number(DCM_HighBit, 3), "HighBit (0028,0102) is 3");
    row("sign 2", number(DCM_PixelRepresentation, 2), "PixelRepresentation (0028,0103) is 2");
    row("3 samples", number(DCM_SamplesPerPixel, 3), "SamplesPerPixel (0028,0002) is 3");
    row("RGB", text(DCM_PhotometricInterpretation, "RGB"), "PhotometricInterpretation (0028,0004) is 'RGB'");
    row("odd colours", text(DCM_PhotometricInterpretation, "GREY"), "(0028,0004) is 'GREY'");
    row("mosaic", text(DCM_ImageType, "ORIGINAL\\PRIMARY\\MOSAIC"), "mosaic");
    row("enhanced", text(DCM_SOPClassUID, UID_EnhancedMRImageStorage), "EnhancedMRImageStorage");
    row("two frames", text(DCM_NumberOfFrames, "2"), "2 frames");
    row("frames as text", text(DCM_NumberOfFrames, "many"), "NumberOfFrames (0028,0008) is 'many'");
    row("frames -1", text(DCM_NumberOfFrames, "-1"), "NumberOfFrames (0028,0008) is '-1'");
    row("too many frames", text(DCM_NumberOfFrames, "99999999999999999999"),
        "(0028,0008) is '99999999999999999999'");
    row("no pixels", without(DCM_PixelData), "PixelData (7FE0,0010) is missing");
    row("empty pixels", pixels(0), "PixelData (7FE0,0010) holds 0 bytes");
    row("short pixels", pixels(10),
        "PixelData (7FE0,0010) holds 10 bytes where 7 x 5 pixels of 16 bits need 70");
    row("long pixels", pixels(90), "PixelData (7FE0,0010) holds 90 bytes");
    row("position as the neighbour", text(DCM_ImagePositionPatient, "-101.25\\37.5\\512.125"),
        "at the same position");
  }

  void a_bad_attribute_is_refused_by_file_and_field() {
    QFETCH(Damage, damage);
    QFETCH(QString, reason);
    const test::TemporaryFolder folder;
    const auto files = test::write_series(test::sample_volume({7, 5, 4}), folder / "series");
    test::edit(files[2], damage);
    const Series series = test::only_series(folder.path());
    QVERIFY(!series.loadable);
    const QString said = QString::fromStdString(series.reason);
    QVERIFY2(said.contains("slice-00003.dcm"), qPrintable(said));
    QVERIFY2(said.contains(reason), qPrintable(said));
    QVERIFY2(!said.contains('\n'), qPrintable(said));
    const auto loaded = load_dicom(series);
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
    const auto read = load_dicom(test::only_series(folder.path()));
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
      const Series series = test::only_series(folder.path());
      const std::string said =
          series.loadable && !series.warnings.empty() ? series.warnings.front() : series.reason;
      QVERIFY2(said.find("slice-00003.dcm") != std::string::npos,
               qPrintable(QString::number(kept) + ": " + said.c_str()));
      if (series.loadable) QCOMPARE(series.files.size(), std::size_t{2});
    }
  }

  // The header survives, the pixels do not: an error when the series was listed before.
  void a_slice_that_shrinks_after_the_scan_is_an_error() {
    const test::TemporaryFolder folder;
    const auto files = test::write_series(test::sample_volume({7, 5, 3}), folder / "series");
    const Series series = test::only_series(folder.path());
    test::truncate(files[1], fs::file_size(files[1]) - 20);
    const auto loaded = load_dicom(series);
    QVERIFY(!loaded);
    QVERIFY2(loaded.error().message.find("slice-00002.dcm") != std::string::npos,
             loaded.error().message.c_str());
    fs::remove(files[1]);
    QVERIFY(!load_dicom(series));
  }

  void encapsulated_pixels_without_a_frame_are_refused() {
    const test::TemporaryFolder folder;
    const auto files = test::write_series(test::sample_volume({7, 5, 2}), folder / "series");
    DcmFileFormat loaded;
    QVERIFY(loaded.loadFile(files[1].c_str()).good());
    auto sequence = std::make_unique<DcmPixelSequence>(DCM_PixelSequenceTag);
    sequence->insert(new DcmPixelItem(DCM_PixelItemTag));
    auto pixel_data = std::make_unique<DcmPixelData>(DcmTag(DCM_PixelData, EVR_OB));
    pixel_data->putOriginalRepresentation(EXS_RLELossless, nullptr, sequence.release());
    loaded.getDataset()->insert(pixel_data.release(), OFTrue);
    QVERIFY(loaded.saveFile(files[1].c_str(), EXS_RLELossless).good());
    const Series series = test::only_series(folder.path());
    QVERIFY(!series.loadable);
    QVERIFY2(series.reason.find("slice-00002.dcm: PixelData (7FE0,0010) holds no compressed frame") == 0,
             series.reason.c_str());
  }

  void what_is_not_dicom_is_skipped_with_a_reason() {
    const test::TemporaryFolder folder;
    test::write_series(test::sample_volume({7, 5, 2}), folder / "series");
    const fs::path notes = folder.path() / "series" / "notes.txt";
    write_bytes(notes, "Not an image.\n");
    write_bytes(folder / "empty.dcm", "");
    write_bytes(folder / "preamble", std::string(128, '\0') + "DICM");
    write_bytes(folder / "noise.dcm", std::string(128, '\0') + "DICM" + std::string(500, '\x42'));
    const auto found = scan_dicom(folder.path());
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), std::size_t{1});
    QVERIFY2(found->series[0].loadable, found->series[0].reason.c_str());
    QVERIFY(found->series[0].warnings.empty());
    QCOMPARE(found->skipped.size(), std::size_t{4});
    for (const SkippedFile& skipped : found->skipped) QVERIFY(!skipped.reason.empty());
    const auto alone = scan_dicom(notes);
    QVERIFY(!alone);
    QCOMPARE(alone.error().message, notes.string() + ": is not a DICOM file");
    QVERIFY(!looks_like_dicom(notes));
    QVERIFY(!looks_like_dicom(folder / "empty.dcm"));
    QVERIFY(looks_like_dicom(folder / "preamble"));
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
      QVERIFY(looks_like_dicom(file));
    }
    const auto read = load_dicom(test::only_series(folder.path()));
    QCOMPARE(test::failure(read), QString());
    QVERIFY(read->voxels == written.voxels);
  }

  void links_in_circles_are_not_followed() {
    const test::TemporaryFolder folder;
    test::write_series(test::sample_volume({7, 5, 2}), folder / "series");
    fs::create_directory_symlink(folder.path(), folder.path() / "series" / "again");
    QVERIFY(test::only_series(folder.path()).loadable);
  }
};

QTEST_GUILESS_MAIN(DicomDamageTest)
#include "dicom_damage_test.moc"
