// The same voxels in every transfer syntax.
#include <QMetaType>
#include <algorithm>
#include <cmath>

#include "imaging/dicom/dicom.h"
#include "imaging/dicom/j2k_stream.h"
#include "imaging/dicom/pixels.h"
#include "tests/imaging/dicom/dicom_bytes.h"
#include "tests/imaging/dicom/ht_streams.h"
#include "tests/imaging/dicom/recode.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::dicom_syntaxes_test {

namespace fs = std::filesystem;

namespace {

// A picture with some structure, within 12 bits.
Volume smooth_volume() {
  Volume volume = test::sample_volume_uint16({48, 40, 3});
  auto& voxels = std::get<std::vector<std::uint16_t>>(volume.voxels);
  for (std::size_t v = 0; v < voxels.size(); ++v) {
    const Index3 at = volume.geometry.voxel_at(static_cast<std::int64_t>(v));
    const auto column = static_cast<double>(at.x);
    const auto row = static_cast<double>(at.y + volume.geometry.size.y * at.z);
    voxels[v] =
        static_cast<std::uint16_t>(2000.0 + 900.0 * std::sin(column / 9.0) + 700.0 * std::cos(row / 7.0));
  }
  return volume;
}

}  // namespace

class DicomSyntaxesTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { test::register_encoders(); }

  void voxels_are_the_same_in_every_lossless_syntax_data() {
    QTest::addColumn<E_TransferSyntax>("syntax");
    QTest::addColumn<bool>("is_signed");
    for (const E_TransferSyntax syntax :
         {EXS_LittleEndianImplicit, EXS_BigEndianExplicit, EXS_DeflatedLittleEndianExplicit, EXS_RLELossless,
          EXS_JPEGProcess14, EXS_JPEGProcess14SV1, EXS_JPEGLSLossless, EXS_JPEG2000LosslessOnly}) {
      for (const bool is_signed : {false, true}) {
        QTest::addRow("%s %s", DcmXfer(syntax).getXferName(), is_signed ? "signed" : "unsigned")
            << syntax << is_signed;
      }
    }
  }

  void voxels_are_the_same_in_every_lossless_syntax() {
    QFETCH(E_TransferSyntax, syntax);
    QFETCH(bool, is_signed);
    const Index3 size{17, 13, 3};
    const Volume written = is_signed ? test::sample_volume(size) : test::sample_volume_uint16(size);
    const test::TemporaryFolder folder;
    for (const fs::path& file : test::write_series(written, folder / "series")) {
      QVERIFY(test::recode(file, syntax, is_signed));
    }
    const imaging::Series series = test::only_series(folder.path());
    QVERIFY2(series.loadable, series.reason.c_str());
    QCOMPARE(series.transfer_syntaxes, std::vector<std::string>{DcmXfer(syntax).getXferID()});
    QVERIFY(series.warnings.empty());
    const auto read = imaging::load_dicom(series);
    QCOMPARE(test::failure(read), QString());
    QVERIFY(read->voxels == written.voxels);
    QVERIFY(same_grid(read->geometry, written.geometry, 1e-6));
  }

  void voxels_are_near_in_lossy_syntaxes_and_the_loss_is_said_data() {
    QTest::addColumn<E_TransferSyntax>("syntax");
    QTest::addColumn<int>("tolerance");
    QTest::newRow("JPEG extended, 12 bits") << EXS_JPEGProcess2_4 << 8;
    QTest::newRow("JPEG-LS near lossless") << EXS_JPEGLSLossy << 2;
    QTest::newRow("JPEG 2000") << EXS_JPEG2000 << 8;
  }

  void voxels_are_near_in_lossy_syntaxes_and_the_loss_is_said() {
    QFETCH(E_TransferSyntax, syntax);
    QFETCH(int, tolerance);
    const Volume written = smooth_volume();
    const test::TemporaryFolder folder;
    for (const fs::path& file : test::write_series(written, folder / "series")) {
      test::edit(file, [](DcmDataset& dataset) {
        dataset.putAndInsertUint16(DCM_BitsStored, 12);
        dataset.putAndInsertUint16(DCM_HighBit, 11);
      });
      QVERIFY(test::recode(file, syntax, false));
    }
    const imaging::Series series = test::only_series(folder.path());
    QVERIFY2(series.loadable, series.reason.c_str());
    QVERIFY(!series.warnings.empty() && series.warnings[0].find("with loss") != std::string::npos);
    const auto read = imaging::load_dicom(series);
    QCOMPARE(test::failure(read), QString());
    float worst = 0.0F;
    for (std::int64_t v = 0; v < written.geometry.voxel_count(); ++v) {
      worst = std::max(worst, std::abs(read->value(v) - written.value(v)));
    }
    QVERIFY2(worst > 0.0F && worst <= static_cast<float>(tolerance), qPrintable(QString::number(worst)));
  }

  void high_throughput_streams_are_refused_data() {
    QTest::addColumn<QByteArray>("syntax");
    QTest::addColumn<QString>("reason");
    QTest::newRow("lossless") << QByteArray("1.2.840.10008.1.2.4.201")
                              << "High-Throughput JPEG 2000 (Lossless";
    QTest::newRow("RPCL") << QByteArray("1.2.840.10008.1.2.4.202") << "High-Throughput JPEG 2000 with RPCL";
    QTest::newRow("lossy") << QByteArray("1.2.840.10008.1.2.4.203") << "High-Throughput JPEG 2000)";
    QTest::newRow("as JPEG 2000") << QByteArray("1.2.840.10008.1.2.4.90") << "is a high-throughput one";
  }

  void high_throughput_streams_are_refused() {
    QFETCH(QByteArray, syntax);
    QFETCH(QString, reason);
    const auto stream = QByteArray::fromHex({test::kHt12Bits.data(), qsizetype{test::kHt12Bits.size()}});
    const std::string whole = stream.toStdString() + std::string(stream.size() % 2, '\0');
    // Without the marker that announces it (CAP, ten bytes after SIZ), too.
    std::string unannounced = whole;
    unannounced.erase(unannounced.find("\xff\x50"), 10);
    const test::TemporaryFolder folder;
    for (const std::string& frame : {whole, unannounced}) {
      test::Dataset dataset = test::Dataset::slice();
      dataset.put_number(0x00280010, test::kHtRows).put_number(0x00280011, test::kHtColumns);
      dataset.put_number(0x00280101, 12).put_number(0x00280102, 11);
      dataset.put(test::kPixels, test::encapsulated(frame));
      test::write_bytes(folder / "slice.dcm", test::file(syntax.toStdString(), dataset.bytes()));
      const auto slice = imaging::decode_frame(folder / "slice.dcm");
      QVERIFY2(test::failure(slice).contains(reason), qPrintable(test::failure(slice)));
    }
  }

  void slices_of_one_series_may_come_in_different_syntaxes() {
    const Volume written = test::sample_volume({17, 13, 3});
    const test::TemporaryFolder folder;
    const auto files = test::write_series(written, folder / "series");
    QVERIFY(test::recode(files[0], EXS_RLELossless, true));
    QVERIFY(test::recode(files[1], EXS_JPEG2000LosslessOnly, true));
    const imaging::Series series = test::only_series(folder.path());
    QCOMPARE(series.transfer_syntaxes.size(), std::size_t{3});
    const auto read = imaging::load_dicom(series);
    QCOMPARE(test::failure(read), QString());
    QVERIFY(read->voxels == written.voxels);
  }

  void a_j2k_stream_must_be_of_the_size_that_was_promised() {
    const std::vector<std::int32_t> values(12, 7);
    const auto stream = test::encode_j2k(values, 4, 3, 16, false, false);
    QVERIFY(!stream.empty());
    const auto image = imaging::decode_j2k(stream, 4, 3);
    QCOMPARE(test::failure(image), QString());
    QCOMPARE(image->values, values);
    QCOMPARE(image->precision, 16);
    QVERIFY(!imaging::decode_j2k(stream, 3, 4));
    QVERIFY(!imaging::decode_j2k(stream, 4, 4));
    QVERIFY(!imaging::decode_j2k(std::vector<std::uint8_t>{}, 4, 3));
    QVERIFY(!imaging::decode_j2k(std::vector<std::uint8_t>(64, 0xff), 4, 3));
  }

  void a_j2k_stream_that_ends_early_is_an_error() {
    std::vector<std::int32_t> values(64 * 64);
    for (std::size_t v = 0; v < values.size(); ++v)
      values[v] = static_cast<std::int32_t>(v * 2654435761U % 4096);
    const auto stream = test::encode_j2k(values, 64, 64, 12, false, false);
    for (const std::size_t kept : {stream.size() / 2, stream.size() / 10, std::size_t{40}, std::size_t{3}}) {
      const std::vector<std::uint8_t> part(stream.begin(),
                                           stream.begin() + static_cast<std::ptrdiff_t>(kept));
      QVERIFY2(!imaging::decode_j2k(part, 64, 64), qPrintable(QString::number(kept)));
    }
  }

  void a_j2k_stream_that_contradicts_its_dataset_is_refused_by_name() {
    const Volume written = test::sample_volume_uint16({4, 3, 2});
    const test::TemporaryFolder folder;
    const auto files = test::write_series(written, folder / "series");
    const std::vector<std::int32_t> negative(12, -5);
    for (const fs::path& file : files) {
      DcmFileFormat loaded;
      QVERIFY(loaded.loadFile(file.c_str()).good());
      test::encapsulate(*loaded.getDataset(), EXS_JPEG2000LosslessOnly,
                        test::encode_j2k(negative, 4, 3, 16, true, false), 1);
      QVERIFY(loaded.saveFile(file.c_str(), EXS_JPEG2000LosslessOnly).good());
    }
    const auto read = imaging::load_dicom(test::only_series(folder.path()));
    QVERIFY(!read);
    QVERIFY2(read.error().message.find("slice-00001.dcm") != std::string::npos, read.error().message.c_str());
    QVERIFY2(read.error().message.find("PixelRepresentation") != std::string::npos,
             read.error().message.c_str());
  }
};

TIDEMARK_TEST(DicomSyntaxesTest)

}  // namespace tidemark::test::dicom_syntaxes_test

#include "dicom_syntaxes_test.moc"
