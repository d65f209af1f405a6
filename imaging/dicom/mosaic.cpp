#include "imaging/dicom/mosaic.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "imaging/dicom/attribute_reader.h"
#include "imaging/dicom/csa_header.h"
#include "imaging/dicom/read_traits.h"

namespace tidemark::imaging {
namespace {

// The most slices of a mosaic; a file could claim that each of its pixels is one.
constexpr double kMostTiles = 1024.0;
// The largest deviation of the normal that Siemens states from that of the orientation.
constexpr double kParallel = 1e-3;

// The private element `element` of the block that `creator` has reserved in the group (PS3.5 7.8.1).
DcmTagKey private_key(const AttributeReader& in, std::uint16_t group, const char* creator,
                      std::uint16_t element) {
  for (std::uint16_t block = 0x10; block <= 0x1f; ++block) {
    if (in.text(DcmTagKey(group, block)) == creator) {
      return {group, static_cast<std::uint16_t>(block << 8 | element)};
    }
  }
  return {group, static_cast<std::uint16_t>(0x1000 | element)};
}

std::span<const std::uint8_t> csa_header(const AttributeReader& in) {
  const Uint8* bytes = nullptr;
  unsigned long count = 0;
  const DcmTagKey key = private_key(in, 0x0029, "SIEMENS CSA HEADER", 0x10);
  if (in.item().findAndGetUint8Array(key, bytes, &count).bad() || bytes == nullptr) return {};
  return {bytes, count};
}

// The file's attributes of its mosaic, each given twice or in one of two places.
struct Mosaic {
  double tiles = 0.0;
  std::optional<glm::dvec3> normal;  // from each slice to the next
  double distance_mm = 0.0;

  // Of the square that holds the tiles, which may leave its last ones empty.
  [[nodiscard]] std::int64_t tiles_across() const {
    return static_cast<std::int64_t>(std::ceil(std::sqrt(tiles)));
  }
};

Mosaic read_mosaic(AttributeReader& in) {
  const auto csa = csa_header(in);
  Mosaic mosaic;
  if (const auto tiles = csa_numbers(csa, "NumberOfImagesInMosaic"); !tiles.empty()) {
    mosaic.tiles = tiles.front();
  }
  if (const auto tiles = in.number(private_key(in, 0x0019, "SIEMENS MR HEADER", 0x0a))) {
    if (mosaic.tiles != 0.0 && mosaic.tiles != *tiles) {
      in.report(fmt::format("is a mosaic of {:g} slices by (0019,100A), and of {:g} by its CSA header",
                            *tiles, mosaic.tiles));
    }
    mosaic.tiles = *tiles;
  }
  if (const auto n = csa_numbers(csa, "SliceNormalVector"); n.size() == 3) {
    mosaic.normal = glm::dvec3(n[0], n[1], n[2]);
  }
  if (const auto distance = csa_numbers(csa, "SpacingBetweenSlices"); !distance.empty()) {
    mosaic.distance_mm = distance.front();
  }
  if (const auto distance = in.number(DCM_SpacingBetweenSlices)) mosaic.distance_mm = *distance;
  return mosaic;
}

void check(const Mosaic& mosaic, const SliceHeader& whole, AttributeReader& in) {
  if (!(mosaic.tiles >= 2.0 && mosaic.tiles <= kMostTiles) || mosaic.tiles != std::floor(mosaic.tiles)) {
    in.report("is a Siemens mosaic that does not say of how many slices ((0019,100A), CSA header)");
    return;
  }
  if (!(mosaic.distance_mm > 0.0)) {
    in.report(
        fmt::format("is a Siemens mosaic that does not say how far its slices are apart ({}, CSA header)",
                    name_of(DCM_SpacingBetweenSlices)));
  }
  if (!mosaic.normal) {
    in.report(
        "is a Siemens mosaic that does not say in which direction its slices follow each other "
        "(SliceNormalVector in the CSA header)");
  }
  if (!whole.position_mm || !whole.orientation || !whole.pixel_spacing_mm) {
    in.report(fmt::format("is a Siemens mosaic without {}, {} or {}", name_of(DCM_ImagePositionPatient),
                          name_of(DCM_ImageOrientationPatient), name_of(DCM_PixelSpacing)));
  }
  const std::int64_t across = mosaic.tiles_across();
  if (whole.columns % across != 0 || whole.rows % across != 0) {
    in.report(fmt::format("is a Siemens mosaic of {:g} slices, which {} x {} pixels cannot hold",
                          mosaic.tiles, whole.columns, whole.rows));
  }
}

}  // namespace

bool is_mosaic(DcmItem& dataset) {
  std::string problem;
  return AttributeReader(dataset, problem).text(DCM_ImageType).find("MOSAIC") != std::string::npos;
}

std::vector<SliceHeader> read_tiles(DcmItem& dataset, SliceHeader whole) {
  AttributeReader in(dataset, whole.problem);
  const Mosaic mosaic = read_mosaic(in);
  check(mosaic, whole, in);
  glm::dvec3 normal(0.0);
  if (whole.problem.empty()) {
    normal = glm::cross((*whole.orientation)[0], (*whole.orientation)[1]);
    const double along = glm::dot(normal, *mosaic.normal);
    if (!(std::abs(std::abs(along) - 1.0) <= kParallel)) {
      in.report("is a Siemens mosaic whose SliceNormalVector is not the normal of its orientation");
    }
    // Exactly the normal of the slices, in the direction that is stated.
    normal *= std::copysign(1.0, along);
  }
  if (!whole.problem.empty()) return {std::move(whole)};

  const auto tiles = static_cast<std::int64_t>(mosaic.tiles);
  const std::int64_t across = mosaic.tiles_across();
  whole.tiles = tiles;
  whole.columns /= across;
  whole.rows /= across;
  // The position is that of the first pixel of an image as large as the mosaic around the slice's centre.
  const glm::dvec2 margin(static_cast<double>(whole.frame_columns - whole.columns) / 2.0,
                          static_cast<double>(whole.frame_rows - whole.rows) / 2.0);
  const glm::dvec2 shift = margin * *whole.pixel_spacing_mm;
  *whole.position_mm += shift.x * (*whole.orientation)[0] + shift.y * (*whole.orientation)[1];
  const glm::dvec3 last = *whole.position_mm + (mosaic.tiles - 1.0) * mosaic.distance_mm * normal;
  if (!std::isfinite(glm::dot(last, last))) {
    in.report(fmt::format(
        "is a Siemens mosaic whose slices, {:g} mm apart ({}), lie at no place that can be computed",
        mosaic.distance_mm, name_of(DCM_SpacingBetweenSlices)));
    return {std::move(whole)};
  }
  std::vector<SliceHeader> slices(static_cast<std::size_t>(tiles), whole);
  for (std::int64_t tile = 0; tile < tiles; ++tile) {
    SliceHeader& slice = slices[static_cast<std::size_t>(tile)];
    slice.tile = tile;
    *slice.position_mm += static_cast<double>(tile) * mosaic.distance_mm * normal;
  }
  return slices;
}

}  // namespace tidemark::imaging
