#include "document/measure_codes.h"

#include <optional>

namespace tidemark::document {
namespace {

using imaging::Code;

const Code kMillimetres{"mm", "UCUM", "millimeter"};
const Code kNoUnits{"1", "UCUM", "no units"};

// What values of an image are, and in which unit.
struct Quantity {
  Code quantity;
  Code unit;
};

// PS3.17 RRR.2, PS3.16 CID 7469. None: there is no code that fits.
std::optional<Quantity> quantity_of(const ImageValues& image, const std::string& modality) {
  if (modality == "CT" && image.unit == "HU")
    return Quantity{{"112031", "DCM", "Attenuation Coefficient"}, {"[hnsf'U]", "UCUM", "Hounsfield unit"}};
  if (modality == "MR" && image.unit.empty())
    return Quantity{{"110852", "DCM", "MR signal intensity"}, kNoUnits};
  if (image.unit == "SUVbw g/ml")
    return Quantity{{"126401", "DCM", "SUVbw"},
                    {"{SUVbw}g/ml", "UCUM", "Standardized Uptake Value body weight"}};
  return std::nullopt;
}

}  // namespace

std::vector<imaging::ReportedMeasure> coded(const Measures& measures, const std::string& modality) {
  const imaging::Diameters& diameters = measures.diameters;
  std::vector<imaging::ReportedMeasure> coded{
      {{"118565006", "SCT", "Volume"}, measures.volume_ml, {"cm3", "UCUM", "cubic centimeter"}, {}},
      {{"103339001", "SCT", "Long axis"}, diameters.in_slice.length_mm(), kMillimetres, {}},
      {{"103340004", "SCT", "Short axis"}, diameters.across.length_mm(), kMillimetres, {}},
      {{"L0JK", "IBSI", "Maximum 3D diameter"}, diameters.longest.length_mm(), kMillimetres, {}},
      {{"C0JK", "IBSI", "Surface area"}, measures.area_mm2, {"mm2", "UCUM", "square millimeter"}, {}},
      {{"QCFX", "IBSI", "Sphericity"}, measures.sphericity, kNoUnits, {}}};
  if (measures.images.empty()) return coded;
  const ImageValues& image = measures.images.front();
  const auto quantity = quantity_of(image, modality);
  if (!quantity) return coded;
  // PS3.16 CID 7464.
  const imaging::InsideValues& inside = image.values;
  const auto add = [&](double value, const Code& derivation) {
    coded.push_back({quantity->quantity, value, quantity->unit, derivation});
  };
  add(inside.mean, {"373098007", "SCT", "Mean"});
  add(inside.standard_deviation, {"386136009", "SCT", "Standard Deviation"});
  add(inside.percentiles[imaging::kPercentiles.size() / 2], {"373099004", "SCT", "Median"});
  add(inside.smallest, {"255605001", "SCT", "Minimum"});
  add(inside.largest, {"56851009", "SCT", "Maximum"});
  if (inside.uptake) {
    add(inside.uptake->peak, {"126031", "DCM", "Peak Value Within ROI"});
    coded.push_back({{"126033", "DCM", "Total Lesion Glycolysis"},
                     inside.uptake->total_glycolysis,
                     {"g", "UCUM", "gram"},
                     {}});
  }
  return coded;
}

}  // namespace tidemark::document
