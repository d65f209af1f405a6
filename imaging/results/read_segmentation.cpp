#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmiod/cielabutil.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "imaging/dicom/decimal.h"
#include "imaging/dicom/same_slices.h"
#include "imaging/guard/guarded.h"
#include "imaging/results/dicom_object.h"
#include "imaging/results/results.h"
#include "imaging/results/segment_frames.h"
#include "imaging/results/segment_pixels.h"
#include "imaging/results/slice_budget.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostSegments = 65'535;  // numbers of segments have 16 bits

// Half of the largest fraction and more is inside.
std::uint8_t least_inside(DcmItem& dataset, bool is_binary) {
  if (is_binary) return 1;
  Uint16 most = 255;
  dataset.findAndGetUint16(DCM_MaximumFractionalValue, most);
  return static_cast<std::uint8_t>(std::clamp((most + 1) / 2, 1, 255));
}

// The first code of a sequence; empty when there is none.
Code code_of(DcmItem& segment, const DcmTagKey& sequence) {
  DcmItem* code = nullptr;
  if (segment.findAndGetSequenceItem(sequence, code).bad() || code == nullptr) return {};
  return {element_text(*code, DCM_CodeValue), element_text(*code, DCM_CodingSchemeDesignator),
          element_text(*code, DCM_CodeMeaning)};
}

