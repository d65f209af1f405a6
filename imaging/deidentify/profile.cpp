#include "imaging/deidentify/profile.h"

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace tidemark::imaging {
namespace {

// The actions of Table E.1-1, with their compound forms: XZ is X/Z, XZU is X/Z/U*.
enum class Code { X, Z, D, K, U, ZD, XZ, XD, XZD, XZU };

// Columns of options.
constexpr unsigned kNone = 0;
constexpr unsigned kUids = 1;
constexpr unsigned kDevice = 2;
constexpr unsigned kInstitution = 4;
constexpr unsigned kPatient = 8;
constexpr unsigned kDates = 16;

struct Row {
  std::uint16_t group;
  std::uint16_t element;
  Code code;
  unsigned options;

  [[nodiscard]] constexpr DicomTag tag() const { return {group, element}; }
};

#include "imaging/deidentify/profile_table.inc"

constexpr bool by_tag(const Row& a, const Row& b) {
  return a.tag() < b.tag();
}
static_assert(std::is_sorted(std::begin(kProfileRows), std::end(kProfileRows), by_tag));
static_assert(std::is_sorted(std::begin(kFurtherRows), std::end(kFurtherRows), by_tag));

template <class Rows>
const Row* find_in(const Rows& rows, DicomTag tag) {
  const auto found = std::lower_bound(std::begin(rows), std::end(rows), tag,
                                      [](const Row& row, DicomTag wanted) { return row.tag() < wanted; });
  return found != std::end(rows) && found->tag() == tag ? &*found : nullptr;
}

const Row* find_row(DicomTag tag) {
  const Row* row = find_in(kProfileRows, tag);
  return row != nullptr ? row : find_in(kFurtherRows, tag);
}

unsigned columns(const DeidentifyOptions& options) {
  return (options.keep_uids ? kUids : 0) | (options.keep_device ? kDevice : 0) |
         (options.keep_institution ? kInstitution : 0) | (options.keep_characteristics ? kPatient : 0);
}

bool is_temporal(std::string_view vr) {
  return vr == "DA" || vr == "DT" || vr == "TM";
}

// Days move by whole numbers, so that times of the day, and the zone they are in, stay as they are.
Fate moved(std::string_view vr) {
  return vr == "DA" || vr == "DT" ? Fate::shift : Fate::keep;
}

Fate fate_by_code(const Row& row, std::string_view vr) {
  // The one sequence of the compound forms that images must have, even if it is empty (Type 2).
  constexpr DicomTag kAcquisitionContext{0x0040, 0x0555};
  const bool is_sequence = vr == "SQ";
  switch (row.code) {
    case Code::X:
      return Fate::remove;
    case Code::Z:
      return Fate::empty;
    case Code::XZ:
      return is_sequence && row.tag() != kAcquisitionContext ? Fate::remove : Fate::empty;
    case Code::K:
    case Code::XZU:
      return Fate::keep;
    case Code::U:
      return Fate::map_uid;
    case Code::XD:
    case Code::XZD:
      return is_sequence ? Fate::remove : Fate::replace;
    case Code::ZD:
    case Code::D:
      return vr == "UI" ? Fate::map_uid : Fate::replace;
  }
  return Fate::remove;
}

Fate fate_by_representation(std::string_view vr, const DeidentifyOptions& options) {
  if (is_temporal(vr)) return options.shift_dates ? moved(vr) : Fate::replace;
  if (vr == "PN" || vr == "LT" || vr == "ST" || vr == "UT") return Fate::replace;
  if (vr == "UR" || vr == "UN") return Fate::remove;
  if (vr == "UI") return options.keep_uids ? Fate::keep : Fate::map_uid;
  return Fate::keep;
}

}  // namespace

Fate fate_of(DicomTag tag, std::string_view representation, const DeidentifyOptions& options) {
  const bool is_private = tag.group % 2 != 0;
  const bool is_group_length = tag.element == 0;
  const bool is_curve_or_overlay = (tag.group & 0xff00) == 0x5000 || (tag.group & 0xff00) == 0x6000;
  if (is_private || is_group_length || is_curve_or_overlay || representation.empty()) return Fate::remove;
  const Row* row = find_row(tag);
  if (row == nullptr) return fate_by_representation(representation, options);
  if (options.shift_dates && (row->options & kDates) != 0) return moved(representation);
  if ((row->options & columns(options)) != 0) return Fate::keep;
  return fate_by_code(*row, representation);
}

}  // namespace tidemark::imaging
