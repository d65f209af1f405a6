#include "imaging/dicom/quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tl/expected.hpp>

#include "imaging/dicom/slice_header.h"

namespace tidemark::imaging {
namespace {

using Slices = std::vector<SliceHeader>;

// A smaller dose (Bq) is never given: such a number is in another unit.
constexpr double kLeastDose = 1e5;
// After so many half-lives no activity is left.
constexpr double kMostHalfLives = 10.0;
constexpr double kDay = 86400.0;

tl::unexpected<std::string> because(std::string reason) {
  return tl::unexpected<std::string>(std::move(reason));
}

// The value that all images share.
template <class Value>
tl::expected<Value, std::string> common(const Slices& slices, std::optional<Value> QuantityHeader::*member,
                                        const char* name) {
  const std::optional<Value>& first = slices.front().quantity.*member;
  for (const SliceHeader& slice : slices) {
    const std::optional<Value>& value = slice.quantity.*member;
    if (!value) return because(fmt::format("{} is missing or makes no sense", name));
    if (*value != *first) return because(fmt::format("{} is not the same in all images", name));
  }
  return *first;
}

// When the activity is stated for (DecayCorrection START): the beginning of the series, if no image was taken
// before it. Where one was, the series was made later from others.
tl::expected<double, std::string> scan_began(const Slices& slices) {
  const auto began = common(slices, &QuantityHeader::series_began, "SeriesTime (0008,0031)");
  if (!began) return began;
  for (const SliceHeader& slice : slices) {
    if (!slice.quantity.acquired) return because("AcquisitionTime (0008,0032) is missing or makes no sense");
    if (*slice.quantity.acquired < *began) {
      return because("SeriesTime (0008,0031) is later than AcquisitionTime (0008,0032)");
    }
  }
  return *began;
}

// How long the tracer had decayed when the scan began, in seconds.
tl::expected<double, std::string> decay_time(const Slices& slices, double half_life) {
  const auto began = scan_began(slices);
  if (!began) return began;
  const char* name = "RadiopharmaceuticalStartDateTime (0018,1078)";
  double time = 0.0;
  if (slices.front().quantity.injected) {
    const auto injected = common(slices, &QuantityHeader::injected, name);
    if (!injected) return injected;
    time = *began - *injected;
  } else {
    name = "RadiopharmaceuticalStartTime (0018,1072)";
    const auto injected = common(slices, &QuantityHeader::injected_day, name);
    if (!injected) return injected;
    // Of the same day, or of the evening before.
    time = std::fmod(*began, kDay) - *injected;
    if (time < 0.0) time += kDay;
  }
  if (time < 0.0) return because(fmt::format("{} is later than SeriesTime (0008,0031)", name));
  if (time > kMostHalfLives * half_life) {
    return because(fmt::format("{} is {:.1f} hours before SeriesTime (0008,0031)", name, time / 3600.0));
  }
  return time;
}

// g/ml for one Bq/ml (QIBA's vendor-neutral formula for SUVbw).
tl::expected<double, std::string> suv_factor(const Slices& slices) {
  const QuantityHeader& first = slices.front().quantity;
  for (const char* correction : {"ATTN", "DECY"}) {
    if (first.corrections.find(correction) == std::string::npos) {
      return because(fmt::format("CorrectedImage (0028,0051) does not name {}", correction));
    }
  }
  const bool is_start = first.decay_correction == "START";
  if (!is_start && first.decay_correction != "ADMIN") {
    return because(fmt::format("DecayCorrection (0054,1102) is '{}'", first.decay_correction));
  }
  const bool agreed = std::all_of(slices.begin(), slices.end(), [&](const SliceHeader& slice) {
    return slice.quantity.decay_correction == first.decay_correction &&
           slice.quantity.corrections == first.corrections;
  });
  if (!agreed) return because("DecayCorrection (0054,1102) is not the same in all images");
  const auto weight = common(slices, &QuantityHeader::weight_kg, "PatientWeight (0010,1030)");
  if (!weight) return weight;
  if (*weight <= 0.0) return because(fmt::format("PatientWeight (0010,1030) is {} kg", *weight));
  const auto dose = common(slices, &QuantityHeader::dose_bq, "RadionuclideTotalDose (0018,1074)");
  if (!dose) return dose;
  if (*dose < kLeastDose) return because(fmt::format("RadionuclideTotalDose (0018,1074) is {} Bq", *dose));
  if (!is_start) return *weight * 1000.0 / *dose;

  const auto half_life = common(slices, &QuantityHeader::half_life_s, "RadionuclideHalfLife (0018,1075)");
  if (!half_life) return half_life;
  if (*half_life <= 0.0) return because(fmt::format("RadionuclideHalfLife (0018,1075) is {} s", *half_life));
  const auto time = decay_time(slices, *half_life);
  if (!time) return time;
  return *weight * 1000.0 / (*dose * std::exp2(-*time / *half_life));
}

void state_activity(const Slices& slices, Series& series) {
  const QuantityHeader& first = slices.front().quantity;
  if (first.units == "GML") {
    const bool is_by_weight = first.suv_type.empty() || first.suv_type == "BW";
    series.unit = is_by_weight ? "SUVbw g/ml" : first.suv_type == "LBM" ? "SUVlbm g/ml" : "g/ml";
    return;
  }
  if (first.units != "BQML") {
    series.warnings.push_back(
        fmt::format("the values are no activity: Units (0054,1001) is '{}'", first.units));
    return;
  }
  const auto factor = suv_factor(slices);
  if (!factor || !std::isfinite(*factor)) {
    series.unit = "Bq/ml";
    series.warnings.push_back(
        fmt::format("the values stay in Bq/ml, no SUV: {}", factor ? "it is not finite" : factor.error()));
    return;
  }
  series.unit = "SUVbw g/ml";
  series.value_scale = *factor;
  series.changes.push_back(fmt::format("values are SUVbw in g/ml: Bq/ml times {:.6g}", *factor));
}

// By a mapping; empty where none is used.
std::string mapped_unit(const SliceHeader& slice) {
  return slice.quantity.mapping ? slice.quantity.mapping->unit : std::string();
}

bool has_value_table(const SliceHeader& slice) {
  return slice.quantity.has_value_table;
}

// By slope and intercept; empty where nothing says it, or a table leads to the unit. CT is in HU unless it
// says otherwise (PS3.3 C.8.2.1).
std::string rescaled_unit(const SliceHeader& slice) {
  if (slice.modality != "CT" || has_value_table(slice)) return {};
  return slice.quantity.rescale_type.empty() ? "HU" : slice.quantity.rescale_type;
}

}  // namespace

std::optional<std::string> state_quantity(const Slices& slices, Series& series) {
  const QuantityHeader& quantity = slices.front().quantity;
  const std::string unit = mapped_unit(slices.front());
  const std::string rescaled = rescaled_unit(slices.front());
  for (const SliceHeader& slice : slices) {
    if (mapped_unit(slice) != unit || rescaled_unit(slice) != rescaled ||
        slice.quantity.units != quantity.units) {
      return "the unit of the values is not the same in all images";
    }
  }
  if (!unit.empty()) {
    series.unit = unit;
    series.changes.push_back(
        fmt::format("values are in {} by RealWorldValueMappingSequence (0040,9096)", unit));
  } else if (!quantity.unused_mapping.empty()) {
    series.changes.push_back(
        fmt::format("RealWorldValueMappingSequence (0040,9096) is not used: {}", quantity.unused_mapping));
  }
  if (quantity.has_philips_scale && unit.empty()) {
    series.changes.emplace_back("the scanner's own scale, ScaleSlope (2005,100E), is not used");
  }
  if (unit.empty() && std::any_of(slices.begin(), slices.end(), has_value_table)) {
    series.warnings.emplace_back(
        "the values stay as they are stored: the table in ModalityLUTSequence (0028,3000) is not read");
  }
  if (rescaled == "HU") series.unit = rescaled;
  if (series.modality == "PT") state_activity(slices, series);
  return std::nullopt;
}

}  // namespace tidemark::imaging
