#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <map>
#include <set>

#include "imaging/dicom/character_sets.h"
#include "imaging/dicom/decimal.h"
#include "imaging/guard/guarded.h"
#include "imaging/results/dicom_object.h"
#include "imaging/results/polygon_fill.h"
#include "imaging/results/results.h"
#include "imaging/results/slice_budget.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

constexpr double kPlaneTolerance =
    0.2;  // of the distance of slices: planning systems round to a tenth of a millimetre
constexpr double kFarthest = 1e9;  // voxels

// Planning systems write some thousand.
constexpr std::ptrdiff_t kMostContourPoints = 1'000'000;  // of a contour
constexpr std::size_t kMostRegions = 4096;

// The text of ContourData, which may be longer than any other.
Result<std::vector<double>> numbers_of(DcmItem& contour, const fs::path& file) {
  DcmElement* element = nullptr;
  char* text = nullptr;
  Uint32 length = 0;
  if (contour.findAndGetElement(DCM_ContourData, element).bad() || element->getLength() == 0) {
    return std::vector<double>();
  }
  const bool is_text = element->getString(text, length).good() && text != nullptr;
  const std::string_view whole(is_text ? text : "", is_text ? length : 0);
  if (std::count(whole.begin(), whole.end(), '\\') >= 3 * kMostContourPoints) {
    return fail(ErrorKind::input, "{}: ContourData (3006,0050) has more than {} points", file.string(),
                kMostContourPoints);
  }
  auto numbers = parse_decimals(whole);
  element->compact();  // its text is in the file
  if (!numbers || numbers->size() % 3 != 0) {
    return fail(ErrorKind::input, "{}: ContourData (3006,0050) is not a list of points", file.string());
  }
  return std::move(*numbers);
}

// The points of a contour in the grid's voxels.
Result<std::vector<glm::dvec3>> points_of(DcmItem& contour, const Geometry& grid, const fs::path& file) {
  const auto read = numbers_of(contour, file);
  if (!read) return pass_on(read);
  const std::vector<double>& numbers = *read;
  const glm::dmat3 rotation = glm::inverse(grid.direction);
  std::vector<glm::dvec3> points;
  points.reserve(numbers.size() / 3);
  for (std::size_t n = 0; n + 2 < numbers.size(); n += 3) {
    const glm::dvec3 mm(numbers[n], numbers[n + 1], numbers[n + 2]);
    const glm::dvec3 point = rotation * (mm - grid.origin_mm) / grid.spacing_mm;
    // Numbers so far off may lead to infinite ones.
    if (!glm::all(glm::lessThanEqual(glm::abs(point), glm::dvec3(kFarthest)))) {
      return fail(ErrorKind::input, "{}: ContourData (3006,0050) has a point {:.3g} mm off", file.string(),
                  glm::length(mm));
    }
    points.push_back(point);
  }
  return points;
}

// The axis across which the points lie in one plane: the slices' if there is a choice.
std::optional<int> plane_of(const std::vector<glm::dvec3>& points) {
  glm::dvec3 low = points.front();
  glm::dvec3 high = points.front();
  for (const glm::dvec3& point : points) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  for (const int axis : {2, 1, 0}) {
    if (high[axis] - low[axis] <= kPlaneTolerance) return axis;
  }
  return std::nullopt;
}

// One region of interest while it is filled. Slices are flipped in the plane of its contours.
class RegionFiller {
 public:
  RegionFiller(const Geometry& grid, const fs::path& file, SliceBudget& budget)
      : grid_(grid), file_(file), budget_(budget) {}

  Status add(DcmItem& contour);
  void move_into(Segment& segment);

  [[nodiscard]] bool reaches_beyond() const { return reaches_beyond_; }
  [[nodiscard]] int left_out() const { return left_out_; }

 private:
  const Geometry& grid_;
  const fs::path& file_;
  SliceBudget& budget_;
  int axis_ = 2;  // across the contours
  std::map<std::int64_t, std::vector<std::uint8_t>> planes_;
  bool reaches_beyond_ = false;
  int left_out_ = 0;  // points and open lines
};

Status RegionFiller::add(DcmItem& contour) {
  const std::string type = element_text(contour, DCM_ContourGeometricType);
  if (type != "CLOSED_PLANAR" && type != "CLOSEDPLANAR_XOR") {
    ++left_out_;
    return {};
  }
  const auto points = points_of(contour, grid_, file_);
  if (!points) return pass_on(points);
  if (points->size() < 3) {
    ++left_out_;
    return {};
  }
  const auto axis = plane_of(*points);
  const double place = axis ? points->front()[*axis] : 0.0;
  const double plane = std::round(place);
  if (!axis || std::abs(place - plane) > kPlaneTolerance || (!planes_.empty() && *axis != axis_)) {
    return fail(ErrorKind::input, "{}: its contours do not lie in the slices of the volume", file_.string());
  }
  if (plane < 0.0 || plane > static_cast<double>(grid_.size[*axis] - 1)) {
    reaches_beyond_ = true;
    return {};
  }
  axis_ = *axis;
  const int i = axis_ == 0 ? 1 : 0;
  const int j = axis_ == 2 ? 1 : 2;
  std::vector<glm::dvec2> polygon;
  polygon.reserve(points->size());
  for (const glm::dvec3& point : *points) polygon.emplace_back(point[i], point[j]);
  auto& slice = planes_[static_cast<std::int64_t>(plane)];
  if (slice.empty()) {
    TIDEMARK_TRY(budget_.take(grid_.size[i] * grid_.size[j]));
    slice.resize(static_cast<std::size_t>(grid_.size[i] * grid_.size[j]));
  }
  reaches_beyond_ = flip_inside(polygon, grid_.size[i], grid_.size[j], slice) || reaches_beyond_;
  return {};
}

