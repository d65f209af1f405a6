// The orientation that a camera writes beside a JPEG picture. Private to this folder.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace tidemark::imaging::files {

// Of the contents of an APP1 marker: Orientation (274) of the first directory, 1 to 8 (Exif 2.3, 4.6.4).
// Nothing where it holds no such thing.
std::optional<int> exif_orientation(std::span<const std::uint8_t> marker);

}  // namespace tidemark::imaging::files
