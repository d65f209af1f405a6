// What was found under a path, before any voxel is read.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/geometry.h"
#include "imaging/patient.h"

namespace tidemark {

class StudyArchive;

// A series of DICOM files, or one volume file, that may make a volume.
struct Series {
  std::string uid;                             // DICOM Series Instance UID; for a volume file, its file name
  std::string modality;                        // DICOM (0008,0060); empty for volume files
  std::string description;                     // DICOM (0008,103E), else the file name
  std::string date;                            // of the study: "2004-07-31"; empty when unknown
  Patient patient;                             // of the first image; empty for volume files
  std::vector<std::filesystem::path> files;    // in slice order when loadable
  Geometry geometry;                           // meaningful when loadable
  std::string scalar;                          // of the volume when loaded: "int16", "uint16" or "float"
  std::string unit;                            // of the values: "HU", "SUVbw g/ml"; empty when they have none
  double value_scale = 1.0;                    // by which rescaled values are multiplied to have that unit
  std::vector<std::string> transfer_syntaxes;  // UIDs, each once; empty for volume files
  bool loadable = false;
  std::string reason;                 // why it is not loadable: one line that names the files at fault
  std::vector<std::string> changes;   // what loading will change, e.g. "slices sorted by position"
  std::vector<std::string> warnings;  // what a user should know, e.g. "3 slices are missing their window"
  // In which the files lie; null for files that were there already. They stay as long as somebody holds it.
  std::shared_ptr<const StudyArchive> archive;
};

struct SkippedFile {
  std::filesystem::path file;
  std::string reason;
};

struct Catalogue {
  std::vector<Series> series;
  std::vector<SkippedFile> skipped;
};

}  // namespace tidemark
