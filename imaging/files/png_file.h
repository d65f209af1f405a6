// Pictures as PNG files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "core/result.h"

namespace tidemark::imaging {

// Small files take three times as long as those that are quickly made.
enum class PngEffort { small_file, quick };

// `pixels`: red, green, blue and opacity, 8 bits each, rows from the top. The file appears whole or not at
// all. Fails with ErrorKind::write.
Status write_png_file(std::int64_t width, std::int64_t height, std::span<const std::uint8_t> pixels,
                      const std::filesystem::path& file, PngEffort effort = PngEffort::small_file);

}  // namespace tidemark::imaging
