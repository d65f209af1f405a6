// Checksums that tell one volume, or one file, from another.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <stop_token>
#include <string>

#include "core/volume.h"

namespace tidemark::document {

// SHA-256 in hexadecimal; empty only if there is no memory for it.
[[nodiscard]] std::string sha256(std::span<const std::byte> bytes);
// Fails with ErrorKind::input.
Result<std::string> sha256_of_file(const std::filesystem::path& file);

// Of a volume's voxels, their scale and their geometry. Empty when it was stopped before its end.
[[nodiscard]] std::string checksum_of(const Volume& volume, const std::stop_token& stop = {});

}  // namespace tidemark::document
