#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string_view>

#include "imaging/dicom/date.h"
#include "imaging/dicom/decimal.h"
#include "imaging/dicom/element_text.h"
#include "imaging/dicom/quantity.h"
#include "imaging/dicom/slice_header.h"

namespace tidemark::imaging {
namespace {

// Codes and numbers are ASCII; other characters would spoil a message.
std::string quantity_text(DcmItem& item, const DcmTagKey& key) {
  constexpr std::size_t kLongest = 256;
  std::string result = element_text(item, key).substr(0, kLongest);
  result.erase(result.find_last_not_of(' ') + 1);
  std::replace_if(
      result.begin(), result.end(), [](unsigned char c) { return c < 0x20 || c > 0x7e; }, '?');
  return result;
}

std::optional<double> number(DcmItem& item, const DcmTagKey& key) {
  const auto values = parse_decimals(quantity_text(item, key));
  if (!values || values->size() != 1) return std::nullopt;
  return values->front();
}

// "101500.25", as seconds since midnight (PS3.5 6.2, TM).
std::optional<double> seconds_of_day(std::string_view time) {
  if (time.size() < 4) return std::nullopt;
  const auto two = [&](std::size_t at) -> int {
    if (at + 2 > time.size()) return 0;
    const auto digit = [&](std::size_t i) { return time[i] >= '0' && time[i] <= '9' ? time[i] - '0' : 100; };
    return 10 * digit(at) + digit(at + 1);
  };
  if (two(0) > 23 || two(2) > 59 || two(4) > 60) return std::nullopt;
  double fraction = 0.0;
  if (time.size() > 7 && time[6] == '.') {
    const auto parsed = parse_decimals(std::string("0").append(time.substr(6)));
    if (!parsed) return std::nullopt;
    fraction = parsed->front();
  }
  return two(0) * 3600.0 + two(2) * 60.0 + two(4) + fraction;
}

// "20040731" (PS3.5 6.2, DA), as the seconds of its midnight.
std::optional<double> seconds_of_date(const std::string& date) {
  const std::string iso = iso_date(date);
  if (iso.empty()) return std::nullopt;
  const std::chrono::year_month_day day{
      std::chrono::year(std::stoi(iso.substr(0, 4))),
      std::chrono::month(static_cast<unsigned>(std::stoi(iso.substr(5, 2)))),
      std::chrono::day(static_cast<unsigned>(std::stoi(iso.substr(8, 2))))};
  if (!day.ok()) return std::nullopt;
  return static_cast<double>(std::chrono::sys_days(day).time_since_epoch().count()) * 86400.0;
}

std::optional<double> seconds_of(const std::string& date, const std::string& time) {
  const auto day = seconds_of_date(date);
  const auto of_day = seconds_of_day(time);
  if (!day || !of_day) return std::nullopt;
  return *day + *of_day;
}

// "+0100" (PS3.5 6.2, DT), as seconds that it is ahead of UTC.
std::optional<double> seconds_ahead(std::string_view zone) {
  constexpr std::size_t kLength = 5;
  if (zone.size() != kLength || (zone[0] != '+' && zone[0] != '-')) return std::nullopt;
  const auto ahead = seconds_of_day(zone.substr(1));
  if (!ahead) return std::nullopt;
  return zone[0] == '-' ? -*ahead : *ahead;
}

// A DT: date and time in one, by the clock of the dataset's time zone. With a zone of its own it is none that
// can be compared unless the dataset names one, too.
std::optional<double> moment_of(const std::string& date_time, const std::string& time_zone) {
  const std::size_t zone = date_time.find_first_of("+-");
  const std::string local = date_time.substr(0, zone);
  if (local.size() < 12) return std::nullopt;
  const auto moment = seconds_of(local.substr(0, 8), local.substr(8));
  if (!moment || zone == std::string::npos) return moment;
  const auto own = seconds_ahead(std::string_view(date_time).substr(zone));
  const auto of_dataset = seconds_ahead(time_zone);
  if (!own || !of_dataset) return std::nullopt;
  return *moment - *own + *of_dataset;
}

void read_pet(DcmItem& dataset, QuantityHeader& quantity) {
  quantity.units = quantity_text(dataset, DCM_Units);
  quantity.suv_type = quantity_text(dataset, DCM_SUVType);
  quantity.corrections = quantity_text(dataset, DCM_CorrectedImage);
  quantity.decay_correction = quantity_text(dataset, DCM_DecayCorrection);
  quantity.weight_kg = number(dataset, DCM_PatientWeight);
  const std::string series_date = quantity_text(dataset, DCM_SeriesDate);
  quantity.series_began = seconds_of(series_date, quantity_text(dataset, DCM_SeriesTime));
  const std::string date = quantity_text(dataset, DCM_AcquisitionDate);
  quantity.acquired =
      seconds_of(date.empty() ? series_date : date, quantity_text(dataset, DCM_AcquisitionTime));
  DcmItem* tracer = nullptr;
  if (dataset.findAndGetSequenceItem(DCM_RadiopharmaceuticalInformationSequence, tracer).bad()) return;
  quantity.dose_bq = number(*tracer, DCM_RadionuclideTotalDose);
  quantity.half_life_s = number(*tracer, DCM_RadionuclideHalfLife);
  quantity.injected = moment_of(quantity_text(*tracer, DCM_RadiopharmaceuticalStartDateTime),
                                quantity_text(dataset, DCM_TimezoneOffsetFromUTC));
  quantity.injected_day = seconds_of_day(quantity_text(*tracer, DCM_RadiopharmaceuticalStartTime));
}

// The stored values for which a mapping is defined, whatever they are written as.
std::optional<double> mapped_value(DcmItem& item, const DcmTagKey& whole, const DcmTagKey& real,
                                   bool is_signed) {
  Float64 value = 0.0;
  if (item.findAndGetFloat64(real, value).good()) return value;
  Uint16 word = 0;
  Sint16 with_sign = 0;
  if (item.findAndGetSint16(whole, with_sign).good()) return with_sign;
  if (item.findAndGetUint16(whole, word).bad()) return std::nullopt;
  return is_signed ? static_cast<double>(static_cast<Sint16>(word)) : static_cast<double>(word);
}

// The reason why the mapping is not used; empty when it is.
std::string take_mapping(DcmItem& item, SliceHeader& header) {
  if (header.modality != "MR") return "it is used in MR only";
  ValueMapping mapping;
  if (item.findAndGetFloat64(DCM_RealWorldValueSlope, mapping.slope).bad() ||
      item.findAndGetFloat64(DCM_RealWorldValueIntercept, mapping.intercept).bad()) {
    return "it is not linear";
  }
  if (!std::isfinite(mapping.slope) || !std::isfinite(mapping.intercept) || mapping.slope == 0.0) {
    return "its slope makes no sense";
  }
  DcmItem* code = nullptr;
  if (item.findAndGetSequenceItem(DCM_MeasurementUnitsCodeSequence, code).good() &&
      quantity_text(*code, DCM_CodingSchemeDesignator) == "UCUM") {
    mapping.unit = quantity_text(*code, DCM_CodeValue);
  }
  if (mapping.unit.empty() || mapping.unit == "1" || mapping.unit.starts_with('{')) {
    return "it states no unit";
  }
  constexpr const char* kInNoUnit = "<>&\"";
  if (mapping.unit.find_first_of(kInNoUnit) != std::string::npos) return "its unit is none of UCUM";
  const double lowest = header.is_signed ? -std::ldexp(1.0, header.bits_stored - 1) : 0.0;
  const double highest = std::ldexp(1.0, header.bits_stored - (header.is_signed ? 1 : 0)) - 1.0;
  const auto first = mapped_value(item, DCM_RealWorldValueFirstValueMapped,
                                  DCM_DoubleFloatRealWorldValueFirstValueMapped, header.is_signed);
  const auto last = mapped_value(item, DCM_RealWorldValueLastValueMapped,
                                 DCM_DoubleFloatRealWorldValueLastValueMapped, header.is_signed);
  if (!first || !last || *first > lowest || *last < highest) return "it leaves stored values without meaning";
  header.quantity.mapping = std::move(mapping);
  return {};
}

// A file's window is one of values by its own slope and intercept (PS3.3 C.11.2.1.2). Nothing where no number
// can hold the mapped one.
std::optional<WindowLevel> mapped_window(const WindowLevel& window, const SliceHeader& header,
                                         const ValueMapping& mapping) {
  const double factor = mapping.slope / header.slope;
  const WindowLevel mapped{(window.centre - header.intercept) * factor + mapping.intercept,
                           window.width * std::abs(factor)};
  const bool makes_sense = std::isfinite(mapped.centre) && std::isfinite(mapped.width) && mapped.width > 0.0;
  return makes_sense ? std::optional(mapped) : std::nullopt;
}

}  // namespace

void read_mapping(DcmItem& item, SliceHeader& header) {
  DcmSequenceOfItems* mappings = nullptr;
  if (item.findAndGetSequence(DCM_RealWorldValueMappingSequence, mappings).bad() || mappings == nullptr ||
      mappings->card() == 0) {
    return;
  }
  header.quantity.mapping.reset();
  header.quantity.unused_mapping =
      mappings->card() > 1 ? "there are several" : take_mapping(*mappings->getItem(0), header);
}

void apply_mapping(SliceHeader& header) {
  if (!header.quantity.mapping) return;
  const ValueMapping& mapping = *header.quantity.mapping;
  if (header.window) header.window = mapped_window(*header.window, header, mapping);
  header.slope = mapping.slope;
  header.intercept = mapping.intercept;
}

void read_quantity(DcmItem& dataset, SliceHeader& header) {
  QuantityHeader& quantity = header.quantity;
  if (header.modality == "PT") read_pet(dataset, quantity);
  read_mapping(dataset, header);
  constexpr Uint16 kPhilips = 0x2005;
  quantity.has_philips_scale =
      quantity_text(dataset, DcmTagKey(kPhilips, 0x0010)).starts_with("Philips MR Imaging DD") &&
      dataset.tagExists(DcmTagKey(kPhilips, 0x100e));
}

}  // namespace tidemark::imaging
