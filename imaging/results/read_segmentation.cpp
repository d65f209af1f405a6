#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmfg/fgpixmsr.h>
#include <dcmtk/dcmfg/fgplanor.h>
#include <dcmtk/dcmfg/fgplanpo.h>
#include <dcmtk/dcmfg/fgseg.h>
#include <dcmtk/dcmiod/cielabutil.h>
#include <dcmtk/dcmseg/segdoc.h>
#include <dcmtk/dcmseg/segment.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "core/checked.h"
#include "imaging/dicom/decimal.h"
#include "imaging/dicom/same_slices.h"
#include "imaging/guard/guarded.h"
#include "imaging/results/dicom_object.h"
#include "imaging/results/results.h"
#include "imaging/results/segment_frames.h"

namespace tidemark {
namespace {

namespace fs = std::filesystem;

// Half of the largest fraction and more is inside.
std::uint8_t least_inside(DcmItem& dataset, bool is_binary) {
  if (is_binary) return 1;
  Uint16 most = 255;
  dataset.findAndGetUint16(DCM_MaximumFractionalValue, most);
  return static_cast<std::uint8_t>(std::clamp((most + 1) / 2, 1, 255));
}

Code code_of(CodeSequenceMacro& macro) {
  OFString value;
  OFString scheme;
  OFString meaning;
  macro.getCodeValue(value);
  macro.getCodingSchemeDesignator(scheme);
  macro.getCodeMeaning(meaning);
  return {value.c_str(), scheme.c_str(), meaning.c_str()};
}

std::optional<SegmentColour> colour_of(DcmSegment& segment) {
  Uint16 l = 0;
  Uint16 a = 0;
  Uint16 b = 0;
  if (segment.getRecommendedDisplayCIELabValue(l, a, b).bad()) return std::nullopt;
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  IODCIELabUtil::dicomLab2RGB(red, green, blue, l, a, b);
  const auto byte = [](double value) {
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
  };
  return SegmentColour{byte(red), byte(green), byte(blue)};
}

// The frame's functional group of that kind, its own or the one of all frames; null when there is none.
template <class Group>
Group* group_of(FGInterface& groups, std::size_t frame, DcmFGTypes::E_FGType kind) {
  OFBool is_its_own = OFFalse;
  return dynamic_cast<Group*>(groups.get(static_cast<Uint32>(frame), kind, is_its_own));
}

// One reading of one file.
class SegmentationReader {
 public:
  explicit SegmentationReader(const fs::path& file) : file_(file) {}
  Result<Segments> read(const Geometry* grid);

 private:
  Status load();
  Status find_pixels(DcmDataset& dataset);
  Status read_frames();
  Result<SegmentFrame> read_frame(std::size_t index);
  void read_segments(Segments& segments);
  Status fill(std::size_t index, Segments& segments);

  // Of the n-th pixel of all frames. DCMTK 3.6.7 mixes up bits where frames do not end at whole bytes.
  [[nodiscard]] bool is_inside(std::size_t n) const {
    return bits_ == 1 ? (pixels_[n / 8] >> n % 8 & 1) != 0 : pixels_[n] >= least_inside_;
  }

  [[nodiscard]] auto refuse(std::string_view why) const {
    return fail(ErrorKind::input, "{}: {}", file_.string(), why);
  }

