// The same voxels in every transfer syntax.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcpixel.h>
#include <dcmtk/dcmdata/dcpixseq.h>
#include <dcmtk/dcmdata/dcpxitem.h>
#include <dcmtk/dcmdata/dcrleerg.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmjpeg/djencode.h>
#include <dcmtk/dcmjpeg/djrploss.h>
#include <dcmtk/dcmjpls/djencode.h>
#include <dcmtk/dcmjpls/djrparam.h>
#include <openjpeg.h>

#include <QMetaType>
#include <algorithm>
#include <cmath>
#include <memory>

#include "imaging/dicom/dicom.h"
#include "imaging/dicom/j2k_stream.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"

using namespace tidemark;
namespace fs = std::filesystem;

namespace {

struct Sink {
  std::vector<std::uint8_t> bytes;
  std::size_t at = 0;
};

OPJ_SIZE_T write_bytes(void* data, OPJ_SIZE_T count, void* user) {
  auto& sink = *static_cast<Sink*>(user);
  sink.bytes.resize(std::max(sink.bytes.size(), sink.at + count));
  std::copy_n(static_cast<const std::uint8_t*>(data), count,
              sink.bytes.begin() + static_cast<std::ptrdiff_t>(sink.at));
  sink.at += count;
  return count;
}

OPJ_OFF_T skip_bytes(OPJ_OFF_T count, void* user) {
  static_cast<Sink*>(user)->at += static_cast<std::size_t>(count);
  return count;
}

OPJ_BOOL seek_bytes(OPJ_OFF_T position, void* user) {
  static_cast<Sink*>(user)->at = static_cast<std::size_t>(position);
  return OPJ_TRUE;
}

// A JPEG 2000 codestream of one component; empty on failure.
std::vector<std::uint8_t> encode_j2k(const std::vector<std::int32_t>& values, int columns, int rows,
                                     int precision, bool is_signed, bool lossy) {
  opj_image_cmptparm_t component{};
  component.dx = component.dy = 1;
  component.w = static_cast<OPJ_UINT32>(columns);
  component.h = static_cast<OPJ_UINT32>(rows);
  component.prec = static_cast<OPJ_UINT32>(precision);
  component.sgnd = is_signed ? 1 : 0;
  opj_image_t* image = opj_image_create(1, &component, OPJ_CLRSPC_GRAY);
  image->x1 = component.w;
  image->y1 = component.h;
  std::copy(values.begin(), values.end(), image->comps[0].data);

  opj_cparameters_t parameters;
  opj_set_default_encoder_parameters(&parameters);
  parameters.numresolution = 2;
  parameters.tcp_numlayers = 1;
  parameters.cp_disto_alloc = 1;
  parameters.irreversible = lossy ? 1 : 0;
  parameters.tcp_rates[0] = lossy ? 4.0F : 0.0F;
  opj_codec_t* codec = opj_create_compress(OPJ_CODEC_J2K);
  opj_stream_t* stream = opj_stream_default_create(OPJ_FALSE);
  Sink sink;
  opj_stream_set_write_function(stream, write_bytes);
  opj_stream_set_skip_function(stream, skip_bytes);
  opj_stream_set_seek_function(stream, seek_bytes);
  opj_stream_set_user_data(stream, &sink, nullptr);
  const bool done = opj_setup_encoder(codec, &parameters, image) &&
                    opj_start_compress(codec, image, stream) && opj_encode(codec, stream) &&
                    opj_end_compress(codec, stream);
  opj_stream_destroy(stream);
  opj_destroy_codec(codec);
  opj_image_destroy(image);
  return done ? sink.bytes : std::vector<std::uint8_t>();
}

std::vector<std::int32_t> values_of(DcmDataset& dataset, bool is_signed) {
  const Uint16* words = nullptr;
  unsigned long count = 0;
  dataset.findAndGetUint16Array(DCM_PixelData, words, &count);
  std::vector<std::int32_t> values(words, words + count);
  if (is_signed) {
    for (auto& value : values) value = static_cast<std::int16_t>(value);
  }
  return values;
}

// Replaces the pixel data by a codestream in `fragments` pieces.
void encapsulate(DcmDataset& dataset, E_TransferSyntax syntax, std::vector<std::uint8_t> stream,
                 int fragments) {
  if (stream.size() % 2 != 0) stream.push_back(0);
  auto sequence = std::make_unique<DcmPixelSequence>(DCM_PixelSequenceTag);
  sequence->insert(new DcmPixelItem(DCM_PixelItemTag));  // the offset table
  const std::size_t piece = (stream.size() / static_cast<std::size_t>(fragments) + 1) / 2 * 2;
  for (std::size_t at = 0; at < stream.size(); at += piece) {
    auto item = std::make_unique<DcmPixelItem>(DCM_PixelItemTag);
    item->putUint8Array(stream.data() + at, static_cast<unsigned long>(std::min(piece, stream.size() - at)));
    sequence->insert(item.release());
  }
  auto pixels = std::make_unique<DcmPixelData>(DcmTag(DCM_PixelData, EVR_OB));
  pixels->putOriginalRepresentation(syntax, nullptr, sequence.release());
  dataset.insert(pixels.release(), OFTrue);
}

bool is_j2k(E_TransferSyntax syntax) {
  return syntax == EXS_JPEG2000 || syntax == EXS_JPEG2000LosslessOnly;
}

// Saves the file again in another transfer syntax; false when that fails.
bool recode(const fs::path& file, E_TransferSyntax syntax, bool is_signed) {
  DcmFileFormat loaded;
  if (loaded.loadFile(file.c_str()).bad()) return false;
  loaded.loadAllDataIntoMemory();
  DcmDataset& dataset = *loaded.getDataset();
  if (is_j2k(syntax)) {
    Uint16 rows = 0;
    Uint16 columns = 0;
    Uint16 bits = 0;
    dataset.findAndGetUint16(DCM_Rows, rows);
    dataset.findAndGetUint16(DCM_Columns, columns);
    dataset.findAndGetUint16(DCM_BitsStored, bits);
    const auto stream =
        encode_j2k(values_of(dataset, is_signed), columns, rows, bits, is_signed, syntax == EXS_JPEG2000);
    if (stream.empty()) return false;
    encapsulate(dataset, syntax, stream, 3);
  } else if (DcmXfer(syntax).isEncapsulated()) {
    DJ_RPLossy lossy(95);
    DJLSRepresentationParameter near(2, OFFalse);
    const DcmRepresentationParameter* parameter = nullptr;
    if (syntax == EXS_JPEGProcess2_4) parameter = &lossy;
    if (syntax == EXS_JPEGLSLossy) parameter = &near;
    if (dataset.chooseRepresentation(syntax, parameter).bad()) return false;
  }
  return loaded.saveFile(file.c_str(), syntax).good();
}

// A picture with some structure, within 12 bits.
Volume smooth_volume() {
  Volume volume = test::sample_volume_uint16({48, 40, 3});
  auto& voxels = std::get<std::vector<std::uint16_t>>(volume.voxels);
  for (std::size_t v = 0; v < voxels.size(); ++v) {
    const auto column = static_cast<double>(v % 48);
    const auto row = static_cast<double>(v / 48);
    voxels[v] =
        static_cast<std::uint16_t>(2000.0 + 900.0 * std::sin(column / 9.0) + 700.0 * std::cos(row / 7.0));
  }
  return volume;
}

}  // namespace

