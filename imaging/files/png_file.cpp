#include "imaging/files/png_file.h"

#include <png.h>

#include <string>

#include "core/atomic_file.h"

namespace tidemark::imaging {

Status write_png_file(std::int64_t width, std::int64_t height, std::span<const std::uint8_t> pixels,
                      const std::filesystem::path& file, PngEffort effort) {
  if (width < 1 || height < 1 || static_cast<std::int64_t>(pixels.size()) != 4 * width * height) {
    return fail(ErrorKind::internal, "{}: {} bytes are not {} x {} pixels", file.string(), pixels.size(),
                width, height);
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGBA;
  if (effort == PngEffort::quick) image.flags |= PNG_IMAGE_FLAG_FAST;
  // The most that it can take: pictures are encoded once, and not first for their size.
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr) == 0) {
    return fail(ErrorKind::write, "{}: {}", file.string(), image.message);
  }
  bytes.resize(size);
  return write_file(file, bytes);
}

}  // namespace tidemark::imaging
