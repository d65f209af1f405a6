#include "imaging/dicom/split_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "imaging/dicom/same_slices.h"
#include "imaging/dicom/separate_volumes.h"

namespace tidemark::imaging {
namespace {

bool has_place(const SliceHeader& slice) {
  return slice.position_mm && slice.orientation && slice.pixel_spacing_mm;
}

bool same_kind(const SliceHeader& a, const SliceHeader& b) {
  if (!same_size(a, b) || has_place(a) != has_place(b)) return false;
  return !has_place(a) || (same_orientation(a, b) && same_spacing(a, b));
}

// In order of appearance; none when there are too many: images that turn about an axis, each in an
// orientation of its own, are no volumes.
std::vector<SliceRefs> kinds_of(const std::vector<SliceHeader>& slices) {
  std::vector<SliceRefs> kinds;
  for (const SliceHeader& slice : slices) {
    const auto known = std::find_if(kinds.begin(), kinds.end(),
                                    [&](const SliceRefs& kind) { return same_kind(*kind.front(), slice); });
    if (known != kinds.end()) {
      known->push_back(&slice);
    } else {
      if (kinds.size() == kMostKinds) return {};
      kinds.push_back({&slice});
    }
  }
  return kinds;
}

glm::dvec3 normal_of(const SliceHeader& slice) {
  return glm::cross((*slice.orientation)[0], (*slice.orientation)[1]);
}

std::string plane_of(const SliceHeader& slice) {
  const glm::dvec3 normal = glm::abs(normal_of(slice));
  if (normal.z >= std::max(normal.x, normal.y)) return "axial";
  return normal.x >= normal.y ? "sagittal" : "coronal";
}

// The attributes that set a kind apart from the others.
std::string label_of_kind(const SliceRefs& kind, const std::vector<SliceRefs>& kinds) {
  const SliceHeader& own = *kind.front();
  const auto differs = [&](const auto& same) {
    return std::any_of(kinds.begin(), kinds.end(),
                       [&](const SliceRefs& other) { return !same(own, *other.front()); });
  };
  if (!has_place(own)) return "images without a place";
  const auto placed_or = [](bool (*same)(const SliceHeader&, const SliceHeader&)) {
    return [same](const SliceHeader& a, const SliceHeader& b) { return !has_place(b) || same(a, b); };
  };
  std::string label = differs(placed_or(same_orientation)) ? plane_of(own) : "";
  if (differs(same_size)) label = join_labels(label, fmt::format("{} x {} pixels", own.columns, own.rows));
  if (differs(placed_or(same_spacing))) {
    label = join_labels(label, fmt::format("pixels of {:.3g} mm", own.pixel_spacing_mm->x));
  }
  return label;
}

// Whether two images with one SOPInstanceUID at one position also have the same attributes.
bool is_copy(const SliceHeader& a, const SliceHeader& b) {
  const auto format = [](const SliceHeader& s) {
    return std::tie(s.bits_allocated, s.bits_stored, s.is_signed, s.slope, s.intercept,
                    s.traits.series_number, s.traits.instance, s.traits.image_type);
  };
  return a.frame == b.frame && a.tile == b.tile && same_kind(a, b) && format(a) == format(b);
}

// Removes copies from the slices, and names them.
std::vector<std::string> drop_copies(SliceRefs& slices) {
  // With the position, because some anonymisers write one UID into every image.
  std::map<std::tuple<std::string, double, double, double>, const SliceHeader*> known;
  std::vector<std::pair<const SliceHeader*, const SliceHeader*>> copies;
  std::erase_if(slices, [&](const SliceHeader* slice) {
    if (slice->sop_instance_uid.empty()) return false;
    const glm::dvec3 at = *slice->position_mm;
    const auto [first, is_new] = known.emplace(std::tuple(slice->sop_instance_uid, at.x, at.y, at.z), slice);
    if (is_new || !is_copy(*first->second, *slice)) return false;
    copies.emplace_back(slice, first->second);
    return true;
  });
  if (copies.empty()) return {};
  const auto name = [](const SliceHeader* slice) { return slice->file.filename().string(); };
  const std::string first =
      fmt::format("{} is the same image as {}", name(copies[0].first), name(copies[0].second));
  if (copies.size() == 1) return {first + " and is left out"};
  return {fmt::format("{} copies of images are left out (for example {})", copies.size(), first)};
}

// By stack, where each stack has several slices; else all together.
std::vector<LabelledSlices> by_stack(const SliceRefs& slices) {
  std::map<std::string, SliceRefs> stacks;
  for (const SliceHeader* slice : slices) stacks[slice->traits.stack].push_back(slice);
  const bool are_stacks =
      stacks.size() > 1 &&
      std::all_of(stacks.begin(), stacks.end(), [](const auto& stack) { return stack.second.size() > 1; });
  if (!are_stacks) return {{"", slices}};
  std::vector<LabelledSlices> result;
  for (auto& [stack, members] : stacks) {
    result.push_back({stack.empty() ? "without stack" : "stack " + stack, std::move(members)});
  }
  return result;
}

std::vector<SliceHeader> copy_of(const SliceRefs& slices) {
  std::vector<SliceHeader> copies;
  for (const SliceHeader* slice : slices) copies.push_back(*slice);
  return copies;
}

// The volumes of one kind.
std::vector<SeriesPart> split_kind(SliceRefs kind, const std::string& label) {
  if (!has_place(*kind.front())) return {{copy_of(kind), label, false, {}}};
  const auto dropped = drop_copies(kind);
  std::vector<SeriesPart> parts;
  for (const LabelledSlices& stack : by_stack(kind)) {
    for (const LabelledSlices& volume : separate_volumes(stack.slices)) {
      const std::string own = join_labels(join_labels(label, stack.label), volume.label);
      parts.push_back({copy_of(volume.slices), own, false, dropped});
    }
  }
  return parts;
}

// Takes out what is no damaged slice: images that cannot be used of another storage class and another size
// than those that can, a capture of the screen for one.
std::vector<SliceHeader> take_other_objects(std::vector<SliceHeader>& slices) {
  std::set<std::string> classes;
  std::set<std::pair<std::int64_t, std::int64_t>> sizes;
  for (const SliceHeader& slice : slices) {
    if (!slice.problem.empty()) continue;
    classes.insert(slice.sop_class_uid);
    sizes.emplace(slice.frame_columns, slice.frame_rows);
  }
  const auto belongs = std::stable_partition(slices.begin(), slices.end(), [&](const SliceHeader& slice) {
    return slice.problem.empty() || classes.empty() || slice.sop_class_uid.empty() ||
           classes.contains(slice.sop_class_uid) || sizes.contains({slice.frame_columns, slice.frame_rows});
  });
  std::vector<SliceHeader> others(std::make_move_iterator(belongs), std::make_move_iterator(slices.end()));
  slices.erase(belongs, slices.end());
  return others;
}

bool is_volume(const SeriesPart& part) {
  return part.slices.size() > 1 && has_place(part.slices.front());
}

// Whether an image that is in no volume may be a damaged slice of that one: it claims to be of the same type,
// and does not clearly lie in another plane.
bool may_belong(const SliceHeader& image, const SliceHeader& slice) {
  if (image.sop_class_uid != slice.sop_class_uid || image.traits.image_type != slice.traits.image_type) {
    return false;
  }
  if (!has_place(image)) return true;
  constexpr double kSamePlane = 0.996;  // the cosine of 5 degrees
  return !is_orthonormal(*image.orientation) ||
         std::abs(glm::dot(normal_of(image), normal_of(slice))) > kSamePlane;
}

// Whether a slice may be among the images that are in no volume.
bool is_doubtful(const std::vector<SeriesPart>& parts) {
  return std::any_of(parts.begin(), parts.end(), [&](const SeriesPart& odd) {
    return !is_volume(odd) && std::any_of(parts.begin(), parts.end(), [&](const SeriesPart& part) {
      return is_volume(part) && may_belong(odd.slices.front(), part.slices.front());
    });
  });
}

// Images alone of their kind, after `others`, as one part.
void gather_rest(std::vector<SeriesPart>& parts, std::vector<SliceHeader> others) {
  SeriesPart rest;
  rest.slices = std::move(others);
  rest.is_rest = true;
  rest.label = "images that fit into no volume";
  std::erase_if(parts, [&](SeriesPart& part) {
    if (part.slices.size() > 1) return false;
    rest.slices.push_back(std::move(part.slices.front()));
    rest.changes.insert(rest.changes.end(), part.changes.begin(), part.changes.end());
    return true;
  });
  if (!rest.slices.empty()) parts.push_back(std::move(rest));
}

}  // namespace

std::vector<SeriesPart> split_series(std::vector<SliceHeader> slices) {
  auto others = take_other_objects(slices);
  const bool is_usable =
      std::all_of(slices.begin(), slices.end(), [](const auto& s) { return s.problem.empty(); });
  const auto kinds = is_usable ? kinds_of(slices) : std::vector<SliceRefs>();
  std::vector<SeriesPart> parts;
  for (const SliceRefs& kind : kinds) {
    auto own = split_kind(kind, label_of_kind(kind, kinds));
    std::move(own.begin(), own.end(), std::back_inserter(parts));
  }
  if (std::none_of(parts.begin(), parts.end(), is_volume) || is_doubtful(parts)) {
    std::move(others.begin(), others.end(), std::back_inserter(slices));
    return {{std::move(slices), "", false, {}}};
  }
  gather_rest(parts, std::move(others));
  if (parts.size() == 1) parts.front().label.clear();
  return parts;
}

}  // namespace tidemark::imaging
