// TIFF by libtiff: greys and colours in strips or tiles, of one page or several of one kind.
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "core/checked.h"
#include "imaging/files/picture.h"

namespace tidemark::imaging::files {
namespace {

constexpr std::int64_t kMostPages = 65535;
// What libtiff may take at once before the header is checked, beside the file's own size.
constexpr std::int64_t kMostMemory = std::int64_t{64} << 20;

// What a page is made of; those of one volume have the same.
struct Page {
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  std::uint16_t bits = 1;
  std::uint16_t samples = 1;
  std::uint16_t format = SAMPLEFORMAT_UINT;
  std::uint16_t meaning = PHOTOMETRIC_MINISBLACK;
  std::uint16_t planes = PLANARCONFIG_CONTIG;
  std::uint16_t compression = COMPRESSION_NONE;
  std::uint16_t orientation = ORIENTATION_TOPLEFT;

  bool operator==(const Page&) const = default;
};

// How many bytes a byte of the file becomes at most; 0 for a compression that is not read.
std::int64_t most_bytes_of_one(std::uint16_t compression) {
  switch (compression) {
    case COMPRESSION_NONE:
      return 1;
    case COMPRESSION_PACKBITS:
      return 64;
    case COMPRESSION_DEFLATE:
    case COMPRESSION_ADOBE_DEFLATE:
      return 1032;
    case COMPRESSION_LZW:
      return 2731;  // codes of 12 bits for strings of up to 4096
    default:
      return 0;
  }
}

std::optional<Scalar> scalar_of(const Page& page) {
  const bool is_signed = page.format == SAMPLEFORMAT_INT;
  if (page.format == SAMPLEFORMAT_IEEEFP) {
    return page.bits == 32 ? std::optional(Scalar::float32) : std::nullopt;
  }
  if (page.format != SAMPLEFORMAT_UINT && !is_signed) return std::nullopt;
  switch (page.bits) {
    case 1:
      return is_signed ? std::nullopt : std::optional(Scalar::uint8);
    case 8:
      return is_signed ? Scalar::int8 : Scalar::uint8;
    case 16:
      return is_signed ? Scalar::int16 : Scalar::uint16;
    case 32:
      return is_signed ? Scalar::int32 : Scalar::uint32;
    default:
      return std::nullopt;
  }
}

template <class Stored>
void convert(const std::uint8_t* bytes, std::vector<float>& samples) {
  for (std::size_t s = 0; s < samples.size(); ++s) {
    Stored stored{};
    std::memcpy(&stored, bytes + s * sizeof(Stored), sizeof(Stored));
    samples[s] = static_cast<float>(stored);
  }
}

class TiffPicture : public Picture {
 public:
  TiffPicture(FileBytes bytes, const std::filesystem::path& file) : bytes_(std::move(bytes)), file_(file) {}
  ~TiffPicture() override {
    if (tiff_ != nullptr) TIFFClose(tiff_);
  }
  TiffPicture(const TiffPicture&) = delete;
  TiffPicture& operator=(const TiffPicture&) = delete;

  Status open();
  Status read(const RowSink& sink, const Progress& progress) override;

 private:
  static TiffPicture& self(thandle_t handle) { return *static_cast<TiffPicture*>(handle); }
  static tmsize_t take_bytes(thandle_t handle, void* into, tmsize_t count);
  static toff_t seek(thandle_t handle, toff_t offset, int from);
  static int take_error(TIFF* /*tiff*/, void* picture, const char* /*module*/, const char* format,
                        va_list values);
  static int ignore_warning(TIFF* /*tiff*/, void* /*picture*/, const char* /*module*/, const char* /*format*/,
                            va_list /*values*/) {
    return 1;
  }

  template <class Number>
  [[nodiscard]] Number field(std::uint32_t tag, Number standard) const {
    Number number = standard;
    return TIFFGetFieldDefaulted(tiff_, tag, &number) == 1 ? number : standard;
  }
  [[nodiscard]] Status refusal(const std::string& what) const {
    return fail(ErrorKind::input, "{}: {}: {}", file_.string(), what,
                message_.empty() ? "it ends early or contradicts itself" : message_);
  }
  [[nodiscard]] Page current_page() const;
  [[nodiscard]] Status require_readable(const Page& page) const;
  Status list_pages();
  Status require_held_here() const;
  void fill_header();
  Status read_palette();
  Status read_page(std::int64_t number, const RowSink& sink, const Progress& progress);
  // The rows from `first` on, `count` of them, into `band`: of one strip, or of the tiles beside each other.
  Status read_band(std::uint32_t first, std::uint32_t count, std::vector<std::uint8_t>& band);
  void give(std::int64_t number, std::int64_t row, const std::uint8_t* bytes, const RowSink& sink);

