// DICOM files byte by byte, so that a test can write what no library would.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace tidemark::test {

// How elements are written: explicit little endian unless it says otherwise.
struct Coding {
  bool is_explicit = true;
  bool is_big_endian = false;
};
inline constexpr Coding kExplicit{true, false};
inline constexpr Coding kImplicit{false, false};
inline constexpr Coding kBigEndian{true, true};

inline constexpr std::uint32_t kUndefinedLength = 0xffffffff;
inline constexpr std::uint32_t kPixels = 0x7fe00010;

std::string word(std::uint32_t value, Coding coding = kExplicit);
std::string long_word(std::uint32_t value, Coding coding = kExplicit);

// A tag as 0xggggeeee, its representation (not written when implicit), its length (the value's unless stated)
// and its value as it is.
std::string element(std::uint32_t tag, const char* vr, const std::string& value, Coding coding = kExplicit,
                    std::optional<std::uint32_t> length = {});
// Padded to an even length.
std::string text(std::uint32_t tag, const char* vr, std::string value, Coding coding = kExplicit);
std::string number(std::uint32_t tag, std::uint32_t value, Coding coding = kExplicit);  // US

// Item, ItemDelimitationItem and SequenceDelimitationItem.
std::string item(const std::string& value, Coding coding = kExplicit,
                 std::optional<std::uint32_t> length = {});
std::string item_end(Coding coding = kExplicit);
std::string sequence_end(Coding coding = kExplicit);

// An offset table (empty) and one fragment, with PixelData's tag before and the delimiter after them.
std::string encapsulated(const std::string& frame, const std::string& table = {});
// Sequences one within another, the innermost with an empty item.
std::string nested(int depth, const char* vr, Coding coding, bool has_lengths);

// The elements of a dataset in order.
class Dataset {
 public:
  explicit Dataset(Coding coding = kExplicit) : coding_(coding) {}
  // A slice of 4 x 3 pixels of 16 bits, whole and well.
  static Dataset slice(Coding coding = kExplicit);

  Dataset& put(std::uint32_t tag, std::string encoded);  // tag and all
  Dataset& put_text(std::uint32_t tag, const char* vr, const std::string& value);
  Dataset& put_number(std::uint32_t tag, std::uint32_t value);
  Dataset& remove(std::uint32_t tag);
  [[nodiscard]] Coding coding() const { return coding_; }
  [[nodiscard]] std::string bytes() const;

 private:
  Coding coding_;
  std::map<std::uint32_t, std::string> elements_;
};

// The begin of a DICOM file (PS3.10, section 7.1).
std::string preamble();
// Group 0002 with that transfer syntax, its group length as it is unless stated.
std::string meta(const std::string& transfer_syntax, std::optional<std::uint32_t> group_length = {});
// Preamble, meta and dataset.
std::string file(const std::string& transfer_syntax, const std::string& dataset);
std::string file(const Dataset& dataset);  // in the native syntax of its coding

void write_bytes(const std::filesystem::path& target, const std::string& bytes);

// A raw deflate stream.
std::string deflated(const std::string& bytes);

}  // namespace tidemark::test
