#include "imaging/dicom/header_reader.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "imaging/dicom/attribute_reader.h"
#include "imaging/dicom/character_sets.h"
#include "imaging/dicom/checked_dicom.h"
#include "imaging/dicom/date.h"
#include "imaging/dicom/dcmtk_stream.h"
#include "imaging/dicom/decimal.h"
#include "imaging/dicom/functional_groups.h"
#include "imaging/dicom/mosaic.h"
#include "imaging/dicom/read_patient.h"
#include "imaging/dicom/read_plane.h"
#include "imaging/dicom/read_traits.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

// The most frames of an enhanced image, which has a place for each; more are damage.
constexpr std::int64_t kMostFrames = 65535;

template <class T>
tl::unexpected<Refusal> refused(ImageResult<T>& failed) {
  return tl::unexpected<Refusal>(std::move(failed.error()));
}

std::int64_t read_number_of_frames(AttributeReader& in) {
  const std::string frames = in.text(DCM_NumberOfFrames);
  if (frames.empty()) return 1;
  const auto count = parse_integers(frames);
  if (!count || count->size() != 1 || count->front() < 1) {
    in.report(fmt::format("{} is '{}'", name_of(DCM_NumberOfFrames), frames.substr(0, 80)));
    return 1;
  }
  if (count->front() > kMostFrames) {
    in.report(fmt::format("says that it has {} frames, more than the {} that are read", count->front(),
                          kMostFrames));
    return 1;
  }
  return count->front();
}

// Objects whose frames are no slices.
void check_kind(AttributeReader& in) {
  const std::string sop_class = in.text(DCM_SOPClassUID);
  if (sop_class == UID_SegmentationStorage) {
    in.report("is a DICOM segmentation, which can be imported as labels");
  } else if (sop_class == UID_ParametricMapStorage) {
    in.report("holds a parametric map (ParametricMapStorage), not an image");
  }
}

// The Image Pixel module (PS3.3 C.7.6.3).
void read_pixel_format(AttributeReader& in, SliceHeader& header) {
  const std::string colours = in.text(DCM_PhotometricInterpretation);
  if (const auto samples = in.whole(DCM_SamplesPerPixel, 1, 4); samples > 1) {
    in.report(fmt::format("{} is {} ({}): a colour image, not values", name_of(DCM_SamplesPerPixel), samples,
                          colours));
  }
  header.is_monochrome1 = colours == "MONOCHROME1";
  if (colours != "MONOCHROME1" && colours != "MONOCHROME2") {
    in.report(fmt::format("{} is '{}', not MONOCHROME1 or MONOCHROME2",
                          name_of(DCM_PhotometricInterpretation), colours.substr(0, 80)));
  }
  header.frame_rows = header.rows = in.whole(DCM_Rows, 1, 65535);
  header.frame_columns = header.columns = in.whole(DCM_Columns, 1, 65535);
  header.bits_allocated = static_cast<int>(in.whole(DCM_BitsAllocated, 1, 64));
  if (const int bits = header.bits_allocated; bits != 0 && bits != 8 && bits != 16 && bits != 32) {
    in.report(fmt::format("{} is {}, not 8, 16 or 32", name_of(DCM_BitsAllocated), bits));
  }
  header.bits_stored = static_cast<int>(in.whole(DCM_BitsStored, 1, header.bits_allocated));
  header.high_bit =
      static_cast<int>(in.whole(DCM_HighBit, header.bits_stored - 1, header.bits_allocated - 1));
  header.is_signed = in.whole(DCM_PixelRepresentation, 0, 1) == 1;
}

// PixelPaddingValue is written with sign or without, whatever the pixels are.
void read_padding(const AttributeReader& in, SliceHeader& header) {
  header.padding = in.number(DCM_PixelPaddingValue);
  if (!header.padding) return;
  const double range = std::ldexp(1.0, header.bits_allocated);
  if (header.is_signed && *header.padding >= range / 2.0) *header.padding -= range;
  if (!header.is_signed && *header.padding < 0.0) *header.padding += range;
}

// Of a file without pixel data: whether it is an image that has lost them (and belongs to a series, which is
// then incomplete), or why it is something else.
ImageResult<void> require_image(DcmFileFormat& loaded, const SliceHeader& header) {
  OFString sop_class;
  if (loaded.getDataset()->findAndGetOFString(DCM_SOPClassUID, sop_class).bad()) {
    loaded.getMetaInfo()->findAndGetOFString(DCM_MediaStorageSOPClassUID, sop_class);
  }
  const bool has_rows = loaded.getDataset()->tagExists(DCM_Rows);
  if (sop_class.empty() && !has_rows) {
    return fail(ErrorKind::input, "{}: is damaged: {} is missing", header.file.string(),
                name_of(DCM_SOPClassUID));
  }
  const char* known = dcmFindNameOfUID(sop_class.c_str());
  const std::string what = known != nullptr ? known : std::string(sop_class.c_str()).substr(0, 80);
  if (sop_class == UID_RTStructureSetStorage) {
    return fail(ErrorKind::input, "{}: is a structure set, which can be imported as labels",
                header.file.string());
  }
  if (!has_rows && !dcmIsImageStorageSOPClassUID(sop_class.c_str())) {
    return tl::unexpected<Refusal>(
        {{ErrorKind::input, fmt::format("{}: holds no image ({})", header.file.string(), what)},
         Refusal::Kind::no_slice});
  }
  if (!has_rows && header.series_uid.empty()) {
    return fail(ErrorKind::input, "{}: is damaged: {} without an image", header.file.string(), what);
  }
  return {};
}

