// The NIfTI-1 header: 348 bytes, https://nifti.nimh.nih.gov/nifti-1 (nifti1.h).
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <string_view>

#include "core/checked.h"
#include "imaging/guard/pixel_layout.h"

namespace tidemark::imaging::files {
namespace {

constexpr std::size_t kNiftiHeaderSize = 348;
constexpr std::int32_t kNifti2HeaderSize = 540;
constexpr std::int64_t kFirstVoxel = 352;

// The numbers of a header that outlives it, in either byte order.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {
    const auto size = read<std::int32_t>(0);
    swapped_ = size != static_cast<std::int32_t>(kNiftiHeaderSize) && size != kNifti2HeaderSize;
  }

  template <class T>
  [[nodiscard]] T read(std::size_t offset) const {
    char field[sizeof(T)];
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      field[i] = bytes_[offset + (swapped_ ? sizeof(T) - 1 - i : i)];
    }
    return std::bit_cast<T>(field);
  }
  [[nodiscard]] std::int64_t dim(int i) const {
    return read<std::int16_t>(40 + 2 * static_cast<std::size_t>(i));
  }
  [[nodiscard]] std::int32_t size_field() const { return read<std::int32_t>(0); }
  [[nodiscard]] bool swapped() const { return swapped_; }
  [[nodiscard]] std::string_view magic() const { return bytes_.substr(344, 3); }

 private:
  std::string_view bytes_;
  bool swapped_ = false;
};

// By NIfTI's datatype code; nothing for RGB, complex and unknown ones.
std::optional<Scalar> scalar_of(int datatype) {
  switch (datatype) {
    case 2:
      return Scalar::uint8;
    case 4:
      return Scalar::int16;
    case 8:
      return Scalar::int32;
    case 16:
      return Scalar::float32;
    case 64:
      return Scalar::float64;
    case 256:
      return Scalar::int8;
    case 512:
      return Scalar::uint16;
    case 768:
      return Scalar::uint32;
    case 1024:
      return Scalar::int64;
    case 1280:
      return Scalar::uint64;
    default:
      return std::nullopt;
  }
}

Result<std::int64_t> count_voxels(const Fields& header, const std::string& name) {
  const std::int64_t dimensions = header.dim(0);
  if (dimensions < 1 || dimensions > 7) {
    return fail(ErrorKind::input, "{}: dim[0] is {}: not a NIfTI file, or a damaged one", name, dimensions);
  }
  std::int64_t voxels = 1;
  for (int i = 1; i <= dimensions; ++i) {
    if (header.dim(i) < 1) return fail(ErrorKind::input, "{}: dim[{}] is {}", name, i, header.dim(i));
    const auto product = checked_product(voxels, header.dim(i));
    if (!product) return fail(ErrorKind::input, "{}: dim: too many voxels", name);
    voxels = *product;
  }
  return voxels;
}

// Beyond these a length is damage, not anatomy; ITK's decomposition of the sform does not end on some of
// them.
constexpr double kLongest = 1e6;    // mm
constexpr double kShortest = 1e-6;  // mm

bool is_length(double mm) {
  return std::abs(mm) >= kShortest && std::abs(mm) <= kLongest;  // NaN is none
}

// The sform's axes, in mm a voxel.
glm::dmat3 sform_axes(const Fields& header) {
  glm::dmat3 axes;
  for (int row = 0; row < 3; ++row) {
    for (int axis = 0; axis < 3; ++axis) {
      axes[axis][row] = header.read<float>(280 + static_cast<std::size_t>(16 * row + 4 * axis));
    }
  }
  return axes;
}