  fs::path file_;
  std::optional<ParsedDicom> object_;
  std::unique_ptr<DcmSegmentation> document_;
  std::span<const Uint8> pixels_;  // of the object, all frames one after another
  Uint16 bits_ = 1;                // a pixel
  std::int64_t rows_ = 0;
  std::int64_t columns_ = 0;
  bool is_binary_ = true;
  std::uint8_t least_inside_ = 1;  // of the values of fractional pixels
  std::vector<SegmentFrame> frames_;
  std::optional<double> between_mm_;
  double thickness_mm_ = 0.0;
};

// Finds the pixels, decoded, and checks that they hold what the header promises.
Status SegmentationReader::find_pixels(DcmDataset& dataset) {
  const auto frames = parse_integers(element_text(dataset, DCM_NumberOfFrames));
  if (!frames || frames->size() != 1 || frames->front() < 1) {
    return refuse("NumberOfFrames (0028,0008) is missing");
  }
  dataset.findAndGetUint16(DCM_BitsAllocated, bits_);
  if (bits_ != 1 && bits_ != 8)
    return refuse(fmt::format("BitsAllocated (0028,0100) is {}, not 1 or 8", bits_));
  if (dataset.chooseRepresentation(EXS_LittleEndianExplicit, nullptr).bad()) {
    return refuse("its transfer syntax cannot be decoded");
  }
  const Uint8* bytes = nullptr;
  const Uint16* words = nullptr;
  unsigned long count = 0;
  if (dataset.findAndGetUint8Array(DCM_PixelData, bytes, &count).bad() &&
      dataset.findAndGetUint16Array(DCM_PixelData, words, &count).good()) {
    bytes = reinterpret_cast<const Uint8*>(words);  // little endian, in files and here
    count *= 2;
  }
  const auto needed = checked_product(frames->front(), rows_, columns_, bits_);
  if (bytes == nullptr || !needed ||
      *needed / 8 + (*needed % 8 != 0 ? 1 : 0) > static_cast<std::int64_t>(count)) {
    return refuse(fmt::format("PixelData (7FE0,0010) holds less than {} frames of {} x {} pixels of {} bits",
                              frames->front(), columns_, rows_, bits_));
  }
  pixels_ = {bytes, count};
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
  Uint16 rows = 0;
  Uint16 columns = 0;
  dataset.findAndGetUint16(DCM_Rows, rows);
  dataset.findAndGetUint16(DCM_Columns, columns);
  if (rows == 0 || columns == 0) return refuse("Rows (0028,0010) or Columns (0028,0011) are missing");
  rows_ = rows;
  columns_ = columns;
  least_inside_ = least_inside(dataset, is_binary_);
  TIDEMARK_TRY(find_pixels(dataset));
  DcmSegmentation* document = nullptr;
  const OFCondition loaded = DcmSegmentation::loadDataset(dataset, document);
  document_.reset(document);
  if (loaded.bad() || !document_) return refuse(fmt::format("is no valid segmentation: {}", loaded.text()));
  return {};
}

Result<SegmentFrame> SegmentationReader::read_frame(std::size_t index) {
  FGInterface& groups = document_->getFunctionalGroups();
  auto* position = group_of<FGPlanePosPatient>(groups, index, DcmFGTypes::EFG_PLANEPOSPATIENT);
  auto* orientation = group_of<FGPlaneOrientationPatient>(groups, index, DcmFGTypes::EFG_PLANEORIENTPATIENT);
  auto* measures = group_of<FGPixelMeasures>(groups, index, DcmFGTypes::EFG_PIXELMEASURES);
  auto* segment = group_of<FGSegmentation>(groups, index, DcmFGTypes::EFG_SEGMENTATION);
  const auto missing = [&](const char* what) { return refuse(fmt::format("frame {}: {}", index + 1, what)); };
  if (position == nullptr || orientation == nullptr || measures == nullptr || segment == nullptr) {
    return missing("its place, orientation, pixel measures or segment are missing");
  }
  SegmentFrame frame;
  frame.columns = columns_;
  frame.rows = rows_;
  glm::dvec3 row(0.0);
  glm::dvec3 column(0.0);
  glm::dvec3& corner = frame.position_mm;
  Float64 between_rows = 0.0;
  Float64 between_columns = 0.0;
  if (position->getImagePositionPatient(corner.x, corner.y, corner.z).bad() ||
      orientation->getImageOrientationPatient(row.x, row.y, row.z, column.x, column.y, column.z).bad() ||
      measures->getPixelSpacing(between_rows, 0).bad() ||
      measures->getPixelSpacing(between_columns, 1).bad() ||
      segment->getReferencedSegmentNumber(frame.segment).bad()) {
    return missing("its place, orientation, pixel spacing or segment cannot be read");
  }
  const auto finite = [](const glm::dvec3& v) { return std::isfinite(glm::dot(v, v)); };
  const bool is_spaced = between_rows > 0.0 && between_columns > 0.0;
  if (!finite(corner) || !is_orthonormal({row, column}) || !is_spaced ||
      !finite({between_rows, between_columns, 0.0})) {
    return missing("its place, orientation or pixel spacing makes no sense");
  }
  if (frame.segment < 1 || frame.segment > document_->getNumberOfSegments()) {
    return missing("it belongs to a segment that is not described");
  }
  frame.step_column_mm = between_columns * glm::normalize(row);
  frame.step_row_mm = between_rows * glm::normalize(column);
  Float64 number = 0.0;
  if (measures->getSpacingBetweenSlices(number).good() && std::isfinite(number)) between_mm_ = number;
  if (measures->getSliceThickness(number).good() && std::isfinite(number)) thickness_mm_ = number;
  return frame;
}

Status SegmentationReader::read_frames() {
  for (std::size_t index = 0; index < document_->getNumberOfFrames(); ++index) {
    auto frame = read_frame(index);
    if (!frame) return pass_on(frame);
    frames_.push_back(*frame);
  }
  const auto held = static_cast<std::int64_t>(frames_.size()) * rows_ * columns_ * bits_;
  if (frames_.empty() || held > 8 * static_cast<std::int64_t>(pixels_.size())) {
    return refuse(fmt::format("PixelData (7FE0,0010) holds less than the {} frames that are described",
                              frames_.size()));
  }
  return {};
}

void SegmentationReader::read_segments(Segments& segments) {
  for (std::size_t number = 1; number <= document_->getNumberOfSegments(); ++number) {
    DcmSegment& described = *document_->getSegment(number);
    OFString name;
    described.getSegmentLabel(name);
    Segment segment;
    segment.name = name.empty() ? fmt::format("Segment {}", number) : name.c_str();
    segment.colour = colour_of(described);
    segment.meaning = {code_of(described.getSegmentedPropertyCategoryCode()),
                       code_of(described.getSegmentedPropertyTypeCode())};
    segments.list.push_back(std::move(segment));
  }
}

Status SegmentationReader::fill(std::size_t index, Segments& segments) {
  const SegmentFrame& frame = frames_[index];
  const Geometry& grid = segments.geometry;
  const auto map = map_frame(frame, grid, file_.string());
  if (!map) return tl::unexpected<Error>(map.error());
  auto& slices = segments.list[frame.segment - 1U].slices;
  for (std::int64_t r = 0; r < rows_; ++r) {
    for (std::int64_t c = 0; c < columns_; ++c) {
      if (!is_inside(static_cast<std::size_t>((static_cast<std::int64_t>(index) * rows_ + r) * columns_ + c)))
        continue;
      const Index3 voxel = map->first + c * map->column + r * map->row;
      if (!grid.contains(voxel)) return refuse("it reaches beyond the volume");
      auto& slice = slices[voxel.z];
      if (slice.empty()) slice.resize(static_cast<std::size_t>(grid.size.x * grid.size.y));
      slice[static_cast<std::size_t>(voxel.x + grid.size.x * voxel.y)] = 1;
    }
  }
  return {};
}

Result<Segments> SegmentationReader::read(const Geometry* grid) {
  TIDEMARK_TRY(load());
  TIDEMARK_TRY(read_frames());
  Segments segments;
  if (grid != nullptr) {
    segments.geometry = *grid;
  } else {
    auto own = grid_of_frames(frames_, between_mm_, thickness_mm_, file_.string());
    if (!own) return pass_on(own);
    segments.geometry = *own;
  }
  read_segments(segments);
  for (std::size_t index = 0; index < frames_.size(); ++index) {
    TIDEMARK_TRY(fill(index, segments));
  }
  if (!is_binary_) {
    segments.changes.push_back("the segments are fractions; half and more of a voxel is taken as inside");
  }
  return segments;
}

}  // namespace

Result<Segments> read_segmentation(const fs::path& file, const Geometry* grid) {
  return guarded(file, [&] { return SegmentationReader(file).read(grid); });
}

}  // namespace tidemark
