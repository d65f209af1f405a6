// A DICOM Segmentation (PS3.3 A.51) that was read but for its pixels. Private to this folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "imaging/results/frame_groups.h"
#include "imaging/results/segment_pixels.h"
#include "imaging/results/segments.h"

namespace tidemark::imaging {

class SegmentationFile {
 public:
  explicit SegmentationFile(std::filesystem::path file) : file_(std::move(file)) {}
  // Fails (ErrorKind::input) naming the file and the field. What is read refers to this, which stays in
  // place.
  Status load();

  [[nodiscard]] bool is_binary() const { return is_binary_; }
  [[nodiscard]] double largest_value() const { return largest_value_; }  // of a pixel: wholly inside
  [[nodiscard]] bool lacks_count() const { return lacks_count_; }        // of frames; then there is one
  [[nodiscard]] const std::vector<Segment>& segments() const { return list_; }  // without voxels
  [[nodiscard]] const DescribedFrames& frames() const { return frames_; }
  // The place in segments() of that which one of these frames belongs to.
  [[nodiscard]] std::size_t segment_of(const SegmentFrame& frame) const { return places_.at(frame.segment); }
  [[nodiscard]] const std::string& frame_of_reference_uid() const { return frame_of_reference_uid_; }
  [[nodiscard]] const SegmentPixelFormat& format() const { return format_; }
  [[nodiscard]] SegmentPixels& pixels() { return *pixels_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  // The smallest grid that holds all frames.
  [[nodiscard]] Result<Geometry> own_grid() const;

 private:
  Status find_pixels(DcmDataset& dataset);
  Status read_segments(DcmDataset& dataset);
  Status read_number(DcmItem& described, Segment& segment);
  Status read_frames(DcmDataset& dataset);
  [[nodiscard]] tl::unexpected<Error> refuse(std::string_view why) const;

  std::filesystem::path file_;
  std::optional<ParsedDicom> object_;
  SegmentPixelFormat format_;
  std::optional<SegmentPixels> pixels_;
  bool is_binary_ = true;
  double largest_value_ = 1.0;
  bool lacks_count_ = false;
  std::vector<Segment> list_;
  std::map<std::uint16_t, std::size_t> places_;  // in the list, by number
  std::string frame_of_reference_uid_;           // empty: it names none
  DescribedFrames frames_;
};

}  // namespace tidemark::imaging