Status check_sform(const Fields& header, const std::string& name) {
  const glm::dmat3 axes = sform_axes(header);
  double volume = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double length = glm::length(axes[axis]);
    if (!is_length(length)) {
      return fail(ErrorKind::input, "{}: sform: the direction of axis {} has a length of {} mm", name, axis,
                  length);
    }
    volume *= length;
  }
  constexpr double kFlat = 1e-3;
  if (std::abs(glm::determinant(axes)) >= kFlat * volume) return {};
  return fail(ErrorKind::input, "{}: sform: the directions of its axes lie in one plane", name);
}

// pixdim, the quaternion and offsets of the qform and the rows of the sform, where they are in use.
Status check_geometry(const Fields& header, const std::string& name) {
  for (std::size_t axis = 1; axis <= 3; ++axis) {
    const float spacing = header.read<float>(76 + 4 * axis);
    if (!is_length(spacing)) return fail(ErrorKind::input, "{}: pixdim[{}] is {}", name, axis, spacing);
  }
  const bool qform = header.read<std::int16_t>(252) > 0;
  const bool sform = header.read<std::int16_t>(254) > 0;
  for (std::size_t i = 0; i < 18; ++i) {
    const bool in_use = i < 6 ? qform : sform;
    const double number = header.read<float>(256 + 4 * i);
    const double largest = i < 3 ? 1.0 + 1e-3 : kLongest;  // a unit quaternion's parts
    if (in_use && !(std::abs(number) <= largest)) {
      return fail(ErrorKind::input, "{}: {}: the origin or direction is {}", name, i < 6 ? "qform" : "sform",
                  number);
    }
  }
  return sform ? check_sform(header, name) : Status();
}

// Of lengths, by the bits of xyzt_units that are about space; unknown ones are mm.
double nifti_unit_in_mm(const Fields& header) {
  constexpr unsigned kSpace = 7;
  switch (header.read<unsigned char>(123) & kSpace) {
    case 1:
      return 1e3;
    case 3:
      return 1e-3;
    default:
      return 1.0;
  }
}

// A qform's rotation, from its quaternion (nifti1.h, method 2), times spacing and qfac.
glm::dmat3 qform_axes(const Fields& header) {
  const double b = header.read<float>(256);
  const double c = header.read<float>(260);
  const double d = header.read<float>(264);
  const double a = std::sqrt(std::max(0.0, 1.0 - (b * b + c * c + d * d)));
  glm::dmat3 axes = glm::mat3_cast(glm::normalize(glm::dquat(a, b, c, d)));
  for (int axis = 0; axis < 3; ++axis) {
    axes[axis] *= std::abs(header.read<float>(80 + 4 * static_cast<std::size_t>(axis)));
  }
  if (header.read<float>(76) < 0.0F) axes[2] = -axes[2];
  return axes;
}

// qform and sform are two statements of one thing; a user should know when they contradict each other.
void compare_orientations(const Fields& header, PixelLayout& layout) {
  const bool qform = header.read<std::int16_t>(252) > 0;
  const bool sform = header.read<std::int16_t>(254) > 0;
  layout.oriented = qform || sform;
  if (!qform || !sform) return;
  const glm::dmat3 q_axes = qform_axes(header);
  const glm::dmat3 s_axes = sform_axes(header);
  double worst = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    glm::dvec3 voxel;
    for (int axis = 0; axis < 3; ++axis) {
      voxel[axis] = (corner >> axis & 1) != 0 ? static_cast<double>(header.dim(axis + 1) - 1) : 0.0;
    }
    const glm::dvec3 q = q_axes * voxel;
    const glm::dvec3 s = s_axes * voxel;
    for (std::size_t row = 0; row < 3; ++row) {
      const int r = static_cast<int>(row);
      const double q_offset = header.read<float>(268 + 4 * row);
      const double s_offset = header.read<float>(280 + 16 * row + 12);
      worst = std::max(worst, std::abs(q[r] + q_offset - s[r] - s_offset));
    }
  }
  worst *= nifti_unit_in_mm(header);
  if (worst > 0.1) {
    layout.warnings.push_back(fmt::format("qform and sform place voxels up to {:.1f} mm apart", worst));
  }
}

