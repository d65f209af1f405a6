#include <algorithm>

#include "core/checked.h"
#include "imaging/guard/guarded.h"
#include "imaging/results/dicom_object.h"
#include "imaging/results/results.h"
#include "imaging/results/segmentation_file.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

// Two small frames can say that they lie far apart.
constexpr std::int64_t kMostEmpty = 4;  // voxels a pixel that there is
constexpr std::int64_t kSmall = std::int64_t{1} << 25;

Result<LoadedMap> empty_map(const Geometry& grid, std::size_t frames, const std::string& file) {
  const std::int64_t pixels = grid.size.x * grid.size.y * static_cast<std::int64_t>(frames);
  if (grid.voxel_count() > std::max(kMostEmpty * pixels, kSmall)) {
    return fail(ErrorKind::input, "{}: its {} frames leave most of {} slices empty", file, frames,
                grid.size.z);
  }
  const auto count = static_cast<std::size_t>(grid.voxel_count());
  LoadedMap map;
  map.volume.geometry = grid;
  map.volume.voxels = std::vector<float>(count);
  map.covered = std::vector<bool>(count);
  return map;
}

// Calls visit(voxel's offset, row, column) for each pixel of a frame; the grid holds them all.
template <class Visit>
Status visit_pixels(const SegmentFrame& frame, const Geometry& grid, const std::string& file, Visit&& visit) {
  const auto map = map_frame(frame, grid, file);
  if (!map) return pass_on(map);
  for (std::int64_t row = 0; row < frame.rows; ++row) {
    for (std::int64_t column = 0; column < frame.columns; ++column) {
      const Index3 voxel = map->first + column * map->column + row * map->row;
      if (!grid.contains(voxel)) return fail(ErrorKind::input, "{}: its frames lie beside each other", file);
      visit(static_cast<std::size_t>(grid.offset(voxel)), row, column);
    }
  }
  return {};
}

Result<LoadedMap> read_fractions(const fs::path& file) {
  SegmentationFile object(file);
  TIDEMARK_TRY(object.load());
  const auto grid = object.own_grid();
  if (!grid) return pass_on(grid);
  const auto& frames = object.frames().frames;
  auto map = empty_map(*grid, frames.size(), file.string());
  if (!map) return map;
  map->frame_of_reference_uid = object.frame_of_reference_uid();
  auto& values = std::get<std::vector<float>>(map->volume.voxels);
  for (std::size_t n = 0; n < frames.size(); ++n) {
    TIDEMARK_TRY(object.pixels().go_to(static_cast<std::int64_t>(n)));
    const auto take = [&](std::size_t offset, std::int64_t row, std::int64_t column) {
      const double part = object.pixels().value(row, column) / object.largest_value();
      values[offset] = std::max(values[offset], static_cast<float>(std::min(part, 1.0)));
      map->covered[offset] = true;
    };
    TIDEMARK_TRY(visit_pixels(frames[n], *grid, file.string(), take));
  }
  return map;
}

// The stored pixels of a parametric map: one of these has them.
struct StoredPixels {
  const Float32* floats = nullptr;
  const Float64* doubles = nullptr;
  const Uint16* words = nullptr;
  bool is_signed = false;  // the words

  [[nodiscard]] double at(std::size_t n) const {
    if (floats != nullptr) return static_cast<double>(floats[n]);
    if (doubles != nullptr) return doubles[n];
    return is_signed ? static_cast<double>(static_cast<Sint16>(words[n])) : static_cast<double>(words[n]);
  }
};

