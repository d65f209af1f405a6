// Moving pictures as GIF files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "core/result.h"

namespace tidemark::imaging {

// Each picture has a palette of its own of 256 colours, the nearest to its own. It plays for ever.
class GifFile {
 public:
  // Pictures are written as they come; the file appears whole with finish(), or not at all. A picture stays
  // for `seconds`, in hundredths. Fails (ErrorKind::write); sizes are from 1 to 65535 pixels.
  static Result<GifFile> create(std::int64_t width, std::int64_t height, double seconds,
                                const std::filesystem::path& file);
  ~GifFile();
  GifFile(GifFile&&) noexcept;
  GifFile& operator=(GifFile&&) noexcept;

  // `pixels`: red, green, blue and opacity (not kept), 8 bits each, rows from the top.
  Status add(std::span<const std::uint8_t> pixels);
  Status finish();

 private:
  struct Writer;
  explicit GifFile(std::unique_ptr<Writer> writer);
  std::unique_ptr<Writer> writer_;
};

}  // namespace tidemark::imaging