void RegionFiller::move_into(Segment& segment) {
  if (axis_ == 2) {
    segment.slices = std::move(planes_);
  } else {
    const int i = axis_ == 0 ? 1 : 0;
    const int j = 2;
    for (const auto& [plane, pixels] : planes_) {
      for (std::size_t n = 0; n < pixels.size(); ++n) {
        if (pixels[n] == 0) continue;
        Index3 voxel(0);
        voxel[axis_] = plane;
        voxel[i] = static_cast<std::int64_t>(n) % grid_.size[i];
        voxel[j] = static_cast<std::int64_t>(n) / grid_.size[i];
        auto& slice = segment.slices[voxel.z];
        slice.resize(static_cast<std::size_t>(grid_.size.x * grid_.size.y));
        slice[static_cast<std::size_t>(voxel.x + grid_.size.x * voxel.y)] = 1;
      }
    }
  }
  std::erase_if(segment.slices, [](const auto& entry) {
    return std::find(entry.second.begin(), entry.second.end(), 1) == entry.second.end();
  });
}

std::optional<SegmentColour> contour_colour(DcmItem& region) {
  const auto values = parse_integers(element_text(region, DCM_ROIDisplayColor));
  const auto fits = [](long long value) { return value >= 0 && value <= 255; };
  if (!values || values->size() != 3 || !std::all_of(values->begin(), values->end(), fits))
    return std::nullopt;
  return SegmentColour{static_cast<std::uint8_t>((*values)[0]), static_cast<std::uint8_t>((*values)[1]),
                       static_cast<std::uint8_t>((*values)[2])};
}

// As it is written, cut to what a message can hold.
std::string number_in(DcmItem& region, const DcmTagKey& key) {
  constexpr std::size_t kLongest = 12;  // IS (PS3.5 6.2)
  return element_text(region, key).substr(0, kLongest);
}

// The names that the structure set gives to the regions' numbers.
std::map<std::string, std::string> read_names(DcmDataset& dataset) {
  std::map<std::string, std::string> names;
  static_cast<void>(for_each_item(dataset, DCM_StructureSetROISequence, [&](DcmItem& region) -> Status {
    std::string name = tidied(element_text(region, DCM_ROIName));
    if (!name.empty()) names.try_emplace(number_in(region, DCM_ROINumber), std::move(name));
    return {};
  }));
  return names;
}

std::vector<std::string> read_frames_of_reference(DcmDataset& dataset) {
  std::set<std::string> frames;
  static_cast<void>(for_each_item(dataset, DCM_StructureSetROISequence, [&](DcmItem& region) -> Status {
    frames.insert(element_text(region, DCM_ReferencedFrameOfReferenceUID));
    return {};
  }));
  frames.erase(std::string());
  return {frames.begin(), frames.end()};
}

void say_what_is_missing(const RegionFiller& filler, const std::string& name, Segments& segments) {
  if (filler.reaches_beyond()) {
    segments.changes.push_back(fmt::format("{}: what lies beyond the volume is left out", name));
  }
  if (filler.left_out() > 0) {
    segments.changes.push_back(fmt::format(
        "{}: {} points and open contours surround nothing and are left out", name, filler.left_out()));
  }
}

Result<Segments> read(const fs::path& file, const Geometry& grid) {
  auto object = load_result(file);
  if (!object) return pass_on(object);
  DcmDataset& dataset = object->dataset();
  if (element_text(dataset, DCM_SOPClassUID) != UID_RTStructureSetStorage) {
    return fail(ErrorKind::input, "{}: is no RT structure set", file.string());
  }
  const auto names = read_names(dataset);
  Segments segments{grid, {}, {}, read_frames_of_reference(dataset)};
  SliceBudget budget(file);
  Status filled = for_each_item(dataset, DCM_ROIContourSequence, [&](DcmItem& region) -> Status {
    if (segments.list.size() == kMostRegions) {
      return fail(ErrorKind::input, "{}: ROIContourSequence (3006,0039) holds more than {} regions",
                  file.string(), kMostRegions);
    }
    RegionFiller filler(grid, file, budget);
    TIDEMARK_TRY(
        for_each_item(region, DCM_ContourSequence, [&](DcmItem& contour) { return filler.add(contour); }));
    const std::string number = number_in(region, DCM_ReferencedROINumber);
    const auto named = names.find(number);
    Segment segment;
    segment.name = named != names.end() ? named->second : fmt::format("Region {}", number);
    segment.colour = contour_colour(region);
    say_what_is_missing(filler, segment.name, segments);
    filler.move_into(segment);
    segments.list.push_back(std::move(segment));
    return {};
  });
  if (!filled) return pass_on(filled);
  if (segments.list.empty()) return fail(ErrorKind::input, "{}: it holds no contours", file.string());
  return segments;
}

}  // namespace

Result<Segments> read_structure_set(const fs::path& file, const Geometry& grid) {
  return guarded(file, [&] { return read(file, grid); });
}

}  // namespace tidemark::imaging
