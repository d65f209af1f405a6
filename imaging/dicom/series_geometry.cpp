#include "imaging/dicom/series_geometry.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

namespace tidemark {
namespace {

using Slices = std::vector<SliceHeader>;
// A reason why not, or nothing when the check is passed.
using Reason = std::optional<std::string>;

// Relative: how much orientation and pixel spacing may differ from slice to slice, rounding in the files.
constexpr double kSameness = 1e-4;
// How far the orientation may be from orthonormal before it is not believed.
constexpr double kOrthonormality = 1e-3;
// Beyond these (mm) a number is damage, not anatomy.
constexpr double kLargestSpacing = 1000.0;
constexpr double kSmallestSpacing = 1e-5;
constexpr double kLargestPosition = 1e6;

std::string name(const SliceHeader& slice) {
  return slice.file.filename().string();
}

// "a.dcm", "a.dcm and b.dcm" or "a.dcm, b.dcm and 7 more".
std::string names(const std::vector<const SliceHeader*>& slices) {
  if (slices.size() == 1) return name(*slices[0]);
  if (slices.size() == 2) return fmt::format("{} and {}", name(*slices[0]), name(*slices[1]));
  return fmt::format("{}, {} and {} more", name(*slices[0]), name(*slices[1]), slices.size() - 2);
}

template <class Predicate>
std::vector<const SliceHeader*> all_that(const Slices& slices, const Predicate& predicate) {
  std::vector<const SliceHeader*> found;
  for (const SliceHeader& slice : slices) {
    if (predicate(slice)) found.push_back(&slice);
  }
  return found;
}

Reason check_problems(const Slices& slices) {
  const auto bad = all_that(slices, [](const SliceHeader& s) { return !s.problem.empty(); });
  if (bad.empty()) return std::nullopt;
  const std::string first = fmt::format("{}: {}", name(*bad[0]), bad[0]->problem);
  if (bad.size() == 1) return first;
  return fmt::format("{} ({} of {} files cannot be used)", first, bad.size(), slices.size());
}

Reason check_mosaic(const Slices& slices) {
  const auto mosaics = all_that(slices, [](const SliceHeader& s) { return s.is_mosaic; });
  if (mosaics.empty()) return std::nullopt;
  return fmt::format("{}: Siemens mosaic (many slices tiled into one image), which is not read yet",
                     names(mosaics));
}

Reason check_has_geometry(const Slices& slices) {
  const auto missing = [&](const char* what, auto member) -> Reason {
    const auto bad = all_that(slices, [&](const SliceHeader& s) { return !(s.*member).has_value(); });
    if (bad.empty()) return std::nullopt;
    return fmt::format("{}: {} is missing, so where the image lies is not known", names(bad), what);
  };
  if (auto r = missing("ImageOrientationPatient (0020,0037)", &SliceHeader::orientation)) return r;
  if (auto r = missing("ImagePositionPatient (0020,0032)", &SliceHeader::position_mm)) return r;
  return missing("PixelSpacing (0028,0030)", &SliceHeader::pixel_spacing_mm);
}

Reason check_numbers(const Slices& slices) {
  for (const SliceHeader& slice : slices) {
    const glm::dvec2 spacing = *slice.pixel_spacing_mm;
    for (const double s : {spacing.x, spacing.y}) {
      // Written so that NaN fails.
      if (!(s >= kSmallestSpacing && s <= kLargestSpacing)) {
        return fmt::format("{}: PixelSpacing (0028,0030) is {} mm", name(slice), s);
      }
    }
    for (const double p : {slice.position_mm->x, slice.position_mm->y, slice.position_mm->z}) {
      if (!(std::abs(p) <= kLargestPosition)) {
        return fmt::format("{}: ImagePositionPatient (0020,0032) is {} mm", name(slice), p);
      }
    }
    const auto& [row, column] = *slice.orientation;
    const bool orthonormal = std::abs(glm::length(row) - 1.0) <= kOrthonormality &&
                             std::abs(glm::length(column) - 1.0) <= kOrthonormality &&
                             std::abs(glm::dot(row, column)) <= kOrthonormality;
    if (!orthonormal) {
      return fmt::format(
          "{}: ImageOrientationPatient (0020,0037) is not two perpendicular unit vectors: "
          "({:g}, {:g}, {:g}), ({:g}, {:g}, {:g})",
          name(slice), row.x, row.y, row.z, column.x, column.y, column.z);
    }
  }
  return std::nullopt;
}

bool same_orientation(const SliceHeader& a, const SliceHeader& b) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const glm::dvec3 difference = glm::abs((*a.orientation)[axis] - (*b.orientation)[axis]);
    if (std::max({difference.x, difference.y, difference.z}) > kSameness) return false;
  }
  return true;
}

