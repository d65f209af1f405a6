// The quantity that an image's values stand for, and its unit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "imaging/series.h"

class DcmItem;

namespace tidemark::imaging {

struct SliceHeader;

// A linear mapping of all stored values of an MR image to a unit.
struct ValueMapping {
  double slope = 1.0;
  double intercept = 0.0;
  std::string unit;  // UCUM
};

// The attributes of one image about its quantity. Moments are seconds since 1970 by the scanner's clock.
struct QuantityHeader {
  std::string rescale_type;             // (0028,1054)
  std::optional<ValueMapping> mapping;  // of the RealWorldValueMappingSequence (0040,9096), when it is used
  std::string unused_mapping;           // the reason why such a sequence is not used; else empty
  bool has_value_table = false;         // ModalityLUTSequence (0028,3000), which is not used
  bool has_philips_scale = false;       // (2005,100E), which is not used

  // PET (PS3.3 C.8.9.1, C.8.9.2)
  std::string units;             // (0054,1001)
  std::string suv_type;          // (0054,1006)
  std::string corrections;       // (0028,0051)
  std::string decay_correction;  // (0054,1102)
  std::optional<double> weight_kg;
  std::optional<double> dose_bq;
  std::optional<double> half_life_s;
  std::optional<double> injected;      // by date and time
  std::optional<double> injected_day;  // seconds since midnight, where no date says of which day
  std::optional<double> acquired;
  std::optional<double> series_began;
};

void read_quantity(DcmItem& dataset, SliceHeader& header);

// Reads the mapping of the dataset, or of the groups of a frame; without one the earlier mapping
// stays. It is used when it is the only one, linear, of all stored values of an MR image, to a unit of UCUM.
void read_mapping(DcmItem& item, SliceHeader& header);

// Puts slope and intercept of the mapping in place of the image's own, and converts the window to its unit.
// To be called once.
void apply_mapping(SliceHeader& header);

// Sets the series' unit and the factor of its values: activity becomes SUVbw where the images hold all that
// is needed, without contradiction. Returns the reason why the images cannot make a volume, or nothing.
[[nodiscard]] std::optional<std::string> state_quantity(const std::vector<SliceHeader>& slices,
                                                        Series& series);

}  // namespace tidemark::imaging