std::optional<SegmentColour> colour_of(DcmItem& segment) {
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

std::optional<std::vector<double>> decimals(DcmItem& item, const DcmTagKey& key, std::size_t count) {
  auto values = parse_decimals(element_text(item, key));
  return values && values->size() == count ? values : std::nullopt;
}

// What the functional groups say of a frame, as far as they do.
struct FrameGroups {
  std::optional<std::vector<double>> position_mm;
  std::optional<std::vector<double>> orientation;  // along a row, along a column
  std::optional<std::vector<double>> spacing_mm;   // between rows, between columns
  std::optional<Uint16> segment;
  std::optional<double> between_mm;
  std::optional<double> thickness_mm;
};

// Those of one item, in the place of what is there: of all frames first, then of one.
void read_groups(DcmItem& item, FrameGroups& groups) {
  const auto with = [&](const DcmTagKey& sequence, const auto& read) {
    DcmItem* group = nullptr;
    if (item.findAndGetSequenceItem(sequence, group).good() && group != nullptr) read(*group);
  };
  with(DCM_PlanePositionSequence,
       [&](DcmItem& group) { groups.position_mm = decimals(group, DCM_ImagePositionPatient, 3); });
  with(DCM_PlaneOrientationSequence,
       [&](DcmItem& group) { groups.orientation = decimals(group, DCM_ImageOrientationPatient, 6); });
  with(DCM_PixelMeasuresSequence, [&](DcmItem& group) {
    groups.spacing_mm = decimals(group, DCM_PixelSpacing, 2);
    const auto between = decimals(group, DCM_SpacingBetweenSlices, 1);
    const auto thickness = decimals(group, DCM_SliceThickness, 1);
    groups.between_mm = between ? std::optional(between->front()) : std::nullopt;
    groups.thickness_mm = thickness ? std::optional(thickness->front()) : std::nullopt;
  });
  with(DCM_SegmentIdentificationSequence, [&](DcmItem& group) {
    Uint16 number = 0;
    groups.segment = group.findAndGetUint16(DCM_ReferencedSegmentNumber, number).good()
                         ? std::optional(number)
                         : std::nullopt;
  });
}

// One reading of one file.
class SegmentationReader {
 public:
  explicit SegmentationReader(const fs::path& file) : file_(file), budget_(file_) {}
  Result<Segments> read(const Geometry* grid);

 private:
  Status load();
  Status find_pixels(DcmDataset& dataset);
  Status read_segments(DcmDataset& dataset);
  Status read_frames(DcmDataset& dataset);
  Result<SegmentFrame> read_frame(const FrameGroups& groups);
  Status fill(std::size_t index, Segments& segments);

  [[nodiscard]] auto refuse(std::string_view why) const {
    return fail(ErrorKind::input, "{}: {}", file_.string(), why);
  }

  fs::path file_;
  std::optional<ParsedDicom> object_;
  SliceBudget budget_;
  SegmentPixelFormat format_;
  std::optional<SegmentPixels> pixels_;
  bool is_binary_ = true;
  bool lacks_count_ = false;  // of frames
  std::vector<Segment> list_;
  std::vector<SegmentFrame> frames_;
  std::optional<double> between_mm_;
  double thickness_mm_ = 0.0;
};

Status SegmentationReader::find_pixels(DcmDataset& dataset) {
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
  format_ = {frames->front(), rows, columns, bits, least_inside(dataset, is_binary_)};
  auto pixels = SegmentPixels::open(*object_, format_, file_);
  if (!pixels) return pass_on(pixels);
  pixels_.emplace(std::move(*pixels));
  return {};
}

Status SegmentationReader::load() {
  auto object = load_object(file_);
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
  TIDEMARK_TRY(find_pixels(dataset));
  TIDEMARK_TRY(read_segments(dataset));
  return read_frames(dataset);
}

Status SegmentationReader::read_segments(DcmDataset& dataset) {
  return for_each_item(dataset, DCM_SegmentSequence, [&](DcmItem& described) -> Status {
    if (list_.size() == kMostSegments) {
      return refuse(fmt::format("SegmentSequence (0062,0002) holds more than {} segments", kMostSegments));
    }
    Segment segment;
    segment.name = element_text(described, DCM_SegmentLabel);
    if (segment.name.empty()) segment.name = fmt::format("Segment {}", list_.size() + 1);
    segment.colour = colour_of(described);
    segment.meaning = {code_of(described, DCM_SegmentedPropertyCategoryCodeSequence),
                       code_of(described, DCM_SegmentedPropertyTypeCodeSequence)};
    list_.push_back(std::move(segment));
    return {};
  });
}

Result<SegmentFrame> SegmentationReader::read_frame(const FrameGroups& groups) {
  const auto wrong = [&](const char* what) {
    return refuse(fmt::format("frame {}: {}", frames_.size() + 1, what));
  };
  if (!groups.position_mm || !groups.orientation || !groups.spacing_mm || !groups.segment) {
    return wrong("its place, orientation, pixel spacing or segment are missing or cannot be read");
  }
  const auto& o = *groups.orientation;
  const glm::dvec3 row(o[0], o[1], o[2]);
  const glm::dvec3 column(o[3], o[4], o[5]);
  const auto& p = *groups.position_mm;
  const double between_rows = groups.spacing_mm->front();
  const double between_columns = groups.spacing_mm->back();
  SegmentFrame frame{*groups.segment, format_.columns, format_.rows, {p[0], p[1], p[2]}, {}, {}};
  const auto finite = [](const glm::dvec3& v) { return std::isfinite(glm::dot(v, v)); };
  const bool is_spaced = between_rows > 0.0 && between_columns > 0.0;
  if (!finite(frame.position_mm) || !is_orthonormal({row, column}) || !is_spaced ||
      !finite({between_rows, between_columns, 0.0})) {
    return wrong("its place, orientation or pixel spacing makes no sense");
  }
  if (frame.segment < 1 || frame.segment > list_.size()) {
    return wrong("it belongs to a segment that is not described");
  }
  frame.step_column_mm = between_columns * glm::normalize(row);
  frame.step_row_mm = between_rows * glm::normalize(column);
  if (groups.between_mm) between_mm_ = groups.between_mm;
  if (groups.thickness_mm) thickness_mm_ = *groups.thickness_mm;
  return frame;
}

// Text of all frames, which may be long, is read once.
Status SegmentationReader::read_frames(DcmDataset& dataset) {
  FrameGroups shared;
  DcmItem* of_all = nullptr;
  if (dataset.findAndGetSequenceItem(DCM_SharedFunctionalGroupsSequence, of_all).good() &&
      of_all != nullptr) {
    read_groups(*of_all, shared);
  }
  TIDEMARK_TRY(for_each_item(dataset, DCM_PerFrameFunctionalGroupsSequence, [&](DcmItem& of_one) -> Status {
    FrameGroups groups = shared;
    read_groups(of_one, groups);
    auto frame = read_frame(groups);
    if (!frame) return pass_on(frame);
    frames_.push_back(*frame);
    return {};
  }));
  if (frames_.empty()) return refuse("PerFrameFunctionalGroupsSequence (5200,9230) is missing");
  if (lacks_count_ && frames_.size() > 1) {
    return refuse(
        fmt::format("NumberOfFrames (0028,0008) is missing, and {} frames are described", frames_.size()));
  }
  if (static_cast<std::int64_t>(frames_.size()) > format_.frames) {
    return refuse(fmt::format("PixelData (7FE0,0010) holds less than the {} frames that are described",
                              frames_.size()));
  }
  return {};
}

Status SegmentationReader::fill(std::size_t index, Segments& segments) {
  const SegmentFrame& frame = frames_[index];
  const Geometry& grid = segments.geometry;
  const auto map = map_frame(frame, grid, file_.string());
  if (!map) return tl::unexpected<Error>(map.error());
  TIDEMARK_TRY(pixels_->go_to(static_cast<std::int64_t>(index)));
  auto& slices = segments.list[frame.segment - 1U].slices;
  for (std::int64_t r = 0; r < format_.rows; ++r) {
    for (std::int64_t c = 0; c < format_.columns; ++c) {
      if (!pixels_->is_inside(r, c)) continue;
      const Index3 voxel = map->first + c * map->column + r * map->row;
      if (!grid.contains(voxel)) return refuse("it reaches beyond the volume");
      auto& slice = slices[voxel.z];
      if (slice.empty()) {
        TIDEMARK_TRY(budget_.take(grid.size.x * grid.size.y));
        slice.resize(static_cast<std::size_t>(grid.size.x * grid.size.y));
      }
      slice[static_cast<std::size_t>(voxel.x + grid.size.x * voxel.y)] = 1;
    }
  }
  return {};
}

Result<Segments> SegmentationReader::read(const Geometry* grid) {
  TIDEMARK_TRY(load());
  Segments segments;
  if (grid != nullptr) {
    segments.geometry = *grid;
  } else {
    auto own = grid_of_frames(frames_, between_mm_, thickness_mm_, file_.string());
    if (!own) return pass_on(own);
    segments.geometry = *own;
  }
  segments.list = std::move(list_);
  for (std::size_t index = 0; index < frames_.size(); ++index) {
    TIDEMARK_TRY(fill(index, segments));
  }
  if (!is_binary_) {
    segments.changes.emplace_back("the segments are fractions; voxels of half and more are inside");
  }
  if (lacks_count_) {
    segments.changes.emplace_back(
        "NumberOfFrames (0028,0008) is missing; the one frame that is described is read");
  }
  return segments;
}

}  // namespace

Result<Segments> read_segmentation(const fs::path& file, const Geometry* grid) {
  return guarded(file, [&] { return SegmentationReader(file).read(grid); });
}

}  // namespace tidemark::imaging
