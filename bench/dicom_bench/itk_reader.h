// The peer of dicom_bench: ITK's series reader with GDCM.
#pragma once

#include <cstdint>
#include <filesystem>

namespace tidemark::bench {

// Reads the only series in the folder and returns the sum of its voxels.
std::int64_t read_with_itk(const std::filesystem::path& folder);

}  // namespace tidemark::bench
