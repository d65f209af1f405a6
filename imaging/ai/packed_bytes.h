// Bytes packed by gzip (RFC 1952), as servers exchange them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "core/volume.h"

namespace tidemark::imaging {

// The volume's values as float32 in the processor's order of bytes (little endian), in voxel order, packed by
// gzip into a file. Fails (ErrorKind::write) naming it, and with the request to stop.
Status pack_values(const Volume& volume, const std::filesystem::path& file, const Progress& progress);

// What a gzip stream holds where that is exactly so many bytes. Nothing where it is no such stream, or holds
// more or less: no byte beyond them is unpacked.
std::optional<std::vector<std::uint8_t>> unpacked(std::string_view gzip, std::int64_t bytes);

}  // namespace tidemark::imaging
