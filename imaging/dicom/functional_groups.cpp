#include "imaging/dicom/functional_groups.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <utility>

#include "imaging/dicom/decimal.h"
#include "imaging/dicom/read_plane.h"
#include "imaging/dicom/read_traits.h"

namespace tidemark::imaging {
namespace {

// One item of shared or per-frame groups, and the header that they change. A group that is absent changes
// nothing, so that the shared ones hold where a frame has none of its own.
class GroupReader {
 public:
  GroupReader(DcmItem& groups, SliceHeader& header) : groups_(groups, header.problem), header_(header) {}

  void read() {
    read_place();
    read_values();
    read_content();
    read_contrast();
  }

 private:
  // Calls read(reader) with the group's item where there is one.
  template <class Read>
  void with(const DcmTagKey& group, const Read& read) {
    if (DcmItem* item = groups_.first_item(group)) {
      AttributeReader in(*item, header_.problem);
      read(in);
    }
  }

  void read_place() {
    with(DCM_PlanePositionSequence, [&](AttributeReader& in) { read_position(in, header_); });
    with(DCM_PlaneOrientationSequence, [&](AttributeReader& in) { read_orientation(in, header_); });
    with(DCM_PixelMeasuresSequence, [&](AttributeReader& in) {
      read_pixel_spacing(in, header_);
      read_thickness(in, header_);
    });
  }

  void read_values() {
    with(DCM_PixelValueTransformationSequence, [&](AttributeReader& in) { read_rescale(in, header_); });
    with(DCM_FrameVOILUTSequence, [&](AttributeReader& in) { read_window(in, header_); });
    read_mapping(groups_.item(), header_);
  }

  void read_content() {
    SliceTraits& traits = header_.traits;
    for (const DcmTagKey& converted : {DCM_UnassignedSharedConvertedAttributesSequence,
                                       DCM_UnassignedPerFrameConvertedAttributesSequence}) {
      with(converted, [&](AttributeReader& in) { read_traits(in, traits); });
    }
    with(DCM_FrameContentSequence, [&](AttributeReader& in) {
      if (std::string stack = in.name(DCM_StackID); !stack.empty()) traits.stack = std::move(stack);
      take(in.number(DCM_TemporalPositionIndex), traits.temporal_position);
      take(in.number(DCM_FrameAcquisitionNumber), traits.acquisition);
      take(moment(in.text(DCM_FrameAcquisitionDateTime), {}), traits.acquired_at);
    });
    with(DCM_CardiacSynchronizationSequence, [&](AttributeReader& in) {
      take(in.number(DCM_NominalCardiacTriggerDelayTime), traits.trigger_time_ms);
    });
  }

  void read_contrast() {
    SliceTraits& traits = header_.traits;
    for (const DcmTagKey& kind :
         {DCM_MRImageFrameTypeSequence, DCM_CTImageFrameTypeSequence, DCM_PETFrameTypeSequence}) {
      with(kind, [&](AttributeReader& in) {
        std::string type = in.name(DCM_FrameType);
        const std::string component = in.name(DCM_ComplexImageComponent);
        if (!component.empty()) type += '\\' + component;
        if (!type.empty()) traits.image_type = std::move(type);
      });
    }
    with(DCM_MREchoSequence,
         [&](AttributeReader& in) { take(in.number(DCM_EffectiveEchoTime), traits.echo_time_ms); });
    with(DCM_MRDiffusionSequence, [&](AttributeReader& in) {
      take(in.number(DCM_DiffusionBValue), traits.b_value);
      if (DcmItem* direction = in.first_item(DCM_DiffusionGradientDirectionSequence)) {
        const AttributeReader of_direction(*direction, header_.problem);
        traits.gradient = read_vector(of_direction, DCM_DiffusionGradientOrientation);
      }
    });
  }

  static void take(std::optional<double> value, std::optional<double>& into) {
    if (value) into = value;
  }

