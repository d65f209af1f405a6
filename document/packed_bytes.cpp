#include "document/packed_bytes.h"

#include <zlib.h>

#include <array>
#include <cstdint>
#include <limits>

namespace tidemark::document {
namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string to_base64(const std::vector<unsigned char>& bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = std::uint32_t{bytes[i]} << 16U;
    if (i + 1 < bytes.size()) group |= std::uint32_t{bytes[i + 1]} << 8U;
    if (i + 2 < bytes.size()) group |= bytes[i + 2];
    for (std::size_t digit = 0; digit < 4; ++digit) {
      text += i + digit > bytes.size() ? '=' : kDigits[group >> (18U - 6U * digit) & 63U];
    }
  }
  return text;
}

std::optional<std::vector<unsigned char>> from_base64(std::string_view text) {
  if (text.size() % 4 != 0) return std::nullopt;
  std::array<int, 256> value{};
  value.fill(-1);
  for (std::size_t i = 0; i < kDigits.size(); ++i) {
    value[static_cast<unsigned char>(kDigits[i])] = static_cast<int>(i);
  }
  std::size_t padding = 0;
  while (padding < 2 && padding < text.size() && text[text.size() - 1 - padding] == '=') ++padding;
  std::vector<unsigned char> bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (std::size_t i = 0; i < text.size(); i += 4) {
    std::uint32_t group = 0;
    for (std::size_t digit = 0; digit < 4; ++digit) {
      const bool pad = i + digit >= text.size() - padding;
      const int one = pad ? 0 : value[static_cast<unsigned char>(text[i + digit])];
      if (one < 0) return std::nullopt;
      group = group << 6U | static_cast<std::uint32_t>(one);
    }
    for (int shift = 16; shift >= 0; shift -= 8) bytes.push_back(static_cast<unsigned char>(group >> shift));
  }
  bytes.resize(bytes.size() - padding);
  return bytes;
}

}  // namespace

std::string pack_bytes(std::span<const std::byte> bytes) {
  uLongf length = compressBound(bytes.size());
  std::vector<unsigned char> deflated(length);
  // Fails only without memory, or room, of which there is enough.
  const int result = compress2(deflated.data(), &length, reinterpret_cast<const Bytef*>(bytes.data()),
                               bytes.size(), Z_BEST_SPEED);
  deflated.resize(result == Z_OK ? length : 0);
  return to_base64(deflated);
}

std::optional<std::vector<std::byte>> unpack_bytes(std::string_view text, std::size_t size) {
  constexpr std::size_t kMostPerByte = 1032;
  const auto deflated = from_base64(text);
  if (!deflated || size / kMostPerByte > deflated->size()) return std::nullopt;
  std::vector<std::byte> bytes(size);
  uLongf length = size;
  uLong used = deflated->size();
  const int result = uncompress2(reinterpret_cast<Bytef*>(bytes.data()), &length, deflated->data(), &used);
  if (result != Z_OK || length != size || used != deflated->size()) return std::nullopt;
  return bytes;
}

std::string pack_bits(std::span<const std::uint8_t> values) {
  std::vector<std::byte> bits((values.size() + 7) / 8);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] != 0) bits[i / 8] |= std::byte{1} << (i % 8);
  }
  return pack_bytes(bits);
}

std::optional<std::vector<std::uint8_t>> unpack_bits(std::string_view text, std::size_t count) {
  const auto bits = unpack_bytes(text, (count + 7) / 8);
  if (!bits) return std::nullopt;
  std::vector<std::uint8_t> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = ((*bits)[i / 8] >> (i % 8) & std::byte{1}) != std::byte{0} ? 1 : 0;
  }
  return values;
}

}  // namespace tidemark::document
