#include "document/packed_bytes.h"

#include <zlib.h>

#include "core/base64.h"
#include "core/deflate_ratio.h"

namespace tidemark::document {

std::string pack_bytes(std::span<const std::byte> bytes) {
  uLongf length = compressBound(bytes.size());
  std::string deflated(length, '\0');
  // Fails only without memory, or room, of which there is enough.
  const int result = compress2(reinterpret_cast<Bytef*>(deflated.data()), &length,
                               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), Z_BEST_SPEED);
  deflated.resize(result == Z_OK ? length : 0);
  return to_base64(deflated);
}

std::optional<std::vector<std::byte>> unpack_bytes(std::string_view text, std::size_t size) {
  const auto deflated = from_base64(text);
  if (!deflated || size / kBestDeflateRatio > deflated->size()) return std::nullopt;
  std::vector<std::byte> bytes(size);
  uLongf length = size;
  uLong used = deflated->size();
  const int result = uncompress2(reinterpret_cast<Bytef*>(bytes.data()), &length,
                                 reinterpret_cast<const Bytef*>(deflated->data()), &used);
  if (result != Z_OK || length != size || used != deflated->size()) return std::nullopt;
  return bytes;
}

std::optional<BitMask> unpack_mask(std::string_view text, const Geometry& grid) {
  const auto bits = unpack_bytes(text, BitMask::bytes_of(grid));
  return bits ? std::optional<BitMask>(BitMask(grid, *bits)) : std::nullopt;
}

}  // namespace tidemark::document
