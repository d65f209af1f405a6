// The origin of a case's volume.
#pragma once

#include <filesystem>
#include <string>

#include "imaging/grid_policy.h"

namespace tidemark::document {

// The facts by which the volume is found again.
struct StudyOrigin {
  std::filesystem::path path;  // empty: made here (phantom)
  std::string series_uid;
  imaging::GridPolicy policy;  // by which its slices were made a grid
  std::string phantom;         // its kind, where the volume is a phantom
  std::string checksum;        // SHA-256 of the volume's voxels and geometry, hexadecimal (see checksum.h)
  // For people who have to choose; never the patient's name.
  std::string name;  // as in titles
  std::string date;  // of the study: "2004-07-31"; empty when unknown

  bool operator==(const StudyOrigin&) const = default;
};

}  // namespace tidemark::document
