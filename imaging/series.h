// The series found under a path, before any voxel is read.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/geometry.h"
#include "imaging/dicom/regular_grid.h"
#include "imaging/dicom/slice_number.h"
#include "imaging/patient.h"

namespace tidemark::imaging {

class StudyArchive;

// The place of a slice's pixels.
struct SliceSource {
  std::filesystem::path file;
  std::int64_t frame = 0;  // of the file's frames, from 0
  std::int64_t tile = 0;   // of a frame that shows several slices side by side, from 0, row by row

  auto operator<=>(const SliceSource&) const = default;
};

// A series of DICOM files, or a part of one, or one volume file, that may make a volume.
struct Series {
  // DICOM Series Instance UID; of a series that holds several volumes with the volume's number, "1.2.3#2";
  // for a volume file, its file name.
  std::string uid;
  std::string modality;                      // DICOM (0008,0060); empty for volume files
  std::string description;                   // DICOM (0008,103E), else the file name
  std::string date;                          // of the study: "2004-07-31"; empty when unknown
  Patient patient;                           // of the first image; empty for volume files
  std::string study_uid;                     // DICOM (0020,000D), of the first image; empty for volume files
  std::string sop_class_uid;                 // DICOM (0008,0016), of the first image; empty for volume files
  std::vector<std::filesystem::path> files;  // each once, in slice order when loadable
  std::vector<SliceSource> sources;          // of each slice, in slice order when loadable; DICOM only
  std::vector<SliceNumber> numbers;          // of the same slices
  // DICOM (0020,0052): series of one frame lie in the same patient coordinates. Empty where it is not known.
  std::string frame_of_reference_uid;
  Geometry geometry;                           // meaningful when loadable
  std::string scalar;                          // of the volume when loaded: "int16", "uint16" or "float"
  std::string unit;                            // of the values: "HU", "SUVbw g/ml"; empty when they have none
  double value_scale = 1.0;                    // by which rescaled values are multiplied to have that unit
  std::vector<std::string> transfer_syntaxes;  // UIDs, each once; empty for volume files
  bool loadable = false;
  std::string reason;                 // of not being loadable: one line that names the files at fault
  ImageStack stack;                   // the images' places; none for volume files and no stack
  GridPlan grid;                      // made of the stack; says how the user may make the series loadable
  GridPolicy policy;                  // by which it was made
  std::vector<std::string> changes;   // changes that loading will make: "slices sorted by position"
  std::vector<std::string> warnings;  // for the user: "3 slices are missing their window"
  // The archive of the files; null for files outside of one. They stay as long as it is held.
  std::shared_ptr<const StudyArchive> archive;

  // Loadable only with its gaps filled: grid.question asks the user for that.
  [[nodiscard]] bool fillable() const { return !loadable && !grid.question.empty(); }
  // Known to lie in the same patient coordinates.
  [[nodiscard]] bool shares_frame(const Series& other) const {
    return !frame_of_reference_uid.empty() && frame_of_reference_uid == other.frame_of_reference_uid;
  }
};

struct SkippedFile {
  std::filesystem::path file;
  std::string reason;
  std::filesystem::path
      unpacked{};  // where the file lies as long as its archive is held; empty outside of one
};

struct Catalogue {
  std::vector<Series> series;
  std::vector<SkippedFile> skipped;

  // The other series that are known to lie in the same patient coordinates as `one` of this catalogue.
  [[nodiscard]] std::vector<const Series*> on_the_frame_of(const Series& one) const {
    std::vector<const Series*> others;
    for (const Series& other : series) {
      if (&other != &one && one.shares_frame(other)) others.push_back(&other);
    }
    return others;
  }
};

}  // namespace tidemark::imaging
