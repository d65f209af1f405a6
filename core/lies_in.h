// The order of places on the disk, links followed.
#pragma once

#include <filesystem>

namespace tidemark {

// Whether the path is the folder or lies below it. Nothing need be there.
[[nodiscard]] bool lies_in(const std::filesystem::path& path, const std::filesystem::path& folder);

}  // namespace tidemark