Q_DECLARE_METATYPE(E_TransferSyntax)

class DicomSyntaxesTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    DcmRLEEncoderRegistration::registerCodecs();
    DJEncoderRegistration::registerCodecs();
    DJLSEncoderRegistration::registerCodecs();
  }

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
      QVERIFY(recode(file, syntax, is_signed));
    }
    const Series series = test::only_series(folder.path());
    QVERIFY2(series.loadable, series.reason.c_str());
    QCOMPARE(series.transfer_syntaxes, std::vector<std::string>{DcmXfer(syntax).getXferID()});
    QVERIFY(series.warnings.empty());
    const auto read = load_dicom(series);
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
      QVERIFY(recode(file, syntax, false));
    }
    const Series series = test::only_series(folder.path());
    QVERIFY2(series.loadable, series.reason.c_str());
    QVERIFY(!series.warnings.empty() && series.warnings[0].find("with loss") != std::string::npos);
    const auto read = load_dicom(series);
    QCOMPARE(test::failure(read), QString());
    float worst = 0.0F;
    for (std::int64_t v = 0; v < written.geometry.voxel_count(); ++v) {
      worst = std::max(worst, std::abs(read->value(v) - written.value(v)));
    }
    QVERIFY2(worst > 0.0F && worst <= static_cast<float>(tolerance), qPrintable(QString::number(worst)));
  }

  void slices_of_one_series_may_come_in_different_syntaxes() {
    const Volume written = test::sample_volume({17, 13, 3});
    const test::TemporaryFolder folder;
    const auto files = test::write_series(written, folder / "series");
    QVERIFY(recode(files[0], EXS_RLELossless, true));
    QVERIFY(recode(files[1], EXS_JPEG2000LosslessOnly, true));
    const Series series = test::only_series(folder.path());
    QCOMPARE(series.transfer_syntaxes.size(), std::size_t{3});
    const auto read = load_dicom(series);
    QCOMPARE(test::failure(read), QString());
    QVERIFY(read->voxels == written.voxels);
  }

  void a_j2k_stream_must_be_of_the_size_that_was_promised() {
    const std::vector<std::int32_t> values(12, 7);
    const auto stream = encode_j2k(values, 4, 3, 16, false, false);
    QVERIFY(!stream.empty());
    const auto image = decode_j2k(stream, 4, 3);
    QCOMPARE(test::failure(image), QString());
    QCOMPARE(image->values, values);
    QCOMPARE(image->precision, 16);
    QVERIFY(!decode_j2k(stream, 3, 4));
    QVERIFY(!decode_j2k(stream, 4, 4));
    QVERIFY(!decode_j2k(std::vector<std::uint8_t>{}, 4, 3));
    QVERIFY(!decode_j2k(std::vector<std::uint8_t>(64, 0xff), 4, 3));
  }

  void a_j2k_stream_that_ends_early_is_an_error() {
    std::vector<std::int32_t> values(64 * 64);
    for (std::size_t v = 0; v < values.size(); ++v)
      values[v] = static_cast<std::int32_t>(v * 2654435761U % 4096);
    const auto stream = encode_j2k(values, 64, 64, 12, false, false);
    for (const std::size_t kept : {stream.size() / 2, stream.size() / 10, std::size_t{40}, std::size_t{3}}) {
      const std::vector<std::uint8_t> part(stream.begin(),
                                           stream.begin() + static_cast<std::ptrdiff_t>(kept));
      QVERIFY2(!decode_j2k(part, 64, 64), qPrintable(QString::number(kept)));
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
      encapsulate(*loaded.getDataset(), EXS_JPEG2000LosslessOnly, encode_j2k(negative, 4, 3, 16, true, false),
                  1);
      QVERIFY(loaded.saveFile(file.c_str(), EXS_JPEG2000LosslessOnly).good());
    }
    const auto read = load_dicom(test::only_series(folder.path()));
    QVERIFY(!read);
    QVERIFY2(read.error().message.find("slice-00001.dcm") != std::string::npos, read.error().message.c_str());
    QVERIFY2(read.error().message.find("PixelRepresentation") != std::string::npos,
             read.error().message.c_str());
  }
};

QTEST_GUILESS_MAIN(DicomSyntaxesTest)
#include "dicom_syntaxes_test.moc"
