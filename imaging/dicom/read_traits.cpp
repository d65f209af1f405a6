#include "imaging/dicom/read_traits.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <cmath>

#include "imaging/dicom/decimal.h"

namespace tidemark::imaging {
namespace {

void take(std::optional<double> value, std::optional<double>& into) {
  if (value) into = value;
}

// Before there was (0018,9087) each vendor had an element of its own.
void read_private_diffusion(const AttributeReader& in, SliceTraits& traits) {
  const std::string maker = in.text(DCM_Manufacturer);
  if (maker.starts_with("SIEMENS") || maker.starts_with("Siemens")) {
    take(in.number(DcmTagKey(0x0019, 0x100c)), traits.b_value);
    if (const auto direction = read_vector(in, DcmTagKey(0x0019, 0x100e))) traits.gradient = direction;
  } else if (maker.starts_with("GE ")) {
    // The digits above these five are flags.
    constexpr double kFlags = 100000.0;
    if (const auto b = in.number(DcmTagKey(0x0043, 0x1039))) traits.b_value = std::fmod(*b, kFlags);
    const auto x = in.number(DcmTagKey(0x0019, 0x10bb));
    const auto y = in.number(DcmTagKey(0x0019, 0x10bc));
    const auto z = in.number(DcmTagKey(0x0019, 0x10bd));
    if (x && y && z) traits.gradient = glm::dvec3(*x, *y, *z);
  } else if (maker.starts_with("Philips") || maker.starts_with("PHILIPS")) {
    take(in.number(DcmTagKey(0x2001, 0x1003)), traits.b_value);
  }
}

}  // namespace

std::optional<glm::dvec3> read_vector(const AttributeReader& in, const DcmTagKey& key) {
  const auto numbers = parse_decimals(in.text(key));
  if (!numbers || numbers->size() < 3) return std::nullopt;
  return glm::dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

std::optional<double> moment(const std::string& date, const std::string& time) {
  if (time.empty() && date.size() <= 8) return std::nullopt;
  std::string digits = date + time;
  digits.resize(std::min(digits.find_first_of("+-&"), digits.size()));  // a time zone
  const auto value = parse_decimals(digits);
  if (!value || value->size() != 1) return std::nullopt;
  return value->front();
}

void read_traits(const AttributeReader& in, SliceTraits& traits) {
  take(in.number(DCM_SeriesNumber), traits.series_number);
  if (std::string stack = in.name(DCM_StackID); !stack.empty()) traits.stack = std::move(stack);
  if (std::string type = in.name(DCM_ImageType); !type.empty()) traits.image_type = std::move(type);
  take(in.number(DCM_EchoNumbers), traits.echo_number);
  take(in.number(DCM_EchoTime), traits.echo_time_ms);
  read_private_diffusion(in, traits);
  take(in.number(DCM_DiffusionBValue), traits.b_value);
  if (const auto direction = read_vector(in, DCM_DiffusionGradientOrientation)) traits.gradient = direction;
  take(in.number(DCM_TemporalPositionIdentifier), traits.temporal_position);
  take(in.number(DCM_TriggerTime), traits.trigger_time_ms);
  take(in.number(DCM_AcquisitionNumber), traits.acquisition);
  take(moment(in.text(DCM_AcquisitionDate), in.text(DCM_AcquisitionTime)), traits.acquired_at);
  take(moment(in.text(DCM_ContentDate), in.text(DCM_ContentTime)), traits.made_at);
  take(in.number(DCM_InstanceNumber), traits.instance);
}

}  // namespace tidemark::imaging
