// PNG by libpng, whose errors are jumps: work that may raise one holds no object that would be left behind.
#include <png.h>

#include <array>
#include <bit>
#include <cstring>

#include "core/deflate_ratio.h"
#include "imaging/files/picture.h"

namespace tidemark::imaging::files {
namespace {

class PngPicture : public Picture {
 public:
  PngPicture(FileBytes bytes, const std::filesystem::path& file) : bytes_(std::move(bytes)), file_(file) {}
  ~PngPicture() override { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngPicture(const PngPicture&) = delete;
  PngPicture& operator=(const PngPicture&) = delete;

  Status open();
  Status read(const RowSink& sink, const Progress& progress) override;

 private:
  static void take_bytes(png_structp png, png_bytep into, std::size_t count);
  [[noreturn]] static void take_error(png_structp png, png_const_charp message);
  static void ignore_warning(png_structp /*png*/, png_const_charp /*message*/) {}

  // False where libpng raised an error.
  template <class Work>
  bool attempt(const Work& work) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    work();
    return true;
  }
  [[nodiscard]] Status refusal() const {
    if (is_short_) return fail(ErrorKind::input, "{}: truncated: the picture ends early", file_.string());
    return fail(ErrorKind::input, "{}: is damaged: {}", file_.string(), message_.data());
  }
  void ignore_texts();
  void fill_header();
  void give(const RowSink& sink, std::int64_t row, const std::uint8_t* bytes);

  FileBytes bytes_;
  std::filesystem::path file_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::int64_t at_ = 0;
  bool is_short_ = false;
  std::array<char, 160> message_{};
  int depth_ = 0;
  int colours_ = 0;
  int interlace_ = 0;
  std::vector<float> samples_;
};

void PngPicture::take_bytes(png_structp png, png_bytep into, std::size_t count) {
  auto& self = *static_cast<PngPicture*>(png_get_io_ptr(png));
  if (self.bytes_.read(self.at_, {into, count}) != count) {
    self.is_short_ = true;
    png_error(png, "the file ends early");
  }
  self.at_ += static_cast<std::int64_t>(count);
}

void PngPicture::take_error(png_structp png, png_const_charp message) {
  auto& self = *static_cast<PngPicture*>(png_get_error_ptr(png));
  std::strncpy(self.message_.data(), message, self.message_.size() - 1);
  png_longjmp(png, 1);
}

// Only what the pixels need is looked at: texts and profiles would be inflated.
void PngPicture::ignore_texts() {
  constexpr std::array<png_byte, 5 * 9> kIgnored{'i', 'C', 'C', 'P', 0,   'z', 'T', 'X', 't', 0,   'i', 'T',
                                                 'X', 't', 0,   't', 'E', 'X', 't', 0,   's', 'P', 'L', 'T',
                                                 0,   'e', 'X', 'I', 'f', 0,   'h', 'I', 'S', 'T', 0,   'g',
                                                 'A', 'M', 'A', 0,   'c', 'H', 'R', 'M', 0};
  png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, kIgnored.data(),
                              static_cast<int>(kIgnored.size() / 5));
}

Status PngPicture::open() {
  constexpr std::size_t kSignature = 8;
  std::array<png_byte, kSignature> start{};
  if (bytes_.read(0, start) != kSignature || png_sig_cmp(start.data(), 0, kSignature) != 0) {
    return fail(ErrorKind::input, "{}: not a PNG file: it does not begin with PNG's signature",
                file_.string());
  }
  png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, take_error, ignore_warning);
  info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
  if (info_ == nullptr) return fail(ErrorKind::capability, "libpng: no memory");
  const bool is_read = attempt([this] {
    png_set_read_fn(png_, this, take_bytes);
    ignore_texts();
    png_read_info(png_, info_);
    fill_header();
  });
  if (!is_read) return refusal();
  const std::int64_t row_bytes = (header_.columns * depth_ * png_get_channels(png_, info_) + 7) / 8 + 1;
  const std::int64_t deflated = row_bytes * header_.rows / kBestDeflateRatio;  // below 2^31 x 2^39
  if (deflated > bytes_.size()) {
    return fail(ErrorKind::input, "{}: IHDR: {} x {} pixels are more than its {} bytes can hold",
                file_.string(), header_.columns, header_.rows, bytes_.size());
  }
  return require_held(header_, kBestDeflateRatio, bytes_.size(), "IHDR", file_);
}

