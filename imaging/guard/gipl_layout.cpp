// The GIPL header (Guy's Image Processing Lab): 256 bytes, big endian, the magic number at its end.
#include <bit>

#include "imaging/guard/pixel_layout.h"

namespace tidemark::imaging::files {
namespace {

constexpr std::size_t kGiplHeaderSize = 256;

std::uint32_t big_endian(const std::string& bytes, std::size_t offset, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8 | static_cast<unsigned char>(bytes[offset + i]);
  return value;
}

std::optional<Scalar> scalar_of(std::uint32_t type) {
  switch (type) {
    case 7:
      return Scalar::int8;
    case 8:
      return Scalar::uint8;
    case 15:
      return Scalar::int16;
    case 16:
      return Scalar::uint16;
    case 31:
      return Scalar::uint32;
    case 32:
      return Scalar::int32;
    case 64:
      return Scalar::float32;
    case 65:
      return Scalar::float64;
    default:
      return std::nullopt;
  }
}

}  // namespace

Result<PixelLayout> locate_gipl(const std::filesystem::path& file) {
  const std::string name = file.string();
  const auto header = read_start(file, kGiplHeaderSize);
  if (!header) return pass_on(header);
  if (header->size() < kGiplHeaderSize) {
    return fail(ErrorKind::input, "{}: not a GIPL file: {} bytes are too few for its header", name,
                header->size());
  }
  const std::uint32_t magic = big_endian(*header, 252, 4);
  if (magic != 0xEFFFE9B0U && magic != 0x2AE389B8U) {
    return fail(ErrorKind::input, "{}: not a GIPL file: its header has no magic number", name);
  }
  const std::uint32_t type = big_endian(*header, 8, 2);
  const auto scalar = scalar_of(type);
  if (!scalar) return fail(ErrorKind::input, "{}: image type {} is not supported", name, type);
  const auto size = [&](std::size_t axis) { return big_endian(*header, 2 * axis, 2); };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (size(axis) == 0) return fail(ErrorKind::input, "{}: dim[{}] is 0", name, axis);
  }
  const std::int64_t voxels = std::int64_t{size(0)} * size(1) * size(2);  // below 2^48
  if (size(3) > 1) return fail(ErrorKind::input, "{}: dim[3] is {}: not one volume", name, size(3));

  PixelLayout layout{.file = file,
                     .voxels = voxels,
                     .bytes = voxels * bytes_of(*scalar),
                     .scalar = *scalar,
                     .oriented = false};
  layout.swapped = std::endian::native == std::endian::little;
  layout.coding = is_gzip(file) ? Coding::deflate : Coding::raw;
  (layout.coding == Coding::deflate ? layout.prefix : layout.offset) = kGiplHeaderSize;
  return layout;
}

}  // namespace tidemark::imaging::files
