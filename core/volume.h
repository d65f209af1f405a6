// A scalar volume and a binary mask on a grid in the patient.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/geometry.h"
#include "core/result.h"

namespace tidemark {

struct WindowLevel {
  double centre = 0.0;  // in rescaled units (HU for CT)
  double width = 1.0;

  bool operator==(const WindowLevel&) const = default;
};

// Stored values in voxel order (i fastest); a voxel's value is slope * stored + intercept.
struct Volume {
  using Voxels = std::variant<std::vector<std::int16_t>, std::vector<std::uint16_t>, std::vector<float>>;

  Geometry geometry;
  Voxels voxels;
  double slope = 1.0;  // rescaled units per stored unit (DICOM PS3.3 C.7.6.16.2.9.1: HU for CT)
  double intercept = 0.0;

  std::string modality;               // DICOM (0008,0060): "CT", "MR", ...; empty when unknown
  std::string unit;                   // of its values: "HU", "SUVbw g/ml"; empty when they have none
  std::string description;            // of the series, for display
  std::optional<WindowLevel> window;  // the file's own first window
  std::vector<std::string> changes;   // the findings and changes of reading, one sentence each

  [[nodiscard]] const char* scalar_name() const;  // "int16", "uint16" or "float"
  [[nodiscard]] float value(std::int64_t offset) const;
  [[nodiscard]] float value(Index3 voxel) const { return value(geometry.offset(voxel)); }

  // All values, rescaled, in voxel order.
  [[nodiscard]] std::vector<float> values() const;

  // Smallest and largest rescaled value. The volume must not be empty.
  [[nodiscard]] std::pair<float, float> range() const;
  // The values below and above which one of two hundred lies: without the few that are far off. From a
  // regular sample of at most about a million voxels.
  [[nodiscard]] std::pair<float, float> common_range() const;
};

// 1 inside, 0 outside, in voxel order.
struct Mask {
  Geometry geometry;
  std::vector<std::uint8_t> voxels;

  [[nodiscard]] std::int64_t count() const;  // voxels inside
};

// 2 |A and B| / (|A| + |B|) of two masks of the same size; 1 when both are empty.
[[nodiscard]] double dice(const Mask& a, const Mask& b);

// Refuses voxels that are NaN or infinite; the error names `source` and the first such voxel.
[[nodiscard]] Status require_finite(const Volume& volume, const std::string& source);

}  // namespace tidemark