  FileBytes bytes_;
  std::filesystem::path file_;
  TIFF* tiff_ = nullptr;
  std::int64_t at_ = 0;
  std::string message_;  // the first error
  Page page_;
  std::vector<tdir_t> directories_;  // of the pages
  std::array<const std::uint16_t*, 3> palette_{};
  std::vector<float> stored_;
  std::vector<float> samples_;
};

tmsize_t TiffPicture::take_bytes(thandle_t handle, void* into, tmsize_t count) {
  TiffPicture& picture = self(handle);
  const auto got = picture.bytes_.read(picture.at_, {static_cast<std::uint8_t*>(into),
                                                     static_cast<std::size_t>(std::max<tmsize_t>(0, count))});
  picture.at_ += static_cast<std::int64_t>(got);
  return static_cast<tmsize_t>(got);
}

toff_t TiffPicture::seek(thandle_t handle, toff_t offset, int from) {
  TiffPicture& picture = self(handle);
  const std::int64_t base = from == SEEK_SET ? 0 : from == SEEK_CUR ? picture.at_ : picture.bytes_.size();
  std::int64_t place = 0;
  if (__builtin_add_overflow(base, static_cast<std::int64_t>(offset), &place) || place < 0) {
    return static_cast<toff_t>(-1);
  }
  picture.at_ = place;
  return static_cast<toff_t>(place);
}

int TiffPicture::take_error(TIFF* /*tiff*/, void* picture, const char* /*module*/, const char* format,
                            va_list values) {
  std::string& message = static_cast<TiffPicture*>(picture)->message_;
  if (!message.empty()) return 1;
  std::array<char, 160> text{};
  std::vsnprintf(text.data(), text.size(), format, values);
  message = text.data();
  std::replace_if(
      message.begin(), message.end(), [](unsigned char c) { return c < ' '; }, ' ');
  return 1;
}

Status TiffPicture::open() {
  std::array<std::uint8_t, 4> start{};
  const bool is_tiff = bytes_.read(0, start) == start.size() && start[0] == start[1] &&
                       (start[0] == 'I' || start[0] == 'M') &&
                       (start[start[0] == 'I' ? 2 : 3] == 42 || start[start[0] == 'I' ? 2 : 3] == 43);
  if (!is_tiff) {
    return fail(ErrorKind::input, "{}: not a TIFF file: it does not begin with TIFF's byte order and number",
                file_.string());
  }
  TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
  if (options == nullptr) return fail(ErrorKind::capability, "libtiff: no memory");
  TIFFOpenOptionsSetMaxSingleMemAlloc(options, bytes_.size() + kMostMemory);
  TIFFOpenOptionsSetErrorHandlerExtR(options, take_error, this);
  TIFFOpenOptionsSetWarningHandlerExtR(options, ignore_warning, this);
  tiff_ = TIFFClientOpenExt(
      file_.c_str(), "rm", this, take_bytes, [](thandle_t, void*, tmsize_t) { return tmsize_t{0}; }, seek,
      [](thandle_t) { return 0; },
      [](thandle_t handle) { return static_cast<toff_t>(self(handle).bytes_.size()); },
      [](thandle_t, void**, toff_t*) { return 0; }, [](thandle_t, void*, toff_t) {}, options);
  TIFFOpenOptionsFree(options);
  if (tiff_ == nullptr) return refusal("the first directory cannot be read");
  TIDEMARK_TRY(list_pages());
  fill_header();
  return require_held_here();
}

Page TiffPicture::current_page() const {
  Page page;
  page.columns = field<std::uint32_t>(TIFFTAG_IMAGEWIDTH, 0);
  page.rows = field<std::uint32_t>(TIFFTAG_IMAGELENGTH, 0);
  page.bits = field<std::uint16_t>(TIFFTAG_BITSPERSAMPLE, 1);
  page.samples = field<std::uint16_t>(TIFFTAG_SAMPLESPERPIXEL, 1);
  page.format = field<std::uint16_t>(TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
  if (page.format == SAMPLEFORMAT_VOID) page.format = SAMPLEFORMAT_UINT;
  page.meaning = field<std::uint16_t>(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  page.planes = page.samples == 1 ? std::uint16_t{PLANARCONFIG_CONTIG}
                                  : field<std::uint16_t>(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  page.compression = field<std::uint16_t>(TIFFTAG_COMPRESSION, COMPRESSION_NONE);
  page.orientation = field<std::uint16_t>(TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  if (page.orientation < 1 || page.orientation > 8) page.orientation = ORIENTATION_TOPLEFT;
  return page;
}

Status TiffPicture::require_readable(const Page& page) const {
  const std::string name = file_.string();
  if (most_bytes_of_one(page.compression) == 0) {
    return fail(ErrorKind::input,
                "{}: Compression (259) is {}: only none, LZW, deflate and PackBits are read", name,
                page.compression);
  }
  const bool is_grey = page.meaning == PHOTOMETRIC_MINISBLACK || page.meaning == PHOTOMETRIC_MINISWHITE;
  const bool is_palette = page.meaning == PHOTOMETRIC_PALETTE && page.samples == 1 && page.bits == 8;
  const bool is_colour = page.meaning == PHOTOMETRIC_RGB && page.samples >= 3;
  if (!is_grey && !is_palette && !is_colour) {
    return fail(
        ErrorKind::input,
        "{}: PhotometricInterpretation (262) is {} with {} samples of {} bits: only grey, red-green-blue and "
        "palettes of 8 bits are read",
        name, page.meaning, page.samples, page.bits);
  }
  if (page.samples > 4) {
    return fail(ErrorKind::input, "{}: SamplesPerPixel (277) is {}, more than 4", name, page.samples);
  }
  if (page.planes != PLANARCONFIG_CONTIG) {
    return fail(ErrorKind::input,
                "{}: PlanarConfiguration (284) is {}: colours in planes of their own are not read", name,
                page.planes);
  }
  if (!scalar_of(page) || (page.bits == 1 && page.samples > 1)) {
    return fail(ErrorKind::input,
                "{}: BitsPerSample (258) is {} with SampleFormat (339) {}, which is not read", name,
                page.bits, page.format);
  }
  return {};
}

// Previews and masks of a page (NewSubfileType 1 and 4) are no slices.
Status TiffPicture::list_pages() {
  std::int64_t others = 0;
  do {
    constexpr std::uint32_t kNoPage = FILETYPE_REDUCEDIMAGE | FILETYPE_MASK;
    const auto number = TIFFCurrentDirectory(tiff_);
    if ((field<std::uint32_t>(TIFFTAG_SUBFILETYPE, 0) & kNoPage) != 0) {
      ++others;
      continue;
    }
    const Page page = current_page();
    if (directories_.empty()) {
      TIDEMARK_TRY(require_readable(page));
      page_ = page;
    } else if (page != page_) {
      return fail(ErrorKind::input,
                  "{}: page {} ({} x {} pixels, {} samples of {} bits) is unlike the first ({} x {}, {} of "
                  "{}): pages "
                  "of one kind alone are slices",
                  file_.string(), directories_.size() + others + 1, page.columns, page.rows, page.samples,
                  page.bits, page_.columns, page_.rows, page_.samples, page_.bits);
    }
    directories_.push_back(number);
    if (static_cast<std::int64_t>(directories_.size()) + others > kMostPages) {
      return fail(ErrorKind::input, "{}: has more than {} pages", file_.string(), kMostPages);
    }
  } while (TIFFReadDirectory(tiff_) == 1);
  if (!message_.empty())
    return refusal(fmt::format("page {} cannot be read", directories_.size() + others + 1));
  if (directories_.empty()) {
    return fail(ErrorKind::input, "{}: NewSubfileType (254): no page is a picture itself", file_.string());
  }
  if (others > 0)
    header_.changes.push_back(fmt::format("{} previews or masks in the file are left out", others));
  if (TIFFSetDirectory(tiff_, directories_.front()) != 1) return refusal("page 1 cannot be read");
  return {};
}

Status TiffPicture::require_held_here() const {
  const std::string field_name = "ImageWidth (256), ImageLength (257)";
  const std::int64_t most = most_bytes_of_one(page_.compression);
  const auto bits = checked_product(header_.columns, header_.rows, header_.pages, page_.samples, page_.bits);
  if (bits && *bits / 8 / most <= bytes_.size()) {
    return require_held(header_, most, bytes_.size(), field_name, file_);
  }
  return fail(ErrorKind::input, "{}: {}: {} x {} pixels on {} pages are more than its {} bytes can hold",
              file_.string(), field_name, header_.columns, header_.rows, header_.pages, bytes_.size());
}

void TiffPicture::fill_header() {
  header_.columns = page_.columns;
  header_.rows = page_.rows;
  header_.pages = static_cast<std::int64_t>(directories_.size());
  const bool is_palette = page_.meaning == PHOTOMETRIC_PALETTE;
  header_.channels = page_.samples >= 3 || is_palette ? 3 : 1;
  header_.scalar = is_palette ? Scalar::uint16 : *scalar_of(page_);  // of the palette's entries
  header_.has_opacity = page_.samples > header_.channels;
  header_.orientation = page_.orientation;
  if (page_.meaning == PHOTOMETRIC_MINISWHITE) {
    header_.warnings.emplace_back(
        "PhotometricInterpretation (262) is 0: small values are meant to be shown white; values are kept");
  }
  const auto unit = field<std::uint16_t>(TIFFTAG_RESOLUTIONUNIT, RESUNIT_INCH);
  float across = 0.0F;
  float down = 0.0F;
  const bool is_stated = TIFFGetField(tiff_, TIFFTAG_XRESOLUTION, &across) == 1 &&
                         TIFFGetField(tiff_, TIFFTAG_YRESOLUTION, &down) == 1;
  if (!is_stated || (unit != RESUNIT_INCH && unit != RESUNIT_CENTIMETER)) return;
  header_.pixels_per_mm = glm::dvec2(across, down) / (unit == RESUNIT_INCH ? 25.4 : 10.0);
}

Status TiffPicture::read_palette() {
  std::array<std::uint16_t*, 3> colours{};
  if (TIFFGetField(tiff_, TIFFTAG_COLORMAP, &colours[0], &colours[1], &colours[2]) != 1) {
    return fail(ErrorKind::input, "{}: ColorMap (320) is missing", file_.string());
  }
  std::copy(colours.begin(), colours.end(), palette_.begin());
  return {};
}

void TiffPicture::give(std::int64_t number, std::int64_t row, const std::uint8_t* bytes,
                       const RowSink& sink) {
  if (page_.bits == 1) {
    for (std::size_t x = 0; x < stored_.size(); ++x) {
      stored_[x] = static_cast<float>(bytes[x / 8] >> (7 - x % 8) & 1);
    }
  } else {
    switch (*scalar_of(page_)) {
      case Scalar::int8:
        convert<std::int8_t>(bytes, stored_);
        break;
      case Scalar::int16:
        convert<std::int16_t>(bytes, stored_);
        break;
      case Scalar::uint16:
        convert<std::uint16_t>(bytes, stored_);
        break;
      case Scalar::int32:
        convert<std::int32_t>(bytes, stored_);
        break;
      case Scalar::uint32:
        convert<std::uint32_t>(bytes, stored_);
        break;
      case Scalar::float32:
        convert<float>(bytes, stored_);
        break;
      default:
        convert<std::uint8_t>(bytes, stored_);
        break;
    }
  }
  const auto channels = static_cast<std::size_t>(header_.channels);
  for (std::size_t x = 0; x < static_cast<std::size_t>(header_.columns); ++x) {
    for (std::size_t c = 0; c < channels; ++c) {
      samples_[x * channels + c] =
          palette_[0] != nullptr ? static_cast<float>(palette_[c][static_cast<std::uint8_t>(stored_[x])])
                                 : stored_[x * page_.samples + c];
    }
  }
  sink(number, row, samples_);
}

Status TiffPicture::read_band(std::uint32_t first, std::uint32_t count, std::vector<std::uint8_t>& band) {
  if (TIFFIsTiled(tiff_) == 0) {
    const auto strip = TIFFComputeStrip(tiff_, first, 0);
    const tmsize_t wanted = TIFFScanlineSize(tiff_) * static_cast<tmsize_t>(count);
    band.resize(static_cast<std::size_t>(wanted));
    if (TIFFReadEncodedStrip(tiff_, strip, band.data(), wanted) == wanted) return {};
    return refusal(fmt::format("strip {} cannot be read", strip));
  }
  const auto width = field<std::uint32_t>(TIFFTAG_TILEWIDTH, 0);
  const auto row_bytes = static_cast<std::size_t>(TIFFScanlineSize(tiff_));
  const auto tile_row_bytes = static_cast<std::size_t>(TIFFTileRowSize(tiff_));
  const tmsize_t tile_bytes = TIFFTileSize(tiff_);
  band.assign(row_bytes * count, 0);
  std::vector<std::uint8_t> tile(static_cast<std::size_t>(tile_bytes));
  for (std::uint32_t x = 0; x < page_.columns; x += width) {
    const auto number = TIFFComputeTile(tiff_, x, first, 0, 0);
    if (TIFFReadEncodedTile(tiff_, number, tile.data(), tile_bytes) != tile_bytes) {
      return refusal(fmt::format("tile {} cannot be read", number));
    }
    const std::size_t offset = x / width * tile_row_bytes;
    const std::size_t used = std::min(tile_row_bytes, row_bytes - offset);
    for (std::uint32_t y = 0; y < count; ++y) {
      std::copy_n(tile.begin() + static_cast<std::ptrdiff_t>(y * tile_row_bytes), used,
                  band.begin() + static_cast<std::ptrdiff_t>(y * row_bytes + offset));
    }
  }
  return {};
}

Status TiffPicture::read_page(std::int64_t number, const RowSink& sink, const Progress& progress) {
  if (TIFFSetDirectory(tiff_, directories_[static_cast<std::size_t>(number)]) != 1 ||
      current_page() != page_) {
    return refusal(fmt::format("page {} cannot be read", number + 1));
  }
  if (page_.meaning == PHOTOMETRIC_PALETTE) TIDEMARK_TRY(read_palette());
  const bool is_tiled = TIFFIsTiled(tiff_) != 0;
  const auto height = is_tiled ? field<std::uint32_t>(TIFFTAG_TILELENGTH, 0)
                               : field<std::uint32_t>(TIFFTAG_ROWSPERSTRIP, page_.rows);
  // A tile beyond the picture would take memory that its bytes did not ask for.
  const std::int64_t tile = is_tiled ? static_cast<std::int64_t>(TIFFTileSize(tiff_)) : 0;
  const bool is_wide = is_tiled && field<std::uint32_t>(TIFFTAG_TILEWIDTH, 0) == 0;
  if (height == 0 || is_wide || tile > kMostMemory) {
    return fail(ErrorKind::input, "{}: {} x {} pixels make no {}", file_.string(),
                is_tiled ? field<std::uint32_t>(TIFFTAG_TILEWIDTH, 0) : page_.columns, height,
                is_tiled ? "tile (TileWidth, 322)" : "strip (RowsPerStrip, 278)");
  }
  std::vector<std::uint8_t> band;
  const auto row_bytes = static_cast<std::size_t>(TIFFScanlineSize(tiff_));
  for (std::int64_t first = 0; first < header_.rows; first += height) {
    if (progress.cancelled()) return cancelled_error();
    const auto count = static_cast<std::uint32_t>(std::min<std::int64_t>(height, header_.rows - first));
    TIDEMARK_TRY(read_band(static_cast<std::uint32_t>(first), count, band));
    for (std::uint32_t y = 0; y < count; ++y) give(number, first + y, band.data() + y * row_bytes, sink);
  }
  return {};
}

Status TiffPicture::read(const RowSink& sink, const Progress& progress) {
  stored_.resize(static_cast<std::size_t>(header_.columns) * page_.samples);
  samples_.resize(static_cast<std::size_t>(header_.columns * header_.channels));
  for (std::int64_t number = 0; number < header_.pages; ++number) {
    TIDEMARK_TRY(read_page(number, sink, progress));
    progress(static_cast<double>(number + 1) / static_cast<double>(header_.pages), "reading the picture");
  }
  return {};
}

}  // namespace

Result<std::unique_ptr<Picture>> open_tiff(FileBytes bytes, const std::filesystem::path& file) {
  auto picture = std::make_unique<TiffPicture>(std::move(bytes), file);
  TIDEMARK_TRY(picture->open());
  return picture;
}

}  // namespace tidemark::imaging::files
