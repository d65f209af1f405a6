#include "imaging/results/segmentation_file.h"

#include <dcmtk/dcmiod/cielabutil.h>

#include <algorithm>
#include <cmath>

#include "imaging/dicom/decimal.h"
#include "imaging/results/dicom_object.h"

namespace tidemark::imaging {
namespace {

constexpr std::size_t kMostSegments = 65'535;  // numbers of segments have 16 bits

// Half of the largest fraction and more is inside.
std::uint8_t least_inside(bool is_binary, double largest_value) {
  if (is_binary) return 1;
  return static_cast<std::uint8_t>(std::max((static_cast<int>(largest_value) + 1) / 2, 1));
}

// The first code of a sequence; empty when there is none.
Code code_of(DcmItem& segment, const DcmTagKey& sequence) {
  DcmItem* code = nullptr;
  if (segment.findAndGetSequenceItem(sequence, code).bad() || code == nullptr) return {};
  return {element_text(*code, DCM_CodeValue), element_text(*code, DCM_CodingSchemeDesignator),
          element_text(*code, DCM_CodeMeaning)};
}

std::optional<SegmentColour> segment_colour(DcmItem& segment) {
  Uint16 l = 0;
  Uint16 a = 0;
  Uint16 b = 0;
  const DcmTagKey& key = DCM_RecommendedDisplayCIELabValue;
  if (segment.findAndGetUint16(key, l, 0).bad() || segment.findAndGetUint16(key, a, 1).bad() ||
      segment.findAndGetUint16(key, b, 2).bad()) {
    return std::nullopt;
  }
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  IODCIELabUtil::dicomLab2RGB(red, green, blue, l, a, b);
  const auto byte = [](double value) {
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
  };
  return SegmentColour{byte(red), byte(green), byte(blue)};
}

}  // namespace

tl::unexpected<Error> SegmentationFile::refuse(std::string_view why) const {
  return fail(ErrorKind::input, "{}: {}", file_.string(), why);
}

Status SegmentationFile::find_pixels(DcmDataset& dataset) {
  // Required of a segmentation (PS3.3 A.51, C.7.6.6). An image without it has one frame: read_frames() holds
  // that against the frames that are described.
  const std::string count = element_text(dataset, DCM_NumberOfFrames);
  lacks_count_ = count.empty();
  const auto frames = parse_integers(lacks_count_ ? "1" : count);
  if (!frames || frames->size() != 1 || frames->front() < 1) {
    return refuse("NumberOfFrames (0028,0008) is no number of frames");
  }
  Uint16 bits = 1;
  dataset.findAndGetUint16(DCM_BitsAllocated, bits);
  if (bits != 1 && bits != 8) return refuse(fmt::format("BitsAllocated (0028,0100) is {}, not 1 or 8", bits));
  Uint16 rows = 0;
  Uint16 columns = 0;
  dataset.findAndGetUint16(DCM_Rows, rows);
  dataset.findAndGetUint16(DCM_Columns, columns);
  if (rows == 0 || columns == 0) return refuse("Rows (0028,0010) or Columns (0028,0011) are missing");
  if (!is_binary_) {
    Uint16 most = 255;
    dataset.findAndGetUint16(DCM_MaximumFractionalValue, most);
    largest_value_ = std::clamp<int>(most, 1, 255);
  }
  format_ = {frames->front(), rows, columns, bits, least_inside(is_binary_, largest_value_)};
  auto pixels = SegmentPixels::open(*object_, format_, file_);
  if (!pixels) return pass_on(pixels);
  pixels_.emplace(std::move(*pixels));
  return {};
}

Status SegmentationFile::load() {
  auto object = load_result(file_);
  if (!object) return pass_on(object);
  object_ = std::move(*object);
  DcmDataset& dataset = object_->dataset();
  if (element_text(dataset, DCM_SOPClassUID) != UID_SegmentationStorage)
    return refuse("is no DICOM segmentation");
  const std::string type = element_text(dataset, DCM_SegmentationType);
  is_binary_ = type == "BINARY";
  if (!is_binary_ && type != "FRACTIONAL") {
    return refuse(
        fmt::format("SegmentationType (0062,0001) is '{}', not BINARY or FRACTIONAL", type.substr(0, 80)));
  }
  frame_of_reference_uid_ = element_text(dataset, DCM_FrameOfReferenceUID);
  TIDEMARK_TRY(find_pixels(dataset));
  TIDEMARK_TRY(read_segments(dataset));
  return read_frames(dataset);
}

// Frames name their segment by a number that may be another than its place (PS3.3 C.8.20.2).
Status SegmentationFile::read_number(DcmItem& described, Segment& segment) {
  const std::size_t item = list_.size() + 1;
  if (described.findAndGetUint16(DCM_SegmentNumber, segment.number).bad() || segment.number == 0) {
    return refuse(fmt::format("SegmentNumber (0062,0004) of segment {} is missing or 0", item));
  }
  if (!places_.try_emplace(segment.number, list_.size()).second) {
    return refuse(fmt::format("SegmentNumber (0062,0004) of segment {} is {}, as of an earlier one", item,
                              segment.number));
  }
  return {};
}

Status SegmentationFile::read_segments(DcmDataset& dataset) {
  DcmSequenceOfItems* all = nullptr;
  if (dataset.findAndGetSequence(DCM_SegmentSequence, all).good() && all->card() > kMostSegments) {
    return refuse(fmt::format("SegmentSequence (0062,0002) holds more than {} segments", kMostSegments));
  }
  return for_each_item(dataset, DCM_SegmentSequence, [&](DcmItem& described) -> Status {
    Segment segment;
    TIDEMARK_TRY(read_number(described, segment));
    segment.name = element_text(described, DCM_SegmentLabel);
    if (segment.name.empty()) segment.name = fmt::format("Segment {}", segment.number);
    segment.colour = segment_colour(described);
    segment.meaning = {code_of(described, DCM_SegmentedPropertyCategoryCodeSequence),
                       code_of(described, DCM_SegmentedPropertyTypeCodeSequence)};
    list_.push_back(std::move(segment));
    return {};
  });
}

Status SegmentationFile::read_frames(DcmDataset& dataset) {
  auto described = read_frame_groups(dataset, format_.columns, format_.rows, file_.string());
  if (!described) return pass_on(described);
  frames_ = std::move(*described);
  const std::size_t count = frames_.frames.size();
  for (std::size_t n = 0; n < count; ++n) {
    const auto segment = frames_.groups[n].segment;
    if (!segment) return refuse(fmt::format("frame {}: its segment is missing or cannot be read", n + 1));
    if (!places_.contains(*segment)) {
      return refuse(fmt::format("frame {}: it belongs to a segment that is not described", n + 1));
    }
  }
  if (lacks_count_ && count > 1) {
    return refuse(fmt::format("NumberOfFrames (0028,0008) is missing, and {} frames are described", count));
  }
  if (static_cast<std::int64_t>(count) > format_.frames) {
    return refuse(
        fmt::format("PixelData (7FE0,0010) holds less than the {} frames that are described", count));
  }
  return {};
}

Result<Geometry> SegmentationFile::own_grid() const {
  return grid_of_frames(frames_.frames, frames_.between_mm, frames_.thickness_mm, file_.string());
}

}  // namespace tidemark::imaging
