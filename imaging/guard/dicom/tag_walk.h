// A walk over the tags of a DICOM dataset that takes nothing on trust and no memory: what it lets pass can be
// given to a parser that recurses into sequences and believes lengths.
//
// It does not know the data dictionary. Where only the dictionary knows whether an element holds a sequence
// (implicit value representation, UN), the bytes of the value decide: a value that begins as an item is
// walked as one.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "imaging/guard/byte_source.h"

namespace tidemark::imaging {

struct DicomTag {
  std::uint16_t group = 0;
  std::uint16_t element = 0;

  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 takes the comparison for one
  auto operator<=>(const DicomTag&) const = default;
};
inline constexpr DicomTag kPixelData{0x7fe0, 0x0010};

// The encoding of a dataset's elements.
struct ElementCoding {
  bool is_explicit = true;
  bool is_big_endian = false;

  // In the header, because every pixel of an image is read by them.
  [[nodiscard]] std::uint16_t word(const std::uint8_t* bytes) const {
    return static_cast<std::uint16_t>(is_big_endian ? bytes[0] << 8 | bytes[1] : bytes[1] << 8 | bytes[0]);
  }
  [[nodiscard]] std::uint32_t long_word(const std::uint8_t* bytes) const {
    const std::uint32_t first = word(bytes);
    const std::uint32_t second = word(bytes + 2);
    return is_big_endian ? first << 16 | second : second << 16 | first;
  }
};

struct ElementHeader {
  static constexpr std::uint32_t kUndefined = 0xffffffff;

  DicomTag tag;
  std::array<char, 2> representation{};  // zeros in implicit coding and of delimiters
  std::int64_t begin = 0;                // offset of the tag
  std::int64_t value = 0;                // offset of the value
  std::uint32_t length = 0;

  [[nodiscard]] bool is(std::string_view vr) const {
    return std::string_view(representation.data(), 2) == vr;
  }
  [[nodiscard]] bool is_undefined() const { return length == kUndefined; }
  [[nodiscard]] std::int64_t end() const { return value + length; }
};

// Compressed pixels: an offset table and fragments.
struct Fragments {
  std::int64_t table = 0;  // offset of the table's first entry
  std::uint32_t table_bytes = 0;
  std::int64_t first = 0;  // offset of the first fragment's bytes
  std::uint32_t first_bytes = 0;
  std::int64_t count = 0;  // of those that are not empty
  std::int64_t begin = 0;  // offset of the first fragment's item; entries of the table count from here
  std::int64_t end = 0;    // offset of the delimiter
};

// The place of an element.
struct TagPlace {
  DicomTag sequence;      // in an item of this one; (0000,0000) in the dataset itself
  std::int64_t item = 0;  // offset of what is in that item
  int depth = 0;          // 0 in the dataset itself, 1 in an item of a sequence in it
};

// The damage, and its place.
struct TagDamage {
  DicomTag tag;
  std::int64_t offset = 0;
  std::string what;
};

class TagWalk {
 public:
  // Sequences within sequences. Far above anything in use, and far below what a recursive parser's stack
  // holds.
  static constexpr int kDeepest = 64;
  // Values of one SpecificCharacterSet (0008,0005): there are some twenty character sets (PS3.3 C.12.1.1.2).
  static constexpr int kMostCharacterSets = 32;
  // Values of all of them in a file, of which each item of a sequence may have its own.
  static constexpr std::int64_t kMostCharacterSetsOfAll = 4096;

  // Called for each element of the dataset itself (not of its sequences), before its value is passed. The
  // reader may be moved within the value. Fragments are null unless the element has some.
  using Visitor = std::function<void(const ElementHeader&, ByteReader&, const Fragments*)>;

  // Called for each element wherever it stands, and for each sequence before what is in it, but not for
  // compressed pixels. False ends the walk, which then fails.
  using Observer = std::function<bool(const ElementHeader&, ByteReader&, const TagPlace&)>;

  // `most_bytes`: how many bytes a parser that makes objects of the tags may take for them.
  TagWalk(ByteSource& source, std::int64_t most_bytes);

  // The file meta information that begins at `begin`, in explicit little endian (PS3.10 7.1). Returns where
  // the dataset begins.
  tl::expected<std::int64_t, TagDamage> walk_meta(std::int64_t begin, const Visitor& visit);
  // From `begin` to the end of the source. `has_fragments`: whether PixelData is to be compressed.
  tl::expected<void, TagDamage> walk_dataset(std::int64_t begin, ElementCoding coding, bool has_fragments,
                                             const Visitor& visit, const Observer& observe = {});

 private:
  // A dataset, an item, or a sequence, that has been entered and not left.
  struct Level {
    std::int64_t begin = 0;
    std::int64_t end = 0;  // or the end of the level around it, when a delimiter ends it
    ElementCoding coding;
    DicomTag tag{};       // of the sequence
    DicomTag previous{};  // element in it
    std::int64_t elements = 0;
    std::int64_t creators = 0;  // of private elements
    bool is_sequence = false;
    bool is_delimited = false;
  };

  bool read_header(std::int64_t at, std::int64_t end, ElementCoding coding, ElementHeader& header);
  bool check_character_sets(const ElementHeader& header);
  bool check_length(const ElementHeader& header, std::int64_t end);
  bool check_meta(const ElementHeader& header);
  bool read_representation(const std::uint8_t* bytes, ElementHeader& header, bool& has_long_length);
  bool step_item();
  bool step_element(bool has_fragments, const Visitor& visit, const Observer& observe);
  bool show(const ElementHeader& header, const Observer& observe);
  bool step_delimiter(const ElementHeader& header);
  bool enter(const Level& level, const ElementHeader& header);
  bool enter_sequence(const ElementHeader& header, bool is_implicit);
  bool pass_fragments(const ElementHeader& header, Fragments& fragments);
  bool begins_as_item(const ElementHeader& header);
  bool count(Level& level, const ElementHeader& header);
  bool fails(DicomTag tag, std::int64_t offset, std::string what);
  Level& top() { return levels_[static_cast<std::size_t>(depth_)]; }

  ByteReader reader_;
  std::int64_t most_objects_;
  std::int64_t objects_ = 0;
  std::int64_t searches_ = 0;
  std::int64_t character_sets_ = 0;  // in all items together
  std::int64_t at_ = 0;
  int depth_ = 0;
  std::array<Level, 2 * kDeepest + 1> levels_{};  // a dataset, then a sequence and an item by turns
  TagDamage damage_;
};

}  // namespace tidemark::imaging
