#include "tests/imaging/dicom/dicom_bytes.h"

#include <zlib.h>

#include <fstream>

#include <algorithm>
#include <cstring>
#include <string_view>

namespace tidemark::test {
namespace {

constexpr std::string_view kLongLength = "OB OD OF OL OV OW SQ SV UC UN UR UT UV ZZ";

std::string tag_bytes(std::uint32_t tag, Coding coding) {
  return word(tag >> 16, coding) + word(tag & 0xffff, coding);
}

}  // namespace

std::string word(std::uint32_t value, Coding coding) {
  std::string bytes{static_cast<char>(value & 0xff), static_cast<char>(value >> 8 & 0xff)};
  if (coding.is_big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string long_word(std::uint32_t value, Coding coding) {
  const std::string low = word(value & 0xffff, coding);
  const std::string high = word(value >> 16, coding);
  return coding.is_big_endian ? high + low : low + high;
}

std::string element(std::uint32_t tag, const char* vr, const std::string& value, Coding coding,
                    std::optional<std::uint32_t> length) {
  const std::uint32_t stated = length.value_or(static_cast<std::uint32_t>(value.size()));
  const std::string start = tag_bytes(tag, coding);
  if (!coding.is_explicit) return start + long_word(stated, coding) + value;
  const bool has_long_length = kLongLength.find(vr) != std::string_view::npos;
  const std::string stated_length =
      has_long_length ? std::string(2, '\0') + long_word(stated, coding) : word(stated, coding);
  return start + vr + stated_length + value;
}

std::string text(std::uint32_t tag, const char* vr, std::string value, Coding coding) {
  if (value.size() % 2 != 0) value.push_back(std::strcmp(vr, "UI") == 0 ? '\0' : ' ');
  return element(tag, vr, value, coding);
}

std::string number(std::uint32_t tag, std::uint32_t value, Coding coding) {
  return element(tag, "US", word(value, coding), coding);
}

std::string item(const std::string& value, Coding coding, std::optional<std::uint32_t> length) {
  return tag_bytes(0xfffee000, coding) +
         long_word(length.value_or(static_cast<std::uint32_t>(value.size())), coding) + value;
}

std::string item_end(Coding coding) {
  return tag_bytes(0xfffee00d, coding) + long_word(0);
}

std::string sequence_end(Coding coding) {
  return tag_bytes(0xfffee0dd, coding) + long_word(0);
}

std::string encapsulated(const std::string& frame, const std::string& table) {
  return element(kPixels, "OB", item(table) + item(frame) + sequence_end(), kExplicit, kUndefinedLength);
}

std::string nested(int depth, const char* vr, Coding coding, bool has_lengths) {
  constexpr std::uint32_t kReferencedImages = 0x00081140;
  // Within UN everything is implicit little endian.
  const Coding inner = std::string_view(vr) == "UN" ? kImplicit : coding;
  // Built from both ends, since putting one string into the next takes time that grows with its square.
  const auto header_bytes = [](Coding c) { return c.is_explicit ? 12U : 8U; };
  std::string start;
  std::string end;
  std::uint32_t left = 0;  // bytes within, when lengths are stated
  for (int k = 1; k < depth; ++k) left += header_bytes(inner) + 8;
  for (int k = 0; k < depth; ++k) {
    const Coding own = k == 0 ? coding : inner;
    start += element(kReferencedImages, vr, {}, own, has_lengths ? left + 8 : kUndefinedLength);
    start += item({}, inner, has_lengths ? left : kUndefinedLength);
    left -= k + 1 < depth ? header_bytes(inner) + 8 : 0;
    if (!has_lengths) end += item_end(inner) + sequence_end(inner);
  }
  return start + end;
}

Dataset Dataset::slice(Coding coding) {
  Dataset slice(coding);
  slice.put_text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2");
  slice.put_text(0x00080018, "UI", "2.25.1").put_text(0x00080060, "CS", "CT");
  slice.put_text(0x0020000d, "UI", "2.25.2").put_text(0x0020000e, "UI", "2.25.3");
  slice.put_text(0x00200032, "DS", "0\\0\\0").put_text(0x00200037, "DS", "1\\0\\0\\0\\1\\0");
  slice.put_number(0x00280002, 1).put_text(0x00280004, "CS", "MONOCHROME2");
  slice.put_number(0x00280010, 3).put_number(0x00280011, 4).put_text(0x00280030, "DS", "1\\1");
  slice.put_number(0x00280100, 16).put_number(0x00280101, 16).put_number(0x00280102, 15);
  slice.put_number(0x00280103, 0);
  std::string pixels;
  for (std::uint32_t value = 0; value < 12; ++value) pixels += word(100 * value, coding);
  return slice.put(kPixels, element(kPixels, "OW", pixels, coding));
}

Dataset& Dataset::put(std::uint32_t tag, std::string encoded) {
  elements_[tag] = std::move(encoded);
  return *this;
}

Dataset& Dataset::put_text(std::uint32_t tag, const char* vr, const std::string& value) {
  return put(tag, text(tag, vr, value, coding_));
}

Dataset& Dataset::put_number(std::uint32_t tag, std::uint32_t value) {
  return put(tag, number(tag, value, coding_));
}

Dataset& Dataset::remove(std::uint32_t tag) {
  elements_.erase(tag);
  return *this;
}

std::string Dataset::bytes() const {
  std::string bytes;
  for (const auto& [tag, encoded] : elements_) bytes += encoded;
  return bytes;
}

std::string meta(const std::string& transfer_syntax, std::optional<std::uint32_t> group_length) {
  const std::string rest = element(0x00020001, "OB", std::string("\0\1", 2)) +
                           text(0x00020002, "UI", "1.2.840.10008.5.1.4.1.1.2") +
                           text(0x00020003, "UI", "2.25.1") + text(0x00020010, "UI", transfer_syntax);
  const auto length = group_length.value_or(static_cast<std::uint32_t>(rest.size()));
  return element(0x00020000, "UL", long_word(length)) + rest;
}

std::string preamble() {
  return std::string(128, '\0') + "DICM";
}

std::string file(const std::string& transfer_syntax, const std::string& dataset) {
  return preamble() + meta(transfer_syntax) + dataset;
}

std::string file(const Dataset& dataset) {
  const Coding coding = dataset.coding();
  const char* const syntax = coding.is_big_endian ? "1.2.840.10008.1.2.2"
                             : coding.is_explicit ? "1.2.840.10008.1.2.1"
                                                  : "1.2.840.10008.1.2";
  return file(syntax, dataset.bytes());
}

void write_bytes(const std::filesystem::path& target, const std::string& bytes) {
  std::ofstream(target, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string deflated(const std::string& bytes) {
  z_stream stream{};
  deflateInit2(&stream, 1, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(packed.size() - stream.avail_out);
  deflateEnd(&stream);
  return packed;
}

}  // namespace tidemark::test