Result<StoredPixels> find_pixels(DcmDataset& dataset, const TransferSyntax& syntax, std::int64_t needed,
                                 const std::string& file) {
  StoredPixels pixels;
  unsigned long count = 0;
  if (dataset.findAndGetFloat32Array(DCM_FloatPixelData, pixels.floats, &count).bad() &&
      dataset.findAndGetFloat64Array(DCM_DoubleFloatPixelData, pixels.doubles, &count).bad()) {
    Uint16 bits = 0;
    Uint16 is_signed = 0;
    dataset.findAndGetUint16(DCM_BitsAllocated, bits);
    dataset.findAndGetUint16(DCM_PixelRepresentation, is_signed);
    pixels.is_signed = is_signed != 0;
    if (syntax.is_encapsulated() || bits != 16) {
      return fail(ErrorKind::input,
                  "{}: has neither float nor uncompressed pixels of 16 bits (7FE0,0008 to 7FE0,0010)", file);
    }
    dataset.findAndGetUint16Array(DCM_PixelData, pixels.words, &count);
  }
  if (count < static_cast<unsigned long>(needed)) {
    return fail(ErrorKind::input, "{}: its pixels end early: {} of {}", file, count, needed);
  }
  return pixels;
}

struct ParametricMap {
  DescribedFrames described;
  StoredPixels pixels;
};

Result<ParametricMap> read_parametric_map(DcmDataset& dataset, const TransferSyntax& syntax,
                                          const std::string& file) {
  Uint16 rows = 0;
  Uint16 columns = 0;
  dataset.findAndGetUint16(DCM_Rows, rows);
  dataset.findAndGetUint16(DCM_Columns, columns);
  if (rows == 0 || columns == 0) {
    return fail(ErrorKind::input, "{}: Rows (0028,0010) or Columns (0028,0011) are missing", file);
  }
  auto described = read_frame_groups(dataset, columns, rows, file);
  if (!described) return pass_on(described);
  const auto needed = checked_product(static_cast<std::int64_t>(described->frames.size()), std::int64_t{rows},
                                      std::int64_t{columns});
  if (!needed) return fail(ErrorKind::input, "{}: has more pixels than can be counted", file);
  auto pixels = find_pixels(dataset, syntax, *needed, file);
  if (!pixels) return pass_on(pixels);
  return ParametricMap{std::move(*described), *pixels};
}

Result<LoadedMap> read_parameters(const fs::path& file) {
  const std::string name = file.string();
  auto object = load_result(file);
  if (!object) return pass_on(object);
  const auto stored = read_parametric_map(object->dataset(), object->syntax(), name);
  if (!stored) return pass_on(stored);
  const DescribedFrames& described = stored->described;
  const StoredPixels& pixels = stored->pixels;
  const auto grid = grid_of_frames(described.frames, described.between_mm, described.thickness_mm, name);
  if (!grid) return pass_on(grid);
  auto map = empty_map(*grid, described.frames.size(), name);
  if (!map) return map;
  map->frame_of_reference_uid = element_text(object->dataset(), DCM_FrameOfReferenceUID);
  auto& values = std::get<std::vector<float>>(map->volume.voxels);
  bool is_twice = false;
  std::size_t next = 0;
  for (std::size_t n = 0; n < described.frames.size(); ++n) {
    const FrameGroups& groups = described.groups[n];
    const auto take = [&](std::size_t offset, std::int64_t /*row*/, std::int64_t /*column*/) {
      is_twice = is_twice || map->covered[offset];
      map->covered[offset] = true;
      values[offset] = static_cast<float>(groups.slope * pixels.at(next++) + groups.intercept);
    };
    TIDEMARK_TRY(visit_pixels(described.frames[n], *grid, name, take));
  }
  if (is_twice) {
    return fail(ErrorKind::input, "{}: several of its frames lie at one place: which is the map is not known",
                name);
  }
  return map;
}

}  // namespace

bool holds_map(const fs::path& file) {
  const std::string sop_class = sop_class_of(file);
  return sop_class == UID_ParametricMapStorage || sop_class == UID_SegmentationStorage;
}

Result<LoadedMap> read_map(const fs::path& file) {
  return guarded(file, [&]() -> Result<LoadedMap> {
    if (sop_class_of(file) == UID_ParametricMapStorage) return read_parameters(file);
    return read_fractions(file);
  });
}

}  // namespace tidemark::imaging
