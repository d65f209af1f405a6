// The folders that dicom_bench reads.
#pragma once

#include <cstdint>
#include <filesystem>

namespace tidemark::bench {

// Ten series of `files` / 10 images of 32 x 32, each in a folder of its own.
void write_small_files(const std::filesystem::path& folder, int files);

// A CT of 512 x 512 x `slices`: tissue and air with noise, as much of it as scanners leave.
void write_ct(const std::filesystem::path& folder, int slices);

// The same files in JPEG lossless (process 14, first-order prediction).
void write_compressed(const std::filesystem::path& source, const std::filesystem::path& folder);

}  // namespace tidemark::bench
