// The plan of a series' slices in frames of files, and those files while they are needed.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "imaging/dicom/pixels.h"
#include "imaging/series.h"

namespace tidemark::imaging {

// A frame that is decoded once, and the slices that are in it: one, or the tiles of a mosaic.
struct FrameWork {
  std::size_t file = 0;  // of the series' files
  std::int64_t frame = 0;
  std::vector<std::int64_t> slices;
};

class FramePlan {
 public:
  // The series must outlive it.
  explicit FramePlan(const Series& series);

  // In the order of the slices.
  [[nodiscard]] const std::vector<FrameWork>& work() const { return work_; }

  // A file is opened once, and closed when all its work is done. Repeated work opens it again. For any
  // thread.
  Result<std::shared_ptr<const FrameReader>> open(const FrameWork& work);
  void is_done(const FrameWork& work);

 private:
  struct File {
    std::mutex mutex;
    std::shared_ptr<const FrameReader> reader;
    std::int64_t frames_left = 0;
  };
  const Series& series_;
  std::vector<FrameWork> work_;
  std::vector<File> files_;
};

}  // namespace tidemark::imaging
