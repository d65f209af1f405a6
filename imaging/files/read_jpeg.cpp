// JPEG by libjpeg, whose errors are jumps: work that may raise one holds no object that would be left behind.
#include <cstdio>  // before jpeglib.h, which needs FILE

#include <jpeglib.h>

#include <jerror.h>
#include <setjmp.h>

#include <algorithm>
#include <array>

#include "imaging/files/exif_orientation.h"
#include "imaging/files/picture.h"

namespace tidemark::imaging::files {
namespace {

// Blocks of 8 x 8 pixels of one grey take half a bit each in a progressive picture.
constexpr std::int64_t kMostPixelsPerByte = 1024;
// Progressive pictures have some ten. Each costs time for the whole picture, whatever it holds.
constexpr int kMostScans = 32;

// What cameras leave behind, and no decoder minds; every other warning means that pixels are made up.
bool is_harmless(int code) {
  return code == JWRN_EXTRANEOUS_DATA || code == JWRN_JFIF_MAJOR || code == JWRN_ADOBE_XFORM;
}

class JpegPicture : public Picture {
 public:
  JpegPicture(FileBytes bytes, const std::filesystem::path& file) : bytes_(std::move(bytes)), file_(file) {}
  ~JpegPicture() override {
    if (is_created_) jpeg_destroy_decompress(&jpeg_);
  }
  JpegPicture(const JpegPicture&) = delete;
  JpegPicture& operator=(const JpegPicture&) = delete;

  Status open();
  Status read(const RowSink& sink, const Progress& progress) override;
  [[nodiscard]] std::vector<std::string> remarks() const override;

 private:
  static JpegPicture& self(j_common_ptr jpeg) { return *static_cast<JpegPicture*>(jpeg->client_data); }
  [[noreturn]] static void raise(j_common_ptr jpeg);
  static void take_message(j_common_ptr jpeg, int level);
  static void watch(j_common_ptr jpeg);
  static boolean fill(j_decompress_ptr jpeg);
  static void skip(j_decompress_ptr jpeg, long count);
  void set_up();

  // False where libjpeg raised an error.
  template <class Work>
  bool attempt(const Work& work) {
    if (setjmp(jump_) != 0) return false;
    work();
    return true;
  }
  [[nodiscard]] Status refusal() const {
    if (is_short_) return fail(ErrorKind::input, "{}: truncated: the picture ends early", file_.string());
    return fail(ErrorKind::input, "{}: cannot be read: {}", file_.string(), message_.data());
  }
  Status fill_header();

