#include "imaging/dicom/series_geometry.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <set>

#include "imaging/dicom/same_slices.h"
#include "imaging/guard/spacing.h"

namespace tidemark::imaging {
namespace {

using Slices = std::vector<SliceHeader>;
// The reason for a failed check, or nothing.
using Reason = std::optional<std::string>;

// Beyond this (mm) a number is damage, not anatomy.
constexpr double kLargestPosition = 1e6;

std::string name(const SliceHeader& slice) {
  const std::string file = slice.file.filename().string();
  if (!slice.problem.empty()) return file;
  if (slice.tiles > 1) return fmt::format("{} (tile {})", file, slice.tile + 1);
  return slice.frames > 1 ? fmt::format("{} (frame {})", file, slice.frame + 1) : file;
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
      if (!is_sensible_spacing(s)) {
        return fmt::format("{}: PixelSpacing (0028,0030) is {} mm", name(slice), s);
      }
    }
    for (const double p : {slice.position_mm->x, slice.position_mm->y, slice.position_mm->z}) {
      // Written so that NaN fails.
      if (!(std::abs(p) <= kLargestPosition)) {
        return fmt::format("{}: ImagePositionPatient (0020,0032) is {} mm", name(slice), p);
      }
    }
    const auto& [row, column] = *slice.orientation;
    if (!is_orthonormal(*slice.orientation)) {
      return fmt::format(
          "{}: ImageOrientationPatient (0020,0037) is not two perpendicular unit vectors: "
          "({:g}, {:g}, {:g}), ({:g}, {:g}, {:g})",
          name(slice), row.x, row.y, row.z, column.x, column.y, column.z);
    }
  }
  return std::nullopt;
}

