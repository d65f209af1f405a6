#include "imaging/dicom/j2k_stream.h"

#include <openjpeg.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "imaging/dicom/j2k_markers.h"

namespace tidemark::imaging {
namespace {

struct Input {
  std::span<const std::uint8_t> bytes;
  std::size_t at = 0;
};

OPJ_SIZE_T read_bytes(void* buffer, OPJ_SIZE_T count, void* user) {
  auto& input = *static_cast<Input*>(user);
  const std::size_t left = input.bytes.size() - input.at;
  if (left == 0) return static_cast<OPJ_SIZE_T>(-1);
  const std::size_t taken = std::min<std::size_t>(count, left);
  std::memcpy(buffer, input.bytes.data() + input.at, taken);
  input.at += taken;
  return taken;
}

OPJ_OFF_T skip_bytes(OPJ_OFF_T count, void* user) {
  auto& input = *static_cast<Input*>(user);
  const std::size_t left = input.bytes.size() - input.at;
  if (count < 0) return -1;
  const std::size_t taken = std::min<std::size_t>(static_cast<std::size_t>(count), left);
  if (taken == 0 && count != 0) return -1;
  input.at += taken;
  return static_cast<OPJ_OFF_T>(taken);
}

OPJ_BOOL seek_bytes(OPJ_OFF_T position, void* user) {
  auto& input = *static_cast<Input*>(user);
  if (position < 0 || static_cast<std::size_t>(position) > input.bytes.size()) return OPJ_FALSE;
  input.at = static_cast<std::size_t>(position);
  return OPJ_TRUE;
}

void ignore_message(const char*, void*) {}

// The library's stream and codec are the same type, so that each needs a deleter of its own.
struct DestroyCodec {
  void operator()(opj_codec_t* codec) const { opj_destroy_codec(codec); }
};
struct DestroyImage {
  void operator()(opj_image_t* image) const { opj_image_destroy(image); }
};
struct DestroyStream {
  void operator()(opj_stream_t* stream) const { opj_stream_destroy(stream); }
};

using Codec = std::unique_ptr<opj_codec_t, DestroyCodec>;
using Image = std::unique_ptr<opj_image_t, DestroyImage>;
using J2kStream = std::unique_ptr<opj_stream_t, DestroyStream>;

J2kStream open_stream(Input& input) {
  J2kStream stream(opj_stream_default_create(OPJ_TRUE));
  if (!stream) return stream;
  opj_stream_set_read_function(stream.get(), read_bytes);
  opj_stream_set_skip_function(stream.get(), skip_bytes);
  opj_stream_set_seek_function(stream.get(), seek_bytes);
  opj_stream_set_user_data(stream.get(), &input, nullptr);
  opj_stream_set_user_data_length(stream.get(), input.bytes.size());
  return stream;
}

// A codestream starts with SOC and SIZ markers; anything else must be the boxes of a JP2 file.
Codec make_codec(std::span<const std::uint8_t> bytes) {
  constexpr std::uint8_t kStart[] = {0xff, 0x4f, 0xff, 0x51};
  const bool raw = bytes.size() >= 4 && std::equal(std::begin(kStart), std::end(kStart), bytes.begin());
  Codec codec(opj_create_decompress(raw ? OPJ_CODEC_J2K : OPJ_CODEC_JP2));
  if (!codec) return codec;
  // Silent without handlers of ours; but a missing handler means the library's own default.
  opj_set_info_handler(codec.get(), ignore_message, nullptr);
  opj_set_warning_handler(codec.get(), ignore_message, nullptr);
  opj_set_error_handler(codec.get(), ignore_message, nullptr);
  opj_dparameters_t parameters;
  opj_set_default_decoder_parameters(&parameters);
  if (opj_setup_decoder(codec.get(), &parameters) == OPJ_FALSE) return nullptr;
  // Otherwise a stream that ends early is filled up with zeros.
  if (opj_decoder_set_strict_mode(codec.get(), OPJ_TRUE) == OPJ_FALSE) return nullptr;
  return codec;
}

Status check_header(const opj_image_t& image, std::int64_t columns, std::int64_t rows) {
  if (image.numcomps != 1) {
    return fail(ErrorKind::input, "the JPEG 2000 stream has {} components, not 1", image.numcomps);
  }
  const std::int64_t width = static_cast<std::int64_t>(image.x1) - image.x0;
  const std::int64_t height = static_cast<std::int64_t>(image.y1) - image.y0;
  const opj_image_comp_t& component = image.comps[0];
  if (width != columns || height != rows || component.dx != 1 || component.dy != 1) {
    return fail(ErrorKind::input, "the JPEG 2000 stream is {} x {}, not {} x {}", width, height, columns,
                rows);
  }
  if (component.prec < 1 || component.prec > 31) {
    return fail(ErrorKind::input, "the JPEG 2000 stream has {} bits a value", component.prec);
  }
  return {};
}

}  // namespace

Result<J2kImage> decode_j2k(std::span<const std::uint8_t> bytes, std::int64_t columns, std::int64_t rows) {
  TIDEMARK_TRY(require_part_one(bytes));
  Input input{bytes};
  const J2kStream stream = open_stream(input);
  const Codec codec = make_codec(bytes);
  if (!stream || !codec) return fail(ErrorKind::internal, "the JPEG 2000 decoder does not start");

  opj_image_t* raw_image = nullptr;
  const bool has_header = opj_read_header(stream.get(), codec.get(), &raw_image) == OPJ_TRUE;
  const Image image(raw_image);
  if (!has_header || !image) return fail(ErrorKind::input, "the JPEG 2000 stream has no valid header");
  TIDEMARK_TRY(check_header(*image, columns, rows));
  if (opj_decode(codec.get(), stream.get(), image.get()) == OPJ_FALSE) {
    return fail(ErrorKind::input, "the JPEG 2000 stream is damaged");
  }
  const opj_image_comp_t& component = image->comps[0];
  if (component.data == nullptr || component.w != columns || component.h != rows) {
    return fail(ErrorKind::input, "the JPEG 2000 stream is damaged");
  }
  J2kImage result{columns, rows, static_cast<int>(component.prec), component.sgnd != 0, {}};
  result.values.assign(component.data, component.data + columns * rows);
  return result;
}

}  // namespace tidemark::imaging
