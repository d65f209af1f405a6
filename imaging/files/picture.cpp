#include "imaging/files/picture.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "core/checked.h"
#include "imaging/guard/pixel_layout.h"
#include "imaging/guard/spacing.h"

namespace tidemark::imaging::files {
namespace {

constexpr double kMmPerInch = 25.4;
// Pictures that cost no more than 64 MiB as float may have any number of pixels a byte.
constexpr std::int64_t kFewPixels = std::int64_t{1} << 24;

// 72 and 96 dots per inch are what programs write for a screen; nobody measured them.
bool is_of_screen(double pixels_per_mm) {
  const double dpi = pixels_per_mm * kMmPerInch;
  return std::abs(dpi - 72.0) < 0.3 || std::abs(dpi - 96.0) < 0.3;
}

bool is_turned(const PictureHeader& header) {
  return header.orientation >= 5;
}

// The upright place of a stored pixel (TIFF 6.0, Orientation).
struct Upright {
  std::int64_t columns;  // as stored
  std::int64_t rows;
  int orientation;

  [[nodiscard]] glm::vec<2, std::int64_t> place(std::int64_t x, std::int64_t y) const {
    const std::int64_t back_x = columns - 1 - x;
    const std::int64_t back_y = rows - 1 - y;
    switch (orientation) {
      case 2:
        return {back_x, y};
      case 3:
        return {back_x, back_y};
      case 4:
        return {x, back_y};
      case 5:
        return {y, x};
      case 6:
        return {back_y, x};
      case 7:
        return {back_y, back_x};
      case 8:
        return {y, back_x};
      default:
        return {x, y};
    }
  }
};

// Sizes and spacing, with the sentences about them.
Geometry place(PictureHeader& header) {
  Geometry geometry;
  geometry.oriented = false;
  geometry.size = {header.columns, header.rows, header.pages};
  const glm::dvec2 resolution = header.pixels_per_mm;
  const glm::dvec2 spacing = 1.0 / resolution;
  if (is_of_screen(resolution.x) && is_of_screen(resolution.y)) {
    header.warnings.push_back(fmt::format(
        "its {:.0f} dots per inch are a screen's and say nothing about the object: a pixel counts as 1 mm",
        resolution.x * kMmPerInch));
  } else if (is_sensible_spacing(spacing.x) && is_sensible_spacing(spacing.y)) {
    geometry.spacing_mm = {spacing.x, spacing.y, 1.0};
    header.changes.push_back(
        fmt::format("its resolution makes pixels of {:.6g} x {:.6g} mm", spacing.x, spacing.y));
  } else {
    header.warnings.emplace_back("the picture does not say how large its pixels are: a pixel counts as 1 mm");
  }
  header.changes.push_back(
      header.pages == 1 ? std::string("a picture is a volume of one slice, which counts as 1 mm thick")
                        : fmt::format("the {} pages are slices, which count as 1 mm apart", header.pages));
  if (is_turned(header)) {
    std::swap(geometry.size.x, geometry.size.y);
    std::swap(geometry.spacing_mm.x, geometry.spacing_mm.y);
  }
  return geometry;
}

// The type of the volume that holds every value as it is stored.
const char* scalar_of(const PictureHeader& header) {
  switch (header.scalar) {
    case Scalar::uint8:
    case Scalar::int8:
    case Scalar::int16:
      return "int16";
    case Scalar::uint16:
      return "uint16";
    default:
      return "float";
  }
}

void describe(PictureHeader& header) {
  if (header.channels == 3) {
    header.changes.emplace_back(
        "colours became their luminance (Rec. 709: 0.2126 red, 0.7152 green, 0.0722 blue of the stored "
        "values)");
  }
  if (header.has_opacity) header.changes.emplace_back("its opacity is ignored");
  if (header.orientation != 1) {
    header.changes.push_back(
        fmt::format("turned upright, as Orientation {} in the file says", header.orientation));
  }
  if (header.scalar == Scalar::int32 || header.scalar == Scalar::uint32) {
    header.changes.push_back(fmt::format("{} values converted to float", name_of(header.scalar)));
  }
  header.warnings.emplace_back("a picture does not say how its axes lie in the patient");
}

Result<std::unique_ptr<Picture>> open_picture(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) {
    return fail(ErrorKind::input, "{}: not a regular file", file.string());
  }
  auto bytes = FileBytes::open(file);
  if (!bytes) return pass_on(bytes);
  switch (*picture_format_of(file)) {
    case PictureFormat::png:
      return open_png(std::move(*bytes), file);
    case PictureFormat::jpeg:
      return open_jpeg(std::move(*bytes), file);
    case PictureFormat::tiff:
      return open_tiff(std::move(*bytes), file);
  }
  return fail(ErrorKind::internal, "{}: unknown format", file.string());
}

// Whole numbers weigh in whole numbers, so that a grey of three equal channels is that grey.
double luminance(const float* colour, bool is_whole) {
  const double weighed = 2126.0 * static_cast<double>(colour[0]) + 7152.0 * static_cast<double>(colour[1]) +
                         722.0 * static_cast<double>(colour[2]);
  return is_whole ? std::round(weighed / 10000.0) : weighed / 10000.0;
}

template <class Voxel>
Status read_as(Picture& picture, const Geometry& geometry, Volume& volume, const Progress& progress) {
  const PictureHeader& header = picture.header();
  std::vector<Voxel> voxels(static_cast<std::size_t>(geometry.voxel_count()));
  const Upright upright{header.columns, header.rows, header.orientation};
  const auto sink = [&](std::int64_t page, std::int64_t row, std::span<const float> samples) {
    for (std::int64_t x = 0; x < header.columns; ++x) {
      const float* sample = samples.data() + x * header.channels;
      const auto at = upright.place(x, row);
      voxels[static_cast<std::size_t>(geometry.offset({at.x, at.y, page}))] =
          static_cast<Voxel>(header.channels == 1 ? *sample : luminance(sample, std::is_integral_v<Voxel>));
    }
  };
  TIDEMARK_TRY(picture.read(sink, progress));
  volume.voxels = std::move(voxels);
  return {};
}

}  // namespace