bool same_spacing(const SliceHeader& a, const SliceHeader& b) {
  const glm::dvec2 difference = glm::abs(*a.pixel_spacing_mm - *b.pixel_spacing_mm);
  return difference.x <= kSameness * a.pixel_spacing_mm->x &&
         difference.y <= kSameness * a.pixel_spacing_mm->y;
}

// Names the images that differ from the most common kind.
template <class Same>
Reason check_alike(const Slices& slices, const char* what, const Same& same) {
  std::vector<const SliceHeader*> kinds;
  std::vector<std::size_t> counts;
  for (const SliceHeader& slice : slices) {
    const auto known =
        std::find_if(kinds.begin(), kinds.end(), [&](auto* kind) { return same(*kind, slice); });
    counts.resize(kinds.size() + 1);
    ++counts[static_cast<std::size_t>(known - kinds.begin())];
    if (known == kinds.end()) kinds.push_back(&slice);
  }
  if (kinds.size() == 1) return std::nullopt;
  const auto most = std::max_element(counts.begin(), counts.end());
  const SliceHeader& common = *kinds[static_cast<std::size_t>(most - counts.begin())];
  const auto odd = all_that(slices, [&](const SliceHeader& s) { return !same(common, s); });
  return fmt::format("{} is not the same in all images: {} differ{} from {}", what, names(odd),
                     odd.size() == 1 ? "s" : "", name(common));
}

Reason check_all_alike(const Slices& slices) {
  if (auto r = check_alike(slices, "the size (Rows, Columns)", [](const auto& a, const auto& b) {
        return a.rows == b.rows && a.columns == b.columns;
      })) {
    return r;
  }
  if (auto r = check_alike(slices, "the orientation", same_orientation)) return r;
  return check_alike(slices, "PixelSpacing (0028,0030)", same_spacing);
}

// Exactly orthonormal axes i, j, k of the first slice.
glm::dmat3 axes_of(const SliceHeader& slice) {
  const glm::dvec3 i = glm::normalize((*slice.orientation)[0]);
  const glm::dvec3 j_raw = (*slice.orientation)[1];
  const glm::dvec3 j = glm::normalize(j_raw - glm::dot(i, j_raw) * i);
  return {i, j, glm::cross(i, j)};
}

double tolerance(double distance) {
  return std::max(1e-3 * distance, 0.01) + 1e-9;
}

// Positions along the normal, of sorted slices.
std::vector<double> along(const Slices& slices, glm::dvec3 normal) {
  std::vector<double> positions;
  for (const SliceHeader& slice : slices) positions.push_back(glm::dot(*slice.position_mm, normal));
  return positions;
}

Reason check_distinct(const Slices& slices, const std::vector<double>& positions) {
  // How many images there are at each position.
  std::vector<std::size_t> counts{1};
  std::size_t first_repeat = 0;
  for (std::size_t k = 1; k < slices.size(); ++k) {
    if (positions[k] - positions[k - 1] > tolerance(0.0)) {
      counts.push_back(1);
    } else {
      if (first_repeat == 0) first_repeat = k;
      ++counts.back();
    }
  }
  if (first_repeat == 0) return std::nullopt;
  const std::string pair =
      fmt::format("{} and {}", name(slices[first_repeat - 1]), name(slices[first_repeat]));
  // A file and its copy; otherwise images that were taken at one place.
  const std::string& uid = slices[first_repeat].sop_instance_uid;
  if (!uid.empty() && uid == slices[first_repeat - 1].sop_instance_uid) {
    return fmt::format("{} are the same image (SOPInstanceUID {})", pair, uid);
  }
  const bool regular = std::all_of(counts.begin(), counts.end(), [&](auto c) { return c == counts[0]; });
  if (regular && counts.size() > 1) {
    return fmt::format(
        "holds {} images at each of {} positions (for example {}): several volumes in one series are not "
        "read yet",
        counts[0], counts.size(), pair);
  }
  return fmt::format("{} lie at the same position", pair);
}

