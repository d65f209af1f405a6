#include "tests/imaging/dicom/recode.h"

#include <dcmtk/dcmdata/dcpixel.h>
#include <dcmtk/dcmdata/dcpixseq.h>
#include <dcmtk/dcmdata/dcpxitem.h>
#include <dcmtk/dcmdata/dcrleerg.h>
#include <dcmtk/dcmjpeg/djencode.h>
#include <dcmtk/dcmjpeg/djrploss.h>
#include <dcmtk/dcmjpls/djencode.h>
#include <dcmtk/dcmjpls/djrparam.h>
#include <openjpeg.h>

#include <algorithm>
#include <memory>

#include "imaging/guard/dicom/transfer_syntaxes.h"

namespace tidemark::test {
namespace {

constexpr int kLeastJpegLsPixels = 200;

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

bool is_j2k(E_TransferSyntax syntax) {
  return syntax == EXS_JPEG2000 || syntax == EXS_JPEG2000LosslessOnly;
}

}  // namespace

void register_encoders() {
  DcmRLEEncoderRegistration::registerCodecs();
  DJEncoderRegistration::registerCodecs();
  DJLSEncoderRegistration::registerCodecs();
}

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

bool recode(const std::filesystem::path& file, E_TransferSyntax syntax, bool is_signed) {
  DcmFileFormat loaded;
  if (loaded.loadFile(file.c_str()).bad()) return false;
  loaded.loadAllDataIntoMemory();
  DcmDataset& dataset = *loaded.getDataset();
  Uint16 rows = 0;
  Uint16 columns = 0;
  Uint16 bits = 0;
  dataset.findAndGetUint16(DCM_Rows, rows);
  dataset.findAndGetUint16(DCM_Columns, columns);
  dataset.findAndGetUint16(DCM_BitsStored, bits);
  const bool is_jpeg_ls = syntax == EXS_JPEGLSLossless || syntax == EXS_JPEGLSLossy;
  if (is_jpeg_ls && rows * columns < kLeastJpegLsPixels) return false;
  if (is_j2k(syntax)) {
    const auto stream =
        encode_j2k(values_of(dataset, is_signed), columns, rows, bits, is_signed, syntax == EXS_JPEG2000);
    if (stream.empty()) return false;
    encapsulate(dataset, syntax, stream, 3);
  } else if (imaging::find_transfer_syntax(DcmXfer(syntax).getXferID())->is_encapsulated()) {
    DJ_RPLossy lossy(95);
    DJLSRepresentationParameter near(2, OFFalse);
    const DcmRepresentationParameter* parameter = nullptr;
    if (syntax == EXS_JPEGProcess2_4) parameter = &lossy;
    if (syntax == EXS_JPEGLSLossy) parameter = &near;
    if (dataset.chooseRepresentation(syntax, parameter).bad()) return false;
  }
  return loaded.saveFile(file.c_str(), syntax).good();
}

}  // namespace tidemark::test
