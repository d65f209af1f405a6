// The header of one slice, without any DCMTK type: of a classic image, a frame of an image of several frames,
// or a tile of a mosaic.
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

namespace tidemark::imaging {

// The attributes that may tell the volumes of one series apart. Unset where the file lacks them.
struct SliceTraits {
  std::optional<double> series_number;      // (0020,0011), which should be the same in a series
  std::string stack;                        // (0020,9056)
  std::string image_type;                   // (0008,0008) or (0008,9007), and (0008,9208)
  std::optional<double> echo_number;        // (0018,0086)
  std::optional<double> echo_time_ms;       // (0018,0081) or (0018,9082)
  std::optional<double> b_value;            // (0018,9087), or the vendor's own
  std::optional<glm::dvec3> gradient;       // (0018,9089), or the vendor's own
  std::optional<double> temporal_position;  // (0020,0100) or (0020,9128)
  std::optional<double> trigger_time_ms;    // (0018,1060) or (0020,9153)
  std::optional<double> acquisition;        // (0020,0012) or (0020,9156)
  std::optional<double> acquired_at;        // date and time as a number, YYYYMMDDHHMMSS.F
  std::optional<double> made_at;            // of the content, likewise
  std::optional<double> instance;           // (0020,0013)
};

struct SliceHeader {
  std::filesystem::path file;
  std::int64_t frame = 0;   // from 0
  std::int64_t frames = 1;  // of the file
  std::int64_t tile = 0;    // from 0
  std::int64_t tiles = 1;   // of the frame
  // The reason why the image cannot be a slice, one line without the file's name; empty when it can.
  std::string problem;

  std::string study_uid;               // (0020,000D)
  std::string series_uid;              // (0020,000E)
  std::string frame_of_reference_uid;  // (0020,0052)
  std::string sop_class_uid;           // (0008,0016)
  std::string sop_instance_uid;        // (0008,0018)
  std::string modality;                // (0008,0060)
  std::string description;             // (0008,103E), UTF-8
  std::string date;                    // (0008,0020) as "2004-07-31"; empty when absent or not a date
  Patient patient;
  std::string transfer_syntax;  // UID

  std::int64_t rows = 0;           // of the slice
  std::int64_t columns = 0;        // of the slice
  std::int64_t frame_rows = 0;     // (0028,0010)
  std::int64_t frame_columns = 0;  // (0028,0011)
  int bits_allocated = 0;          // 8, 16 or 32
  int bits_stored = 0;
  int high_bit = 0;
  bool is_signed = false;

  std::optional<glm::dvec3> position_mm;                 // (0020,0032), LPS
  std::optional<std::array<glm::dvec3, 2>> orientation;  // (0020,0037): along a row (i), along a column (j)
  std::optional<glm::dvec2> pixel_spacing_mm;            // along i, along j: (0028,0030) swapped
  std::optional<glm::dvec2> detector_spacing_mm;  // the same of (0018,1164): of a projection's detector
  std::optional<double> thickness_mm;             // (0018,0050)

  double slope = 1.0;                 // (0028,1053)
  double intercept = 0.0;             // (0028,1052)
  std::optional<double> padding;      // (0028,0120): the stored value where nothing was measured
  std::optional<WindowLevel> window;  // (0028,1050) and (0028,1051), first values

  QuantityHeader quantity;

  bool is_monochrome1 = false;  // small values are white
  bool is_lossy = false;        // was compressed with loss at some time
  bool has_burned_in_text = false;

  SliceTraits traits;
};

}  // namespace tidemark::imaging