std::optional<PictureFormat> picture_format_of(const std::filesystem::path& file) {
  if (has_suffix(file, ".png")) return PictureFormat::png;
  if (has_suffix(file, ".jpg") || has_suffix(file, ".jpeg")) return PictureFormat::jpeg;
  if (has_suffix(file, ".tif") || has_suffix(file, ".tiff")) return PictureFormat::tiff;
  return std::nullopt;
}

Status require_held(const PictureHeader& header, std::int64_t most_per_byte, std::int64_t file_bytes,
                    const std::string& field, const std::filesystem::path& file) {
  const auto pixels = checked_product(header.columns, header.rows, header.pages);
  if (pixels && *pixels == 0) {
    return fail(ErrorKind::input, "{}: {}: {} x {} pixels make no picture", file.string(), field,
                header.columns, header.rows);
  }
  if (pixels && (*pixels <= kFewPixels || *pixels / most_per_byte <= file_bytes)) return {};
  const std::string pages = header.pages == 1 ? "" : fmt::format(" on {} pages", header.pages);
  return fail(ErrorKind::input, "{}: {}: {} x {} pixels{} are more than its {} bytes can hold", file.string(),
              field, header.columns, header.rows, pages, file_bytes);
}

Series scan_picture(const std::filesystem::path& file) {
  Series series;
  series.uid = file.filename().string();
  series.description = series.uid;
  series.files = {file};
  const auto picture = open_picture(file);
  if (!picture) {
    series.reason = picture.error().message;
    return series;
  }
  PictureHeader header = (*picture)->header();
  describe(header);
  series.geometry = place(header);
  series.scalar = scalar_of(header);
  series.loadable = true;
  series.changes = std::move(header.changes);
  series.warnings = std::move(header.warnings);
  return series;
}

Result<Volume> read_picture(const std::filesystem::path& file, const Progress& progress) {
  progress(0.0, "reading the picture");
  const auto picture = open_picture(file);
  if (!picture) return pass_on(picture);
  PictureHeader header = (*picture)->header();
  describe(header);
  Volume volume;
  volume.geometry = place(header);
  const std::string scalar = scalar_of(header);
  try {
    TIDEMARK_TRY(scalar == "int16"    ? read_as<std::int16_t>(**picture, volume.geometry, volume, progress)
                 : scalar == "uint16" ? read_as<std::uint16_t>(**picture, volume.geometry, volume, progress)
                                      : read_as<float>(**picture, volume.geometry, volume, progress));
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::capability, "{}: not enough memory for {} pixels", file.string(),
                volume.geometry.voxel_count());
  }
  volume.description = file.filename().string();
  volume.changes = std::move(header.changes);
  const auto remarks = (*picture)->remarks();
  volume.changes.insert(volume.changes.end(), header.warnings.begin(), header.warnings.end());
  volume.changes.insert(volume.changes.end(), remarks.begin(), remarks.end());
  TIDEMARK_TRY(require_finite(volume, file.string()));
  progress(1.0, "reading the picture");
  return volume;
}

}  // namespace tidemark::imaging::files