  AttributeReader groups_;
  SliceHeader& header_;
};

std::vector<SliceHeader> refuse(SliceHeader whole, std::string problem) {
  if (whole.problem.empty()) whole.problem = std::move(problem);
  std::vector<SliceHeader> one;
  one.push_back(std::move(whole));
  return one;
}

std::vector<SliceHeader> read_grouped_frames(AttributeReader& in, SliceHeader whole) {
  // Attributes outside the groups are not about a frame.
  whole.position_mm.reset();
  if (DcmItem* shared = in.first_item(DCM_SharedFunctionalGroupsSequence)) GroupReader(*shared, whole).read();
  if (!whole.problem.empty()) return refuse(std::move(whole), {});
  DcmSequenceOfItems* sequence = nullptr;
  in.item().findAndGetSequence(DCM_PerFrameFunctionalGroupsSequence, sequence);
  const auto items = sequence != nullptr ? static_cast<std::int64_t>(sequence->card()) : 0;
  if (items != whole.frames) {
    const std::string problem = fmt::format(
        "{} has {} items for {} frames", name_of(DCM_PerFrameFunctionalGroupsSequence), items, whole.frames);
    return refuse(std::move(whole), problem);
  }
  std::vector<SliceHeader> frames;
  // Step by step: access by number would count from the first item each time.
  for (DcmObject* item = sequence->nextInContainer(nullptr); item != nullptr;
       item = sequence->nextInContainer(item)) {
    SliceHeader frame = whole;
    frame.frame = static_cast<std::int64_t>(frames.size());
    GroupReader(*static_cast<DcmItem*>(item), frame).read();
    if (frame.problem.empty() && !frame.position_mm) {
      frame.problem = fmt::format("{} is missing", name_of(DCM_PlanePositionSequence));
    }
    if (!frame.problem.empty()) {
      const std::string problem = fmt::format("frame {}: {}", frame.frame + 1, frame.problem);
      return refuse(std::move(whole), problem);
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

// PS3.3 C.8.4.15: the slices of a reconstruction follow the first along the normal, behind it (or before it)
// when the distance is positive (or negative).
std::vector<SliceHeader> read_detector_frames(AttributeReader& in, SliceHeader whole) {
  const auto distance = in.number(DCM_SpacingBetweenSlices);
  if (DcmItem* detector = in.first_item(DCM_DetectorInformationSequence)) {
    AttributeReader of_detector(*detector, whole.problem);
    read_position(of_detector, whole);
    read_orientation(of_detector, whole);
  }
  const auto numbers = parse_decimals(in.text(DCM_SliceVector));
  if (!distance || !whole.position_mm || !whole.orientation) {
    return refuse(std::move(whole),
                  fmt::format("{}, {} or {} is missing, so where the frames lie is not known",
                              name_of(DCM_SpacingBetweenSlices), name_of(DCM_ImagePositionPatient),
                              name_of(DCM_ImageOrientationPatient)));
  }
  if (!numbers || static_cast<std::int64_t>(numbers->size()) != whole.frames) {
    const std::string problem = fmt::format("{} does not say of {} frames which slice each is",
                                            name_of(DCM_SliceVector), whole.frames);
    return refuse(std::move(whole), problem);
  }
  const glm::dvec3 normal = glm::cross((*whole.orientation)[0], (*whole.orientation)[1]);
  std::vector<SliceHeader> frames(numbers->size(), whole);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    frames[f].frame = static_cast<std::int64_t>(f);
    *frames[f].position_mm += ((*numbers)[f] - 1.0) * *distance * normal;
  }
  return frames;
}

// Whether the frames are the slices of one reconstructed volume: counted by slice, and by nothing else.
bool is_reconstruction(const AttributeReader& in) {
  DcmElement* element = nullptr;
  DcmTagKey pointer;
  const bool is_by_slice = in.item().findAndGetElement(DCM_FrameIncrementPointer, element).good() &&
                           element->getVM() == 1 && dynamic_cast<DcmAttributeTag*>(element) != nullptr &&
                           dynamic_cast<DcmAttributeTag*>(element)->getTagVal(pointer).good() &&
                           pointer == DCM_SliceVector;
  return is_by_slice && in.text(DCM_ImageType).find("RECON") != std::string::npos;
}

}  // namespace

std::vector<SliceHeader> read_frames(DcmItem& dataset, SliceHeader whole) {
  std::string problem;
  AttributeReader in(dataset, problem);
  const std::string sop_class = in.name(DCM_SOPClassUID);
  const char* known = dcmFindNameOfUID(sop_class.c_str());
  const std::string name = known != nullptr ? known : "unknown SOP class " + sop_class;
  const bool has_groups = in.item().tagExists(DCM_PerFrameFunctionalGroupsSequence) ||
                          in.item().tagExists(DCM_SharedFunctionalGroupsSequence);
  if (has_groups) return read_grouped_frames(in, std::move(whole));
  if (sop_class == UID_NuclearMedicineImageStorage && is_reconstruction(in)) {
    return read_detector_frames(in, std::move(whole));
  }
  if (whole.frames == 1 && name.find("Enhanced") == std::string::npos) {
    std::vector<SliceHeader> one;
    one.push_back(std::move(whole));
    return one;
  }
  problem = fmt::format(
      "comes as multi-frame ({}, {} frame{}) without {}, so where the frames lie is not known", name,
      whole.frames, whole.frames == 1 ? "" : "s", name_of(DCM_PerFrameFunctionalGroupsSequence));
  return refuse(std::move(whole), problem);
}

}  // namespace tidemark::imaging