void take_nifti_unit(const Fields& header, PixelLayout& layout) {
  layout.origin_scale = nifti_unit_in_mm(header);
  if (layout.origin_scale == 1.0) return;
  const auto take = [&](std::size_t code, std::size_t offset, std::size_t step) {
    if (header.read<std::int16_t>(code) <= 0) return;
    const auto along = [&](std::size_t axis) -> double { return header.read<float>(offset + step * axis); };
    layout.origins.emplace_back(-along(0), -along(1), along(2));  // from RAS to LPS
  };
  take(252, 268, 4);        // the qform's
  take(254, 280 + 12, 16);  // the sform's
}

}  // namespace

Result<PixelLayout> locate_nifti(const std::filesystem::path& file) {
  const std::string name = file.string();
  auto start = read_start(file, kNiftiHeaderSize);
  if (!start) return pass_on(start);
  if (start->size() < kNiftiHeaderSize) {
    return fail(ErrorKind::input, "{}: not a NIfTI file: {} bytes are too few for its header", name,
                start->size());
  }
  const Fields header(*start);
  if (header.size_field() == kNifti2HeaderSize) {
    return fail(ErrorKind::input, "{}: sizeof_hdr is 540: NIfTI-2 is not supported", name);
  }
  if (header.size_field() != static_cast<std::int32_t>(kNiftiHeaderSize) && header.magic() == "n+1") {
    return fail(ErrorKind::input, "{}: sizeof_hdr is {}, not 348", name, header.size_field());
  }
  if (header.magic() != "n+1") {
    return fail(ErrorKind::input, "{}: not a NIfTI file: its header has no 'n+1' magic", name);
  }
  const auto voxels = count_voxels(header, name);
  if (!voxels) return pass_on(voxels);
  const int datatype = header.read<std::int16_t>(70);
  const auto scalar = scalar_of(datatype);
  if (!scalar) return fail(ErrorKind::input, "{}: datatype {} is not a scalar type", name, datatype);
  if (header.read<std::int16_t>(72) != 8 * bytes_of(*scalar)) {
    return fail(ErrorKind::input, "{}: bitpix is {}, but datatype {} has {} bits", name,
                header.read<std::int16_t>(72), datatype, 8 * bytes_of(*scalar));
  }
  const double offset = header.read<float>(108);
  if (!(offset >= static_cast<double>(kFirstVoxel) && offset < 1e9) || offset != std::floor(offset)) {
    return fail(ErrorKind::input, "{}: vox_offset is {}", name, offset);
  }
  if (std::isinf(header.read<float>(112)) || std::isinf(header.read<float>(116))) {
    return fail(ErrorKind::input, "{}: scl_slope or scl_inter is infinite", name);
  }
  TIDEMARK_TRY(check_geometry(header, name));
  const auto bytes = checked_product(*voxels, bytes_of(*scalar));
  if (!bytes) return fail(ErrorKind::input, "{}: dim: too many voxels", name);

  PixelLayout layout{.file = file, .voxels = *voxels, .bytes = *bytes};
  layout.coding = is_gzip(file) ? Coding::deflate : Coding::raw;
  (layout.coding == Coding::deflate ? layout.prefix : layout.offset) = static_cast<std::int64_t>(offset);
  // By the standard a slope of 0 means no scaling at all; NaN is written with the same meaning.
  const double slope = header.read<float>(112);
  const double intercept = header.read<float>(116);
  const bool scaled = slope != 0.0 && !std::isnan(slope);
  layout.scalar = *scalar;
  layout.swapped = header.swapped();
  layout.slope = scaled ? slope : 1.0;
  layout.intercept = scaled && !std::isnan(intercept) ? intercept : 0.0;
  take_nifti_unit(header, layout);
  compare_orientations(header, layout);
  return layout;
}

}  // namespace tidemark::imaging::files
