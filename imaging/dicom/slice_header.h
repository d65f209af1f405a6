// What one classic DICOM image says about itself, without any DCMTK type.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "core/volume.h"
#include "imaging/dicom/quantity.h"
#include "imaging/patient.h"

namespace tidemark {

struct SliceHeader {
  std::filesystem::path file;
  // Why the image cannot be a slice of a volume, one line without the file's name; empty when it can.
  std::string problem;

  std::string series_uid;        // (0020,000E)
  std::string sop_instance_uid;  // (0008,0018)
  std::string modality;          // (0008,0060)
  std::string description;       // (0008,103E), UTF-8
  std::string date;              // (0008,0020) as "2004-07-31"; empty when absent or not a date
  Patient patient;
  std::string transfer_syntax;  // UID

  std::int64_t rows = 0;     // (0028,0010)
  std::int64_t columns = 0;  // (0028,0011)
  int bits_allocated = 0;    // 8, 16 or 32
  int bits_stored = 0;
  int high_bit = 0;
  bool is_signed = false;

  std::optional<glm::dvec3> position_mm;                 // (0020,0032), LPS
  std::optional<std::array<glm::dvec3, 2>> orientation;  // (0020,0037): along a row (i), along a column (j)
  std::optional<glm::dvec2> pixel_spacing_mm;            // along i, along j: (0028,0030) swapped

  double slope = 1.0;                 // (0028,1053)
  double intercept = 0.0;             // (0028,1052)
  std::optional<WindowLevel> window;  // (0028,1050) and (0028,1051), first values

  QuantityHeader quantity;

  bool is_mosaic = false;       // Siemens: many slices tiled into one image
  bool is_monochrome1 = false;  // small values are white
  bool is_lossy = false;        // was compressed with loss at some time
  bool has_burned_in_text = false;
};

}  // namespace tidemark