// Positions must advance along the normal alone; a constant sideways step is a tilted gantry.
Reason check_straight(const Slices& slices, const std::vector<double>& positions, glm::dvec3 normal) {
  const auto sideways = [&](std::size_t from, std::size_t to) {
    const glm::dvec3 step = *slices[to].position_mm - *slices[from].position_mm;
    return glm::length(step - glm::dot(step, normal) * normal);
  };
  const auto refuse = [&](std::size_t from, std::size_t to) {
    const double shift = sideways(from, to);
    const double degrees = std::atan2(shift, positions[to] - positions[from]) * 180.0 / std::numbers::pi;
    return fmt::format(
        "from {} to {} the images move {:.3f} mm sideways, {:.1f} degrees off their normal (gantry tilt or "
        "shear), which is not read yet",
        name(slices[from]), name(slices[to]), shift, degrees);
  };
  for (std::size_t k = 1; k < slices.size(); ++k) {
    if (sideways(k - 1, k) > tolerance(positions[k] - positions[k - 1])) return refuse(k - 1, k);
  }
  // Small steps to the same side add up.
  const std::size_t last = slices.size() - 1;
  if (sideways(0, last) > tolerance(positions[last] - positions[0])) return refuse(0, last);
  return std::nullopt;
}

Reason check_even(const Slices& slices, const std::vector<double>& positions) {
  const std::size_t steps = slices.size() - 1;
  std::vector<double> distances;
  for (std::size_t k = 0; k < steps; ++k) distances.push_back(positions[k + 1] - positions[k]);
  std::vector<double> sorted = distances;
  std::sort(sorted.begin(), sorted.end());
  const double usual = sorted[(steps - 1) / 2];  // of two, the smaller: a gap is the exception
  const auto uneven = [&](std::size_t k) { return std::abs(distances[k] - usual) > tolerance(usual); };
  for (std::size_t k = 0; k < steps; ++k) {
    if (!uneven(k)) continue;
    const double multiple = std::round(distances[k] / usual);
    const bool missing =
        multiple >= 2.0 && std::abs(distances[k] - multiple * usual) <= multiple * tolerance(usual);
    if (missing) {
      return fmt::format(
          "{:.0f} slice{} missing between {} and {}: they are {:.3f} mm apart, others {:.3f} mm",
          multiple - 1.0, multiple > 2.0 ? "s are" : " is", name(slices[k]), name(slices[k + 1]),
          distances[k], usual);
    }
    return fmt::format("uneven slice distances: {} and {} are {:.3f} mm apart, others {:.3f} mm",
                       name(slices[k]), name(slices[k + 1]), distances[k], usual);
  }
  // Small deviations to the same side add up.
  const double mean = (positions.back() - positions.front()) / static_cast<double>(steps);
  for (std::size_t k = 0; k <= steps; ++k) {
    const double expected = positions.front() + mean * static_cast<double>(k);
    if (std::abs(positions[k] - expected) > std::max(0.1 * mean, tolerance(mean))) {
      return fmt::format(
          "uneven slice distances: {} lies {:.3f} mm from its place in an even series of {:.3f} mm",
          name(slices[k]), positions[k] - expected, mean);
    }
  }
  return std::nullopt;
}

// Checks that need no order.
Reason check_unsorted(const Slices& slices) {
  if (auto r = check_problems(slices)) return r;
  if (auto r = check_mosaic(slices)) return r;
  if (slices.size() < 2) {
    return fmt::format("{} is a single image: a volume needs at least two slices", name(slices[0]));
  }
  if (auto r = check_has_geometry(slices)) return r;
  if (auto r = check_numbers(slices)) return r;
  return check_all_alike(slices);
}

// Sorts along the normal; says so when that changes the order.
void sort_slices(Slices& slices, glm::dvec3 normal, std::vector<std::string>& changes) {
  const auto before = [&](const SliceHeader& a, const SliceHeader& b) {
    return glm::dot(*a.position_mm, normal) < glm::dot(*b.position_mm, normal);
  };
  if (std::is_sorted(slices.begin(), slices.end(), before)) return;
  std::stable_sort(slices.begin(), slices.end(), before);
  changes.emplace_back("slices sorted by position");
}

