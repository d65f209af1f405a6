// The memory that the slices of all segments of one file may take: each is as large as the grid's, however
// few voxels of it a file names. Private to this folder.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/result.h"

namespace tidemark::imaging {

class SliceBudget {
 public:
  // A hundred organs in a hundred slices of 512 x 512 voxels each take 2.5 GiB.
  static constexpr std::int64_t kMostBytes = std::int64_t{4} << 30;

  explicit SliceBudget(const std::filesystem::path& file) : file_(file) {}

  // Before a slice of so many bytes is made. Fails (ErrorKind::input) naming the file.
  Status take(std::int64_t bytes) {
    taken_ += bytes;
    if (taken_ <= kMostBytes) return {};
    return fail(ErrorKind::input, "{}: the slices of its segments take more than {} GiB", file_.string(),
                kMostBytes >> 30);
  }

 private:
  const std::filesystem::path& file_;
  std::int64_t taken_ = 0;
};

}  // namespace tidemark::imaging