void PngPicture::fill_header() {
  png_uint_32 columns = 0;
  png_uint_32 rows = 0;
  png_get_IHDR(png_, info_, &columns, &rows, &depth_, &colours_, &interlace_, nullptr, nullptr);
  header_.columns = columns;
  header_.rows = rows;
  header_.channels = (colours_ & PNG_COLOR_MASK_COLOR) != 0 ? 3 : 1;
  header_.scalar = depth_ == 16 ? Scalar::uint16 : Scalar::uint8;
  header_.has_opacity =
      (colours_ & PNG_COLOR_MASK_ALPHA) != 0 || png_get_valid(png_, info_, PNG_INFO_tRNS) != 0;
  png_uint_32 across = 0;
  png_uint_32 down = 0;
  int unit = PNG_RESOLUTION_UNKNOWN;
  if (png_get_pHYs(png_, info_, &across, &down, &unit) != 0 && unit == PNG_RESOLUTION_METER) {
    header_.pixels_per_mm = {across / 1000.0, down / 1000.0};
  }
}

void PngPicture::give(const RowSink& sink, std::int64_t row, const std::uint8_t* bytes) {
  for (std::size_t s = 0; s < samples_.size(); ++s) {
    if (depth_ == 16) {
      std::uint16_t wide = 0;
      std::memcpy(&wide, bytes + 2 * s, sizeof(wide));
      samples_[s] = wide;
    } else {
      samples_[s] = bytes[s];
    }
  }
  sink(0, row, samples_);
}

Status PngPicture::read(const RowSink& sink, const Progress& progress) {
  int passes = 1;
  std::size_t row_bytes = 0;
  const bool is_set = attempt([&] {
    if (colours_ == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png_);
    if (depth_ < 8) png_set_packing(png_);  // greys keep their values
    if (depth_ == 16 && std::endian::native == std::endian::little) png_set_swap(png_);
    png_set_strip_alpha(png_);
    passes = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    row_bytes = png_get_rowbytes(png_, info_);
  });
  if (!is_set) return refusal();
  samples_.resize(static_cast<std::size_t>(header_.columns * header_.channels));
  if (row_bytes != samples_.size() * (depth_ == 16 ? 2 : 1)) {
    return fail(ErrorKind::internal, "{}: {} bytes are no row of {} samples", file_.string(), row_bytes,
                samples_.size());
  }
  // An interlaced picture is whole only after its last pass.
  const auto rows = static_cast<std::size_t>(header_.rows);
  std::vector<std::uint8_t> held(row_bytes * (passes == 1 ? 1 : rows));
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t row = 0; row < rows; ++row) {
      if (progress.cancelled()) return cancelled_error();
      std::uint8_t* const bytes = held.data() + (passes == 1 ? 0 : row * row_bytes);
      if (!attempt([&] { png_read_row(png_, bytes, nullptr); })) return refusal();
      if (pass + 1 == passes) give(sink, static_cast<std::int64_t>(row), bytes);
    }
  }
  if (!attempt([&] { png_read_end(png_, nullptr); })) return refusal();
  return {};
}

}  // namespace

Result<std::unique_ptr<Picture>> open_png(FileBytes bytes, const std::filesystem::path& file) {
  auto picture = std::make_unique<PngPicture>(std::move(bytes), file);
  TIDEMARK_TRY(picture->open());
  return picture;
}

}  // namespace tidemark::imaging::files
