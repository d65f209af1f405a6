#include "imaging/results/frame_groups.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "imaging/dicom/decimal.h"
#include "imaging/dicom/same_slices.h"
#include "imaging/results/dicom_object.h"

namespace tidemark::imaging {
namespace {

std::optional<std::vector<double>> decimals_of(DcmItem& item, const DcmTagKey& key, std::size_t count) {
  auto values = parse_decimals(element_text(item, key));
  return values && values->size() == count ? values : std::nullopt;
}

// Those of one item, in the place of what is there: of all frames first, then of one.
void read_groups(DcmItem& item, FrameGroups& groups) {
  const auto with = [&](const DcmTagKey& sequence, const auto& read) {
    DcmItem* group = nullptr;
    if (item.findAndGetSequenceItem(sequence, group).good() && group != nullptr) read(*group);
  };
  with(DCM_PlanePositionSequence,
       [&](DcmItem& group) { groups.position_mm = decimals_of(group, DCM_ImagePositionPatient, 3); });
  with(DCM_PlaneOrientationSequence,
       [&](DcmItem& group) { groups.orientation = decimals_of(group, DCM_ImageOrientationPatient, 6); });
  with(DCM_PixelMeasuresSequence, [&](DcmItem& group) {
    groups.spacing_mm = decimals_of(group, DCM_PixelSpacing, 2);
    const auto between = decimals_of(group, DCM_SpacingBetweenSlices, 1);
    const auto thickness = decimals_of(group, DCM_SliceThickness, 1);
    groups.between_mm = between ? std::optional(between->front()) : std::nullopt;
    groups.thickness_mm = thickness ? std::optional(thickness->front()) : std::nullopt;
  });
  with(DCM_RealWorldValueMappingSequence, [&](DcmItem& group) {
    Float64 value = 0.0;
    if (group.findAndGetFloat64(DCM_RealWorldValueSlope, value).good()) groups.slope = value;
    if (group.findAndGetFloat64(DCM_RealWorldValueIntercept, value).good()) groups.intercept = value;
  });
  with(DCM_SegmentIdentificationSequence, [&](DcmItem& group) {
    Uint16 number = 0;
    groups.segment = group.findAndGetUint16(DCM_ReferencedSegmentNumber, number).good()
                         ? std::optional(number)
                         : std::nullopt;
  });
}

// Where a frame lies, by `groups`.
Result<SegmentFrame> place_of(const FrameGroups& groups, std::int64_t columns, std::int64_t rows,
                              const std::string& which) {
  if (!groups.position_mm || !groups.orientation || !groups.spacing_mm) {
    return fail(ErrorKind::input, "{}: its place, orientation or pixel spacing are missing or cannot be read",
                which);
  }
  const auto& o = *groups.orientation;
  const glm::dvec3 row(o[0], o[1], o[2]);
  const glm::dvec3 column(o[3], o[4], o[5]);
  const auto& p = *groups.position_mm;
  const double between_rows = groups.spacing_mm->front();
  const double between_columns = groups.spacing_mm->back();
  SegmentFrame frame{groups.segment.value_or(0), columns, rows, {p[0], p[1], p[2]}, {}, {}};
  const auto finite = [](const glm::dvec3& v) { return std::isfinite(glm::dot(v, v)); };
  const bool is_spaced = between_rows > 0.0 && between_columns > 0.0;
  if (!finite(frame.position_mm) || !is_orthonormal({row, column}) || !is_spaced ||
      !finite({between_rows, between_columns, 0.0})) {
    return fail(ErrorKind::input, "{}: its place, orientation or pixel spacing makes no sense", which);
  }
  frame.step_column_mm = between_columns * glm::normalize(row);
  frame.step_row_mm = between_rows * glm::normalize(column);
  return frame;
}

}  // namespace

Result<DescribedFrames> read_frame_groups(DcmDataset& dataset, std::int64_t columns, std::int64_t rows,
                                          const std::string& file) {
  DescribedFrames described;
  FrameGroups shared;
  DcmItem* of_all = nullptr;
  if (dataset.findAndGetSequenceItem(DCM_SharedFunctionalGroupsSequence, of_all).good() &&
      of_all != nullptr) {
    read_groups(*of_all, shared);
  }
  const Status read =
      for_each_item(dataset, DCM_PerFrameFunctionalGroupsSequence, [&](DcmItem& of_one) -> Status {
        FrameGroups groups = shared;
        read_groups(of_one, groups);
        const std::string which = fmt::format("{}: frame {}", file, described.frames.size() + 1);
        auto frame = place_of(groups, columns, rows, which);
        if (!frame) return pass_on(frame);
        described.frames.push_back(*frame);
        if (groups.between_mm) described.between_mm = groups.between_mm;
        if (groups.thickness_mm) described.thickness_mm = *groups.thickness_mm;
        described.groups.push_back(std::move(groups));
        return {};
      });
  if (!read) return pass_on(read);
  if (described.frames.empty()) {
    return fail(ErrorKind::input, "{}: PerFrameFunctionalGroupsSequence (5200,9230) is missing", file);
  }
  return described;
}

}  // namespace tidemark::imaging
