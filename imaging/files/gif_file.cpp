#include "imaging/files/gif_file.h"

#include <gif_lib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <system_error>
#include <utility>
#include <vector>

#include "core/atomic_file.h"

namespace tidemark::imaging {
namespace {

constexpr int kColours = 256;
constexpr std::int64_t kLargest = 65535;  // pixels along an edge
constexpr double kMostSeconds = 655.35;

}  // namespace

struct GifFile::Writer {
  explicit Writer(AtomicFile made) : file(std::move(made)) {}
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() {
    int ignored = 0;
    if (gif != nullptr) EGifCloseFile(gif, &ignored);
    if (stream != nullptr) std::fclose(stream);
  }

  [[nodiscard]] tl::unexpected<Error> failed(int code) const {
    if (error != 0) {
      return fail(ErrorKind::write, "{}: cannot write: {}", target.string(),
                  std::generic_category().message(error));
    }
    const char* why = GifErrorString(code);
    return fail(ErrorKind::write, "{}: {}", target.string(),
                why != nullptr ? why : "no GIF can be made of it");
  }
  static int append(GifFileType* gif, const GifByteType* bytes, int count) {
    auto& writer = *static_cast<Writer*>(gif->UserData);
    const auto size = static_cast<std::size_t>(count);
    if (writer.error == 0 && std::fwrite(bytes, 1, size, writer.stream) != size) writer.error = errno;
    return writer.error == 0 ? count : 0;
  }

  AtomicFile file;
  std::filesystem::path target;
  std::FILE* stream = nullptr;
  int error = 0;  // errno of the first write that failed
  std::int64_t width = 0;
  std::int64_t height = 0;
  int hundredths = 0;
  GifFileType* gif = nullptr;
  std::vector<GifByteType> red, green, blue, indices;
};

GifFile::GifFile(std::unique_ptr<Writer> writer) : writer_(std::move(writer)) {}
GifFile::~GifFile() = default;
GifFile::GifFile(GifFile&&) noexcept = default;
GifFile& GifFile::operator=(GifFile&&) noexcept = default;

Result<GifFile> GifFile::create(std::int64_t width, std::int64_t height, double seconds,
                                const std::filesystem::path& file) {
  if (width < 1 || height < 1 || width > kLargest || height > kLargest) {
    return fail(ErrorKind::write, "{}: a GIF has 1 to {} pixels along an edge, not {} x {}", file.string(),
                kLargest, width, height);
  }
  auto made = AtomicFile::create(file);
  if (!made) return pass_on(made);
  auto writer = std::make_unique<Writer>(std::move(*made));
  writer->target = file;
  writer->stream = std::fopen(writer->file.temporary_path().c_str(), "wbe");
  if (writer->stream == nullptr) writer->error = errno;
  if (writer->error != 0) return writer->failed(0);
  writer->width = width;
  writer->height = height;
  writer->hundredths = static_cast<int>(std::lround(100.0 * std::clamp(seconds, 0.01, kMostSeconds)));
  int code = 0;
  writer->gif = EGifOpen(writer.get(), &Writer::append, &code);
  if (writer->gif == nullptr) return writer->failed(code);
  EGifSetGifVersion(writer->gif, true);
  // An application extension of its own makes readers begin again at the end.
  constexpr std::array<GifByteType, 3> kForEver{1, 0, 0};
  GifFileType* gif = writer->gif;
  if (EGifPutScreenDesc(gif, static_cast<int>(width), static_cast<int>(height), 8, 0, nullptr) == GIF_ERROR ||
      EGifPutExtensionLeader(gif, APPLICATION_EXT_FUNC_CODE) == GIF_ERROR ||
      EGifPutExtensionBlock(gif, 11, "NETSCAPE2.0") == GIF_ERROR ||
      EGifPutExtensionBlock(gif, kForEver.size(), kForEver.data()) == GIF_ERROR ||
      EGifPutExtensionTrailer(gif) == GIF_ERROR) {
    return writer->failed(gif->Error);
  }
  return GifFile(std::move(writer));
}

Status GifFile::add(std::span<const std::uint8_t> pixels) {
  Writer& w = *writer_;
  const auto count = static_cast<std::size_t>(w.width * w.height);
  if (pixels.size() != 4 * count) {
    return fail(ErrorKind::internal, "{}: {} bytes are not {} x {} pixels", w.target.string(), pixels.size(),
                w.width, w.height);
  }
  for (auto* channel : {&w.red, &w.green, &w.blue, &w.indices}) channel->resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    w.red[i] = pixels[4 * i];
    w.green[i] = pixels[4 * i + 1];
    w.blue[i] = pixels[4 * i + 2];
  }
  const std::unique_ptr<ColorMapObject, decltype(&GifFreeMapObject)> palette(
      GifMakeMapObject(kColours, nullptr), &GifFreeMapObject);
  int colours = kColours;
  if (palette == nullptr || GifQuantizeBuffer(static_cast<unsigned>(w.width), static_cast<unsigned>(w.height),
                                              &colours, w.red.data(), w.green.data(), w.blue.data(),
                                              w.indices.data(), palette->Colors) == GIF_ERROR) {
    return w.failed(E_GIF_ERR_NOT_ENOUGH_MEM);
  }
  GraphicsControlBlock control{};
  control.DisposalMode = DISPOSE_DO_NOT;
  control.DelayTime = w.hundredths;
  control.TransparentColor = NO_TRANSPARENT_COLOR;
  std::array<GifByteType, 4> extension{};
  EGifGCBToExtension(&control, extension.data());
  if (EGifPutExtension(w.gif, GRAPHICS_EXT_FUNC_CODE, extension.size(), extension.data()) == GIF_ERROR ||
      EGifPutImageDesc(w.gif, 0, 0, static_cast<int>(w.width), static_cast<int>(w.height), false,
                       palette.get()) == GIF_ERROR) {
    return w.failed(w.gif->Error);
  }
  for (std::int64_t y = 0; y < w.height; ++y) {
    if (EGifPutLine(w.gif, w.indices.data() + y * w.width, static_cast<int>(w.width)) == GIF_ERROR) {
      return w.failed(w.gif->Error);
    }
  }
  return {};
}

Status GifFile::finish() {
  Writer& w = *writer_;
  int code = 0;
  const bool closed = EGifCloseFile(std::exchange(w.gif, nullptr), &code) == GIF_OK;
  if (std::fclose(std::exchange(w.stream, nullptr)) != 0 && w.error == 0) w.error = errno;
  if (!closed || w.error != 0) return w.failed(code);
  return w.file.commit();
}

}  // namespace tidemark::imaging