// The scalar type that holds every slice's values (load_dicom follows it).
std::string scalar_of(const Slices& slices, std::vector<std::string>& changes) {
  const auto all = [&](const auto& predicate) {
    return std::all_of(slices.begin(), slices.end(), predicate);
  };
  const SliceHeader& first = slices.front();
  if (!all([&](const auto& s) { return s.slope == first.slope && s.intercept == first.intercept; })) {
    changes.emplace_back(
        "rescale slope and intercept differ from slice to slice: values stored rescaled as float");
    return "float";
  }
  if (!all([](const auto& s) { return s.bits_allocated <= 16; })) {
    changes.emplace_back("32-bit values stored rescaled as float");
    return "float";
  }
  if (all([](const auto& s) { return s.is_signed || s.bits_stored <= 15; }) &&
      !all([](const auto& s) { return !s.is_signed; })) {
    return "int16";
  }
  if (all([](const auto& s) { return !s.is_signed; })) return "uint16";
  changes.emplace_back("signed and unsigned slices: values stored rescaled as float");
  return "float";
}

void describe(const Slices& slices, Series& series) {
  // A damaged image may say no more than which series it belongs to.
  const auto telling =
      std::find_if(slices.begin(), slices.end(), [](const SliceHeader& s) { return !s.modality.empty(); });
  const SliceHeader& first = telling != slices.end() ? *telling : slices.front();
  series.uid = first.series_uid;
  if (series.uid.empty()) {
    series.uid = std::filesystem::absolute(first.file).lexically_normal().parent_path().filename().string();
    if (series.uid.empty()) series.uid = name(first);
    series.changes.emplace_back(
        "the images name no series (SeriesInstanceUID is empty); those of one folder are taken together");
  }
  series.modality = first.modality;
  series.date = first.date;
  series.patient = first.patient;
  series.description = first.description.empty() ? name(first) : first.description;
  for (const SliceHeader& slice : slices) {
    auto& known = series.transfer_syntaxes;
    if (std::find(known.begin(), known.end(), slice.transfer_syntax) == known.end()) {
      known.push_back(slice.transfer_syntax);
    }
  }
  const auto warn = [&](auto member, const char* what) {
    const auto found = all_that(slices, [&](const SliceHeader& s) { return s.*member; });
    if (!found.empty())
      series.warnings.push_back(fmt::format("{} ({} of {} images)", what, found.size(), slices.size()));
  };
  warn(&SliceHeader::is_lossy, "compressed with loss");
  warn(&SliceHeader::is_monochrome1,
       "MONOCHROME1: small values are meant to be shown white; values are kept");
  warn(&SliceHeader::has_burned_in_text, "text is burned into the image (BurnedInAnnotation)");
}

}  // namespace

Series arrange_series(std::vector<SliceHeader> slices) {
  Series series;
  describe(slices, series);
  const auto finish = [&] {
    for (const SliceHeader& slice : slices) series.files.push_back(slice.file);
  };
  if (auto reason = check_unsorted(slices)) {
    series.reason = *reason;
    finish();
    return series;
  }
  const glm::dmat3 axes = axes_of(slices.front());
  sort_slices(slices, axes[2], series.changes);
  finish();
  const std::vector<double> positions = along(slices, axes[2]);
  auto reason = check_distinct(slices, positions);
  if (!reason) reason = check_straight(slices, positions, axes[2]);
  if (!reason) reason = check_even(slices, positions);
  if (!reason) reason = state_quantity(slices, series);
  if (reason) {
    series.reason = *reason;
    return series;
  }
  const SliceHeader& first = slices.front();
  const auto count = static_cast<std::int64_t>(slices.size());
  series.geometry.size = {first.columns, first.rows, count};
  series.geometry.spacing_mm = glm::dvec3(
      *first.pixel_spacing_mm, (positions.back() - positions.front()) / static_cast<double>(count - 1));
  series.geometry.direction = axes;
  series.geometry.origin_mm = *first.position_mm;
  series.scalar = scalar_of(slices, series.changes);
  series.loadable = true;
  return series;
}

}  // namespace tidemark
