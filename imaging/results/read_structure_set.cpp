#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmrt/drtstrct.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <map>

#include "imaging/dicom/decimal.h"
#include "imaging/guarded.h"
#include "imaging/results/dicom_object.h"
#include "imaging/results/polygon_fill.h"
#include "imaging/results/results.h"

namespace tidemark {
namespace {

namespace fs = std::filesystem;

constexpr double kTolerance =
    0.2;  // of the distance of slices: planning systems round to a tenth of a millimetre
constexpr double kFarthest = 1e9;  // voxels

// Calls visit(item) for each item until one fails. Asked for an item by its number, DCMTK would count from
// the first one each time.
template <class Sequence, class Visit>
Status for_each_item(Sequence& sequence, const Visit& visit) {
  typename Sequence::Item* item = nullptr;
  for (sequence.gotoFirstItem(); sequence.getCurrentItem(item).good(); sequence.gotoNextItem()) {
    TIDEMARK_TRY(visit(*item));
  }
  return {};
}

// The points of a contour in the grid's voxels.
Result<std::vector<glm::dvec3>> points_of(const DRTContourSequence::Item& contour, const Geometry& grid,
                                          const fs::path& file) {
  OFVector<Float64> numbers;  // as text, DCMTK would take time with the square of their number
  const bool parsed = contour.getContourData(numbers).good();
  const auto finite = [](Float64 number) { return std::isfinite(number); };
  if (!parsed || numbers.size() % 3 != 0 || !std::all_of(numbers.begin(), numbers.end(), finite)) {
    return fail(ErrorKind::input, "{}: ContourData (3006,0050) is not a list of points", file.string());
  }
  const glm::dmat3 rotation = glm::inverse(grid.direction);
  std::vector<glm::dvec3> points;
  points.reserve(numbers.size() / 3);
  for (std::size_t n = 0; n + 2 < numbers.size(); n += 3) {
    const glm::dvec3 mm(numbers[n], numbers[n + 1], numbers[n + 2]);
    const glm::dvec3 point = rotation * (mm - grid.origin_mm) / grid.spacing_mm;
    // What is so far off may not stay finite in what is computed from it.
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
    if (high[axis] - low[axis] <= kTolerance) return axis;
  }
  return std::nullopt;
}

// One region of interest while it is filled. Slices are flipped in the plane of its contours.
class RegionFiller {
 public:
  RegionFiller(const Geometry& grid, const fs::path& file) : grid_(grid), file_(file) {}

  Status add(const DRTContourSequence::Item& contour);
  void move_into(Segment& segment);

  [[nodiscard]] bool reaches_beyond() const { return reaches_beyond_; }
  [[nodiscard]] int left_out() const { return left_out_; }

 private:
  const Geometry& grid_;
  const fs::path& file_;
  int axis_ = 2;  // across the contours
  std::map<std::int64_t, std::vector<std::uint8_t>> planes_;
  bool reaches_beyond_ = false;
  int left_out_ = 0;  // points and open lines
};

Status RegionFiller::add(const DRTContourSequence::Item& contour) {
  OFString type;
  contour.getContourGeometricType(type);
  if (type != "CLOSED_PLANAR" && type != "CLOSEDPLANAR_XOR") {
    ++left_out_;
    return {};
  }
  const auto points = points_of(contour, grid_, file_);
  if (!points) return tl::unexpected<Error>(points.error());
  if (points->size() < 3) {
    ++left_out_;
    return {};
  }
  const auto axis = plane_of(*points);
  const double place = axis ? points->front()[*axis] : 0.0;
  const double plane = std::round(place);
  if (!axis || std::abs(place - plane) > kTolerance || (!planes_.empty() && *axis != axis_)) {
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
  slice.resize(static_cast<std::size_t>(grid_.size[i] * grid_.size[j]));
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

std::optional<SegmentColour> colour_of(const DRTROIContourSequence::Item& contours) {
  OFString text;
  if (contours.getROIDisplayColor(text, -1).bad()) return std::nullopt;
  const auto values = parse_integers(text.c_str());
  const auto fits = [](long long value) { return value >= 0 && value <= 255; };
  if (!values || values->size() != 3 || !std::all_of(values->begin(), values->end(), fits))
    return std::nullopt;
  return SegmentColour{static_cast<std::uint8_t>((*values)[0]), static_cast<std::uint8_t>((*values)[1]),
                       static_cast<std::uint8_t>((*values)[2])};
}

// The names that the structure set gives to the regions' numbers.
std::map<std::string, std::string> read_names(DRTStructureSetIOD& set) {
  std::map<std::string, std::string> names;
  static_cast<void>(for_each_item(set.getStructureSetROISequence(),
                                  [&](const DRTStructureSetROISequence::Item& region) -> Status {
                                    OFString number;
                                    OFString name;
                                    region.getROINumber(number);
                                    region.getROIName(name);
                                    if (!name.empty()) names.try_emplace(number.c_str(), name.c_str());
                                    return {};
                                  }));
  return names;
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
  auto object = load_object(file);
  if (!object) return pass_on(object);
  DcmDataset& dataset = object->dataset();
  if (element_text(dataset, DCM_SOPClassUID) != UID_RTStructureSetStorage) {
    return fail(ErrorKind::input, "{}: is no RT structure set", file.string());
  }
  DRTStructureSetIOD set;
  const OFCondition parsed = set.read(dataset);
  if (parsed.bad()) {
    return fail(ErrorKind::input, "{}: is no valid RT structure set: {}", file.string(), parsed.text());
  }
  const auto names = read_names(set);
  Segments segments{grid, {}, {}};
  Status filled =
      for_each_item(set.getROIContourSequence(), [&](DRTROIContourSequence::Item& region) -> Status {
        RegionFiller filler(grid, file);
        const Status added =
            for_each_item(region.getContourSequence(),
                          [&](const DRTContourSequence::Item& contour) { return filler.add(contour); });
        if (!added) return added;
        OFString number;
        region.getReferencedROINumber(number);
        const auto named = names.find(number.c_str());
        Segment segment;
        segment.name = named != names.end() ? named->second : fmt::format("Region {}", number.c_str());
        segment.colour = colour_of(region);
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

}  // namespace tidemark