// The header of a file that cannot be parsed.
SliceHeader header_without_image(const fs::path& file, const Preflight& checked) {
  SliceHeader header;
  header.file = file;
  header.series_uid = checked.series_uid;
  if (checked.syntax != nullptr) header.transfer_syntax = checked.syntax->uid;
  header.problem = describe(checked);
  return header;
}

// The dataset's own attributes, which hold for all its frames.
ImageResult<SliceHeader> read_whole(DcmFileFormat& loaded, const fs::path& file,
                                    const TransferSyntax& syntax) {
  DcmDataset& dataset = *loaded.getDataset();
  SliceHeader header;
  header.file = file;
  AttributeReader in(dataset, header.problem);
  header.study_uid = in.name(DCM_StudyInstanceUID);
  header.series_uid = in.name(DCM_SeriesInstanceUID);
  header.frame_of_reference_uid = in.name(DCM_FrameOfReferenceUID);
  header.sop_class_uid = in.name(DCM_SOPClassUID);
  header.sop_instance_uid = in.name(DCM_SOPInstanceUID);
  header.modality = in.name(DCM_Modality);
  header.description = tidied(in_utf8(in.text(DCM_SeriesDescription), in.text(DCM_SpecificCharacterSet)));
  header.date = iso_date(in.text(DCM_StudyDate));
  header.patient = read_patient(dataset, header.date);
  header.transfer_syntax = syntax.uid;
  header.is_lossy = syntax.is_lossy || in.text(DCM_LossyImageCompression) == "01";

  DcmElement* element = nullptr;
  if (dataset.findAndGetElement(DCM_PixelData, element).bad() || element == nullptr) {
    if (auto image = require_image(loaded, header); !image) return refused(image);
    in.report(fmt::format("{} is missing", name_of(DCM_PixelData)));
  }
  check_kind(in);
  header.frames = read_number_of_frames(in);
  read_pixel_format(in, header);
  header.has_burned_in_text = in.text(DCM_BurnedInAnnotation) == "YES";
  read_position(in, header);
  read_orientation(in, header);
  read_pixel_spacing(in, header);
  read_detector_spacing(in, header);
  read_thickness(in, header);
  read_rescale(in, header);
  read_window(in, header);
  read_padding(in, header);
  read_traits(in, header.traits);
  read_quantity(dataset, header);
  if (dynamic_cast<DcmPixelData*>(element) == nullptr) {
    in.report(fmt::format("{} is not pixel data", name_of(DCM_PixelData)));
  }
  return header;
}

// A header for each slice; one with the problem of the file where there is any.
ImageResult<std::vector<SliceHeader>> read_slices(DcmFileFormat& loaded, const fs::path& file,
                                                  const Preflight& checked) {
  auto whole = read_whole(loaded, file, *checked.syntax);
  if (!whole) return refused(whole);
  std::vector<SliceHeader> slices;
  DcmDataset& dataset = *loaded.getDataset();
  if (!whole->problem.empty()) {
    slices.push_back(std::move(*whole));
  } else if (whole->frames == 1 && is_mosaic(dataset)) {
    slices = read_tiles(dataset, *whole);
  } else {
    slices = read_frames(dataset, *whole);
  }
  for (SliceHeader& slice : slices) apply_mapping(slice);
  std::string& problem = slices.front().problem;
  if (checked.verdict != Preflight::Verdict::good && problem.empty()) {
    problem = describe(checked);
    slices.resize(1);
  }
  return slices;
}

// Of a file that may not be parsed.
Refusal::Kind kind_of(Preflight::Verdict verdict) {
  if (verdict == Preflight::Verdict::not_dicom) return Refusal::Kind::not_dicom;
  return verdict == Preflight::Verdict::damaged ? Refusal::Kind::damaged : Refusal::Kind::no_slice;
}

}  // namespace

ImageResult<ImageFile> open_image(const fs::path& file) {
  auto opened = check_dicom(file);
  if (!opened) return pass_on(opened);
  ImageFile image{{}, std::move(opened->checked), std::move(opened->bytes)};
  if (!image.checked.may_be_parsed()) {
    // A damaged file that still names its series makes that series incomplete: it must not go unnoticed.
    image.slices.push_back(header_without_image(file, image.checked));
    if (!image.checked.series_uid.empty()) return image;
    return tl::unexpected<Refusal>(
        {{ErrorKind::input, fmt::format("{}: {}", file.string(), image.slices.front().problem)},
         kind_of(image.checked.verdict)});
  }
  DcmFileFormat loaded;
  // In the transfer syntax of the preflight, so that both read the same tags.
  if (const auto problem = parse_dicom(*image.bytes, *image.checked.syntax, loaded); !problem.empty()) {
    return fail(ErrorKind::input, "{}: is damaged: {}", file.string(), problem);
  }
  auto slices = read_slices(loaded, file, image.checked);
  if (!slices) return refused(slices);
  image.slices = std::move(*slices);
  return image;
}

ImageResult<std::vector<SliceHeader>> read_slice_headers(const fs::path& file) {
  auto image = open_image(file);
  if (!image) return refused(image);
  return std::move(image->slices);
}

}  // namespace tidemark::imaging
