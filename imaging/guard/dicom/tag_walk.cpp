#include "imaging/guard/dicom/tag_walk.h"

#include <algorithm>

namespace tidemark::imaging {
namespace {

constexpr DicomTag kItem{0xfffe, 0xe000};
constexpr DicomTag kItemEnd{0xfffe, 0xe00d};
constexpr DicomTag kSequenceEnd{0xfffe, 0xe0dd};
constexpr DicomTag kSpecificCharacterSet{0x0008, 0x0005};

// DCMTK's memory for an element with its node in a list, rounded up.
constexpr std::int64_t kBytesOfObject = 256;
// DCMTK searches an element's place from the end of its list, and a private element's creator through all of
// them: that many steps take a moment.
constexpr std::int64_t kMostSearches = 20'000'000;

// PS3.5 7.1.2: the representations with a length of 16 bits, and those with 32 bits.
constexpr std::string_view kShortLength = "AE AS AT CS DA DS DT FD FL IS LO LT PN SH SL SS ST TM UI UL US";
constexpr std::string_view kLongLength = "OB OD OF OL OV OW SQ SV UC UN UR UT UV";

bool is_among(std::string_view list, std::string_view two) {
  const std::size_t found = list.find(two);
  return found != std::string_view::npos && found % 3 == 0;
}

}  // namespace

TagWalk::TagWalk(ByteSource& source, std::int64_t most_bytes)
    : reader_(source), most_objects_(most_bytes / kBytesOfObject) {}

bool TagWalk::fails(DicomTag tag, std::int64_t offset, std::string what) {
  damage_ = {tag, offset, std::move(what)};
  return false;
}

// Two capitals that are in no list are taken for a representation of later editions, which all have long
// lengths; question marks for an unknown one of old writers, which had short ones.
bool TagWalk::read_representation(const std::uint8_t* bytes, ElementHeader& header, bool& has_long_length) {
  header.representation = {static_cast<char>(bytes[0]), static_cast<char>(bytes[1])};
  const std::string_view two(header.representation.data(), 2);
  const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
  if (!(is_capital(two[0]) && is_capital(two[1])) && two != "??") {
    return fails(header.tag, header.begin,
                 fmt::format("has no value representation (bytes {:02X} {:02X})", bytes[0], bytes[1]));
  }
  has_long_length = is_among(kLongLength, two) || (!is_among(kShortLength, two) && two != "??");
  return true;
}

bool TagWalk::read_header(std::int64_t at, std::int64_t end, ElementCoding coding, ElementHeader& header) {
  header = {};
  header.begin = at;
  const std::uint8_t* bytes = at + 8 <= end ? reader_.at(at, 8) : nullptr;
  if (bytes == nullptr) {
    return fails(top().tag, at, fmt::format("ends within an element: {} bytes are left", end - at));
  }
  header.tag = {coding.word(bytes), coding.word(bytes + 2)};
  header.value = at + 8;
  if (!coding.is_explicit || header.tag.group == kItem.group) {
    header.length = coding.long_word(bytes + 4);
    return true;
  }
  bool has_long_length = false;
  if (!read_representation(bytes + 4, header, has_long_length)) return false;
  if (!has_long_length) {
    header.length = coding.word(bytes + 6);
    return true;
  }
  bytes = at + 12 <= end ? reader_.at(at + 8, 4) : nullptr;
  if (bytes == nullptr) return fails(header.tag, at, "ends within its length");
  header.length = coding.long_word(bytes);
  header.value = at + 12;
  return true;
}

bool TagWalk::check_length(const ElementHeader& header, std::int64_t end) {
  if (header.end() > end) {
    return fails(header.tag, header.begin,
                 fmt::format("says {} bytes, {} are left", header.length, end - header.value));
  }
  if (header.length % 2 == 0) return true;
  return fails(header.tag, header.begin, fmt::format("has an odd length, {}", header.length));
}

bool TagWalk::check_meta(const ElementHeader& header) {
  const std::string_view vr(header.representation.data(), 2);
  if (!is_among(kShortLength, vr) && !is_among(kLongLength, vr)) {
    return fails(header.tag, header.begin, fmt::format("has the unknown value representation {}", vr));
  }
  if (header.is_undefined() || header.is("SQ")) {
    return fails(header.tag, header.begin, "is a sequence in the file meta information");
  }
  return check_length(header, reader_.size()) && count(top(), header);
}

tl::expected<std::int64_t, TagDamage> TagWalk::walk_meta(std::int64_t begin, const Visitor& visit) {
  constexpr ElementCoding kCoding{true, false};
  std::int64_t stated_end = -1;
  at_ = begin;
  while (true) {
    const std::uint8_t* bytes = reader_.at(at_, 2);
    if (bytes == nullptr || kCoding.word(bytes) != 0x0002) break;
    ElementHeader header;
    if (!read_header(at_, reader_.size(), kCoding, header) || !check_meta(header)) {
      return tl::unexpected(damage_);
    }
    if (header.tag.element == 0x0000 && header.is("UL") && header.length == 4) {
      if (const std::uint8_t* length = reader_.at(header.value, 4)) {
        stated_end = header.end() + kCoding.long_word(length);
      }
    }
    visit(header, reader_, nullptr);
    at_ = header.end();
  }
  if (stated_end >= 0 && stated_end != at_) {
    fails({0x0002, 0x0000}, begin,
          fmt::format("says that group 0002 ends at byte {}, it ends at {}", stated_end, at_));
    return tl::unexpected(damage_);
  }
  return at_;
}

tl::expected<void, TagDamage> TagWalk::walk_dataset(std::int64_t begin, ElementCoding coding,
                                                    bool has_fragments, const Visitor& visit,
                                                    const Observer& observe) {
  at_ = begin;
  depth_ = 0;
  levels_[0] = Level{.begin = begin, .end = reader_.size(), .coding = coding};
  while (true) {
    Level& level = top();
    if (at_ == level.end) {
      if (level.is_delimited) {
        fails(level.tag, at_, level.is_sequence ? "has no sequence delimiter" : "has no item delimiter");
        return tl::unexpected(damage_);
      }
      if (depth_ == 0) return {};
      --depth_;
      continue;
    }
    if (!(level.is_sequence ? step_item() : step_element(has_fragments, visit, observe))) {
      return tl::unexpected(damage_);
    }
  }
}

// Limits the memory and steps that a parser spends on the element.
bool TagWalk::count(Level& level, const ElementHeader& header) {
  if (++objects_ > most_objects_) {
    return fails(header.tag, header.begin, fmt::format("is one of more than {} elements", most_objects_));
  }
  if (header.tag < level.previous) searches_ += level.elements;
  level.previous = std::max(level.previous, header.tag);
  ++level.elements;
  if (header.tag.group % 2 != 0) {
    if (header.tag.element >= 0x1000) searches_ += level.creators;
    if (header.tag.element >= 0x0010 && header.tag.element <= 0x00ff) ++level.creators;
  }
  if (searches_ <= kMostSearches) return true;
  return fails(header.tag, header.begin, "is one of too many elements that are not in order");
}

bool TagWalk::enter(const Level& level, const ElementHeader& header) {
  if (level.is_sequence && depth_ == 2 * kDeepest) {
    return fails(header.tag, header.begin,
                 fmt::format("lies in more than {} sequences, one within another", kDeepest));
  }
  ++depth_;
  top() = level;
  top().begin = header.value;
  at_ = header.value;
  return true;
}

bool TagWalk::enter_sequence(const ElementHeader& header, bool is_implicit) {
  Level level{.end = header.is_undefined() ? top().end : header.end(),
              .coding = top().coding,
              .tag = header.tag,
              .is_sequence = true,
              .is_delimited = header.is_undefined()};
  // The content of an element of unknown representation is implicit little endian (PS3.5 6.2.2).
  if (is_implicit) level.coding = {false, false};
  return enter(level, header);
}

// Within a sequence: an item, or the end.
bool TagWalk::step_item() {
  const Level sequence = top();
  ElementHeader header;
  if (!read_header(at_, sequence.end, {false, sequence.coding.is_big_endian}, header)) return false;
  if (header.tag == kSequenceEnd) return step_delimiter(header);
  if (header.tag != kItem) {
    return fails(
        sequence.tag, at_,
        fmt::format("holds ({:04X},{:04X}) where an item belongs", header.tag.group, header.tag.element));
  }
  if (!header.is_undefined() && header.end() > sequence.end) {
    return fails(
        sequence.tag, at_,
        fmt::format("has an item of {} bytes, {} are left", header.length, sequence.end - header.value));
  }
  if (!count(top(), header)) return false;
  return enter({.end = header.is_undefined() ? sequence.end : header.end(),
                .coding = sequence.coding,
                .tag = sequence.tag,
                .is_delimited = header.is_undefined()},
               header);
}

bool TagWalk::step_delimiter(const ElementHeader& header) {
  const Level& level = top();
  const bool fits = header.tag == (level.is_sequence ? kSequenceEnd : kItemEnd) && level.is_delimited;
  if (!fits || header.length != 0) {
    return fails(level.tag, header.begin,
                 fmt::format("has a delimiter ({:04X},{:04X}) of {} bytes where none belongs",
                             header.tag.group, header.tag.element, header.length));
  }
  at_ = header.value;
  --depth_;
  return true;
}

// Whether a parser may take the value for a sequence. Up to four bytes are looked at, even beyond the value:
// DCMTK reads a whole tag there, however short the value is.
bool TagWalk::begins_as_item(const ElementHeader& header) {
  if (header.length == 0) return false;
  const std::uint8_t* bytes = reader_.at(header.value, 4);
  if (bytes == nullptr) return false;
  constexpr ElementCoding kCoding{false, false};
  const DicomTag tag{kCoding.word(bytes), kCoding.word(bytes + 2)};
  return tag == kItem || tag == kItemEnd || tag == kSequenceEnd;
}

bool TagWalk::show(const ElementHeader& header, const Observer& observe) {
  if (!observe || observe(header, reader_, {top().tag, top().begin, depth_ / 2})) return true;
  return fails(header.tag, header.begin, "is where reading was ended");
}

bool TagWalk::step_element(bool has_fragments, const Visitor& visit, const Observer& observe) {
  const Level level = top();
  ElementHeader header;
  if (!read_header(at_, level.end, level.coding, header)) return false;
  if (header.tag.group == kItem.group) return step_delimiter(header);
  if (!count(top(), header)) return false;
  const bool is_unknown = !level.coding.is_explicit || header.is("UN");
  if (header.is_undefined()) {
    if (header.tag == kPixelData) {
      if (!has_fragments) return fails(header.tag, at_, "has no length, though it is not compressed");
      Fragments fragments;
      if (!pass_fragments(header, fragments)) return false;
      if (depth_ == 0) visit(header, reader_, &fragments);
      return true;
    }
    if (is_unknown || header.is("SQ")) return show(header, observe) && enter_sequence(header, is_unknown);
    return fails(header.tag, at_, "has no length, and is no sequence");
  }
  if (!check_length(header, level.end)) return false;
  if (header.tag == kPixelData && has_fragments && depth_ == 0) {
    return fails(header.tag, at_, "has a length, though the transfer syntax is one of compressed pixels");
  }
  if (!show(header, observe)) return false;
  if (header.is("SQ")) return enter_sequence(header, false);
  if (is_unknown && header.tag != kPixelData && begins_as_item(header)) return enter_sequence(header, true);
  if (header.tag == kSpecificCharacterSet && !check_character_sets(header)) return false;
  if (depth_ == 0) visit(header, reader_, nullptr);
  at_ = header.end();
  return true;
}

// DCMTK takes time with the square of the number of values, and looks for a converter for each.
bool TagWalk::check_character_sets(const ElementHeader& header) {
  constexpr std::uint32_t kLongestValue = 16 + 1;  // CS (PS3.5 6.2), and the backslash behind it
  const auto refuse = [&](std::string_view why) { return fails(header.tag, header.begin, std::string(why)); };
  if (header.length > kMostCharacterSets * kLongestValue) {
    return refuse(
        fmt::format("has {} bytes: more than {} character sets", header.length, kMostCharacterSets));
  }
  int values = 1;
  for (std::uint32_t done = 0; done < header.length;) {
    const auto count = std::min<std::size_t>(ByteReader::kMost, header.length - done);
    const std::uint8_t* bytes = reader_.at(header.value + done, count);
    if (bytes == nullptr) return refuse("cannot be read");
    values += static_cast<int>(std::count(bytes, bytes + count, '\\'));
    done += static_cast<std::uint32_t>(count);
  }
  if (values > kMostCharacterSets) {
    return refuse(fmt::format("has {} values: more than {} character sets", values, kMostCharacterSets));
  }
  character_sets_ += values;
  if (character_sets_ <= kMostCharacterSetsOfAll) return true;
  return refuse(
      fmt::format("is one of very many: more than {} character sets in one file", kMostCharacterSetsOfAll));
}

// PS3.5 A.4: an item with the offset table, items with fragments, a delimiter.
bool TagWalk::pass_fragments(const ElementHeader& header, Fragments& fragments) {
  const Level& level = top();
  const ElementCoding items{false, level.coding.is_big_endian};
  at_ = header.value;
  for (bool is_table = true;; is_table = false) {
    ElementHeader item;
    if (at_ + 8 > level.end) return fails(header.tag, at_, "has no sequence delimiter");
    if (!read_header(at_, level.end, items, item)) return false;
    if (item.tag == kSequenceEnd && item.length == 0 && !is_table) {
      fragments.end = at_;
      at_ = item.value;
      return true;
    }
    if (item.tag != kItem) {
      return fails(
          header.tag, at_,
          fmt::format("holds ({:04X},{:04X}) where a fragment belongs", item.tag.group, item.tag.element));
    }
    if (item.is_undefined() || item.end() > level.end) {
      return fails(
          header.tag, at_,
          fmt::format("has a fragment of {} bytes, {} are left", item.length, level.end - item.value));
    }
    if (item.length % 2 != 0)
      return fails(header.tag, at_, fmt::format("has a fragment of odd length, {}", item.length));
    if (++objects_ > most_objects_) return fails(header.tag, at_, "has too many fragments");
    if (is_table) {
      fragments.table = item.value;
      fragments.table_bytes = item.length;
      fragments.begin = item.end();
    } else if (item.length > 0 && fragments.count++ == 0) {
      fragments.first = item.value;
      fragments.first_bytes = item.length;
    }
    at_ = item.end();
  }
}

}  // namespace tidemark::imaging