// Names the images that differ from the most common kind.
template <class Same>
Reason check_alike(const Slices& slices, const char* what, const Same& same) {
  std::vector<const SliceHeader*> kinds;
  std::vector<std::size_t> counts;
  for (const SliceHeader& slice : slices) {
    const auto known =
        std::find_if(kinds.begin(), kinds.end(), [&](auto* kind) { return same(*kind, slice); });
    if (kinds.size() > kMostKinds) return fmt::format("{} differs from image to image", what);
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
  if (auto r = check_alike(slices, "the size (Rows, Columns)", same_size)) return r;
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
    if (!is_same_place(positions[k] - positions[k - 1])) {
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
  const bool is_other_file = slices[first_repeat].file != slices[first_repeat - 1].file;
  if (is_other_file && !uid.empty() && uid == slices[first_repeat - 1].sop_instance_uid) {
    return fmt::format("{} are the same image (SOPInstanceUID {})", pair, uid);
  }
  const bool regular = std::all_of(counts.begin(), counts.end(), [&](auto c) { return c == counts[0]; });
  if (regular && counts.size() > 1) {
    return fmt::format(
        "holds {} images at each of {} positions (for example {}), and no attribute tells its volumes apart",
        counts[0], counts.size(), pair);
  }
  return fmt::format("{} lie at the same position", pair);
}

// The tiles of a mosaic are no images of their own.
SliceNumber number_of(const SliceHeader& slice) {
  SliceNumber number;
  if (slice.tiles > 1) return number;
  // An integer string (PS3.5, IS) is one of 32 bits.
  const auto& instance = slice.traits.instance;
  if (instance && std::abs(*instance) <= std::numeric_limits<std::int32_t>::max() &&
      *instance == std::floor(*instance)) {
    number.instance = static_cast<std::int64_t>(*instance);
  }
  if (slice.frames > 1) number.frame = slice.frame + 1;
  return number;
}

ImageStack stack_of(const Slices& slices, const glm::dmat3& axes) {
  const SliceHeader& first = slices.front();
  ImageStack stack;
  stack.size = {first.columns, first.rows, static_cast<std::int64_t>(slices.size())};
  stack.spacing_mm = *first.pixel_spacing_mm;
  stack.thickness_mm = first.thickness_mm.value_or(1.0);
  stack.axes = axes;
  for (const SliceHeader& slice : slices) {
    stack.positions_mm.push_back(*slice.position_mm);
    stack.names.push_back(name(slice));
  }
  return stack;
}

// An image that is its whole series needs no place among others: what it does not say is supposed, and told.
void complete_single(SliceHeader& slice, Series& series) {
  if (!slice.thickness_mm || !is_sensible_spacing(*slice.thickness_mm)) {
    slice.thickness_mm = 1.0;
    series.changes.emplace_back("a single image is a volume of one slice, which counts as 1 mm thick");
  } else {
    series.changes.push_back(
        fmt::format("a single image is a volume of one slice, {:g} mm thick as SliceThickness "
                    "(0018,0050) says",
                    *slice.thickness_mm));
  }
  if (!slice.pixel_spacing_mm && slice.detector_spacing_mm) {
    slice.pixel_spacing_mm = slice.detector_spacing_mm;
    series.warnings.emplace_back(
        "lengths are those on the detector (ImagerPixelSpacing, 0018,1164), where a projection is larger "
        "than the "
        "object");
  } else if (!slice.pixel_spacing_mm) {
    slice.pixel_spacing_mm = glm::dvec2(1.0);
    series.warnings.emplace_back("PixelSpacing (0028,0030) is missing: a pixel counts as 1 mm");
  }
  if (!slice.position_mm || !slice.orientation) {
    slice.position_mm = glm::dvec3(0.0);
    slice.orientation = {glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0)};
    series.frame_of_reference_uid.clear();
    series.geometry.oriented = false;
    series.warnings.emplace_back("the image does not say where it lies in the patient, nor which way up");
  }
}

// Checks that need no order.
Reason check_unsorted(const Slices& slices) {
  if (auto r = check_has_geometry(slices)) return r;
  if (auto r = check_numbers(slices)) return r;
  return check_all_alike(slices);
}

// Sorts along the normal; adds a sentence to the changes when that changes the order.
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
  // A damaged image may have no more than the UID of its series.
  const auto telling =
      std::find_if(slices.begin(), slices.end(), [](const SliceHeader& s) { return !s.modality.empty(); });
  const SliceHeader& first = telling != slices.end() ? *telling : slices.front();
  series.uid = first.series_uid;
  if (series.uid.empty()) {
    series.uid = std::filesystem::absolute(first.file).lexically_normal().parent_path().filename().string();
    if (series.uid.empty()) series.uid = first.file.filename().string();
    series.changes.emplace_back(
        "the images name no series (SeriesInstanceUID is empty); those of one folder are taken together");
  }
  series.modality = first.modality;
  series.date = first.date;
  series.patient = first.patient;
  series.study_uid = first.study_uid;
  series.sop_class_uid = first.sop_class_uid;
  series.description = first.description.empty() ? first.file.filename().string() : first.description;
  series.frame_of_reference_uid = first.frame_of_reference_uid;
  if (const auto other = all_that(slices,
                                  [&](const auto& s) {
                                    return s.problem.empty() &&
                                           s.frame_of_reference_uid != first.frame_of_reference_uid;
                                  });
      !other.empty()) {
    series.frame_of_reference_uid.clear();
    series.warnings.push_back(fmt::format(
        "FrameOfReferenceUID (0020,0052) is not the same in all images: {} of {} have another than {}",
        other.size(), slices.size(), name(first)));
  }
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
    std::set<std::filesystem::path> known;
    for (const SliceHeader& slice : slices) {
      series.sources.push_back({slice.file, slice.frame, slice.tile});
      series.numbers.push_back(number_of(slice));
      if (known.insert(slice.file).second) series.files.push_back(slice.file);
    }
  };
  auto problem = check_problems(slices);
  if (!problem && slices.size() == 1) complete_single(slices.front(), series);
  if (!problem) problem = check_unsorted(slices);
  if (problem) {
    series.reason = *problem;
    finish();
    return series;
  }
  const glm::dmat3 axes = axes_of(slices.front());
  sort_slices(slices, axes[2], series.changes);
  finish();
  auto reason = check_distinct(slices, along(slices, axes[2]));
  if (!reason) reason = state_quantity(slices, series);
  if (reason) {
    series.reason = *reason;
    return series;
  }
  series.stack = stack_of(slices, axes);
  series.scalar = scalar_of(slices, series.changes);
  set_grid(series, {});
  return series;
}

void set_grid(Series& series, const GridPolicy& policy) {
  if (series.stack.positions_mm.empty()) return;
  const auto take_back = [](std::vector<std::string>& all, const std::vector<std::string>& some) {
    std::erase_if(all,
                  [&](const auto& one) { return std::find(some.begin(), some.end(), one) != some.end(); });
  };
  take_back(series.changes, series.grid.changes);
  take_back(series.warnings, series.grid.warnings);
  series.policy = policy;
  series.grid = plan_regular_grid(series.stack, policy);
  const bool is_oriented = series.geometry.oriented;
  series.geometry = series.grid.geometry;
  series.geometry.oriented = is_oriented;
  series.reason = series.grid.refusal;
  series.loadable = series.reason.empty();
  series.changes.insert(series.changes.end(), series.grid.changes.begin(), series.grid.changes.end());
  series.warnings.insert(series.warnings.end(), series.grid.warnings.begin(), series.grid.warnings.end());
}

}  // namespace tidemark::imaging
