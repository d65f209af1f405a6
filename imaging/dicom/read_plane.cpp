#include "imaging/dicom/read_plane.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <fmt/format.h>

#include "imaging/dicom/decimal.h"

namespace tidemark::imaging {

void read_position(AttributeReader& in, SliceHeader& header) {
  if (const auto p = in.decimals(DCM_ImagePositionPatient, 3)) {
    header.position_mm = glm::dvec3((*p)[0], (*p)[1], (*p)[2]);
  }
}

void read_orientation(AttributeReader& in, SliceHeader& header) {
  if (const auto o = in.decimals(DCM_ImageOrientationPatient, 6)) {
    header.orientation = {glm::dvec3((*o)[0], (*o)[1], (*o)[2]), glm::dvec3((*o)[3], (*o)[4], (*o)[5])};
  }
}

void read_pixel_spacing(AttributeReader& in, SliceHeader& header) {
  if (const auto s = in.decimals(DCM_PixelSpacing, 2)) {
    header.pixel_spacing_mm = glm::dvec2((*s)[1], (*s)[0]);
  }
}

void read_detector_spacing(const AttributeReader& in, SliceHeader& header) {
  const auto s = parse_decimals(in.text(DCM_ImagerPixelSpacing));
  if (s && s->size() == 2 && (*s)[0] > 0.0 && (*s)[1] > 0.0)
    header.detector_spacing_mm = glm::dvec2((*s)[1], (*s)[0]);
}

void read_thickness(const AttributeReader& in, SliceHeader& header) {
  const auto thickness = in.number(DCM_SliceThickness);
  if (thickness && *thickness > 0.0) header.thickness_mm = thickness;
}

void read_rescale(AttributeReader& in, SliceHeader& header) {
  if (const auto slope = in.decimals(DCM_RescaleSlope, 1)) header.slope = slope->front();
  if (const auto intercept = in.decimals(DCM_RescaleIntercept, 1)) header.intercept = intercept->front();
  if (in.first_item(DCM_ModalityLUTSequence) != nullptr) header.quantity.has_value_table = true;
  if (header.slope == 0.0) in.report(fmt::format("{} is 0", name_of(DCM_RescaleSlope)));
  if (std::string type = in.name(DCM_RescaleType); !type.empty()) {
    header.quantity.rescale_type = std::move(type);
  }
}

void read_window(const AttributeReader& in, SliceHeader& header) {
  const auto centre = in.number(DCM_WindowCenter);
  const auto width = in.number(DCM_WindowWidth);
  if (centre && width && *width > 0.0) header.window = WindowLevel{*centre, *width};
}

}  // namespace tidemark::imaging