  FileBytes bytes_;
  std::filesystem::path file_;
  jpeg_decompress_struct jpeg_{};
  jpeg_error_mgr errors_{};
  jpeg_progress_mgr scans_{};
  jpeg_source_mgr source_{};
  jmp_buf jump_{};
  bool is_created_ = false;
  bool is_short_ = false;
  bool has_stray_bytes_ = false;
  std::int64_t at_ = 0;
  std::array<std::uint8_t, 1 << 16> window_{};
  std::array<char, JMSG_LENGTH_MAX> message_{};
};

void JpegPicture::raise(j_common_ptr jpeg) {
  JpegPicture& picture = self(jpeg);
  if (picture.message_[0] == '\0') jpeg->err->format_message(jpeg, picture.message_.data());
  longjmp(picture.jump_, 1);
}

void JpegPicture::take_message(j_common_ptr jpeg, int level) {
  if (level >= 0) return;  // told for tracing
  if (!is_harmless(jpeg->err->msg_code)) raise(jpeg);
  self(jpeg).has_stray_bytes_ |= jpeg->err->msg_code == JWRN_EXTRANEOUS_DATA;
}

void JpegPicture::watch(j_common_ptr jpeg) {
  if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number <= kMostScans) return;
  std::snprintf(self(jpeg).message_.data(), JMSG_LENGTH_MAX, "it has more than %d scans", kMostScans);
  raise(jpeg);
}

boolean JpegPicture::fill(j_decompress_ptr jpeg) {
  JpegPicture& picture = self(reinterpret_cast<j_common_ptr>(jpeg));
  const std::size_t count = picture.bytes_.read(picture.at_, picture.window_);
  if (count == 0) {
    picture.is_short_ = true;
    raise(reinterpret_cast<j_common_ptr>(jpeg));
  }
  picture.at_ += static_cast<std::int64_t>(count);
  picture.source_.next_input_byte = picture.window_.data();
  picture.source_.bytes_in_buffer = count;
  return TRUE;
}

void JpegPicture::skip(j_decompress_ptr jpeg, long count) {
  jpeg_source_mgr& source = *jpeg->src;
  while (count > 0) {
    if (source.bytes_in_buffer == 0) fill(jpeg);
    const auto here = std::min(static_cast<std::size_t>(count), source.bytes_in_buffer);
    source.next_input_byte += here;
    source.bytes_in_buffer -= here;
    count -= static_cast<long>(here);
  }
}

void JpegPicture::set_up() {
  jpeg_create_decompress(&jpeg_);
  is_created_ = true;
  jpeg_.client_data = this;
  scans_.progress_monitor = watch;
  jpeg_.progress = &scans_;
  source_.init_source = [](j_decompress_ptr) {};
  source_.term_source = [](j_decompress_ptr) {};
  source_.fill_input_buffer = fill;
  source_.skip_input_data = skip;
  source_.resync_to_restart = jpeg_resync_to_restart;
  jpeg_.src = &source_;
  constexpr unsigned kLongestMarker = 0xffff;
  jpeg_save_markers(&jpeg_, JPEG_APP0 + 1, kLongestMarker);
}

Status JpegPicture::open() {
  std::array<std::uint8_t, 2> start{};
  if (bytes_.read(0, start) != start.size() || start[0] != 0xff || start[1] != 0xd8) {
    return fail(ErrorKind::input, "{}: not a JPEG file: it does not begin with the marker SOI",
                file_.string());
  }
  jpeg_.err = jpeg_std_error(&errors_);
  jpeg_.client_data = this;  // for errors of the creation itself
  errors_.error_exit = raise;
  errors_.emit_message = take_message;
  const bool is_read = attempt([this] {
    set_up();
    jpeg_read_header(&jpeg_, TRUE);
  });
  if (!is_read) return refusal();
  return fill_header();
}

Status JpegPicture::fill_header() {
  if (jpeg_.num_components != 1 && jpeg_.num_components != 3) {
    return fail(ErrorKind::input, "{}: SOF: {} components a pixel are neither grey nor red, green and blue",
                file_.string(), jpeg_.num_components);
  }
  header_.columns = jpeg_.image_width;
  header_.rows = jpeg_.image_height;
  header_.channels = jpeg_.num_components;
  for (jpeg_saved_marker_ptr marker = jpeg_.marker_list; marker != nullptr; marker = marker->next) {
    const auto orientation = exif_orientation({marker->data, marker->data_length});
    if (orientation) header_.orientation = *orientation;
  }
  const glm::dvec2 density(jpeg_.X_density, jpeg_.Y_density);
  if (jpeg_.saw_JFIF_marker && jpeg_.density_unit == 1) header_.pixels_per_mm = density / 25.4;
  if (jpeg_.saw_JFIF_marker && jpeg_.density_unit == 2) header_.pixels_per_mm = density / 10.0;
  header_.warnings.emplace_back("compressed with loss (JPEG)");
  return require_held(header_, kMostPixelsPerByte, bytes_.size(), "SOF", file_);
}

Status JpegPicture::read(const RowSink& sink, const Progress& progress) {
  std::vector<std::uint8_t> row(static_cast<std::size_t>(header_.columns * header_.channels));
  std::vector<float> samples(row.size());
  const bool is_begun = attempt([this] {
    jpeg_.out_color_space = header_.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_.dct_method = JDCT_ISLOW;
    jpeg_start_decompress(&jpeg_);
  });
  if (!is_begun) return refusal();
  for (std::int64_t y = 0; y < header_.rows; ++y) {
    if (progress.cancelled()) return cancelled_error();
    JSAMPROW into = row.data();
    if (!attempt([&] { jpeg_read_scanlines(&jpeg_, &into, 1); })) return refusal();
    std::copy(row.begin(), row.end(), samples.begin());
    sink(0, y, samples);
  }
  if (!attempt([this] { jpeg_finish_decompress(&jpeg_); })) return refusal();
  return {};
}

std::vector<std::string> JpegPicture::remarks() const {
  if (!has_stray_bytes_) return {};
  return {"bytes that belong to no part of the picture are ignored"};
}

}  // namespace

Result<std::unique_ptr<Picture>> open_jpeg(FileBytes bytes, const std::filesystem::path& file) {
  auto picture = std::make_unique<JpegPicture>(std::move(bytes), file);
  TIDEMARK_TRY(picture->open());
  return picture;
}

}  // namespace tidemark::imaging::files
