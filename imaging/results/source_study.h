// The patient and study of a result, and the images that it was made from. Private to this folder.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "imaging/results/dicom_object.h"
#include "imaging/results/results.h"

namespace tidemark::imaging {

struct SourceImage {
  std::string sop_class_uid;
  std::string sop_instance_uid;
  std::filesystem::path file;
};

// The image that shows a slice, and of an image of several frames those at its place, from 1: one, or as many
// as there are times, echoes and so on.
struct SourcePlace {
  std::size_t image = 0;
  std::vector<std::uint16_t> frames;
};

// How an image was compressed with loss (PS3.3 C.7.6.1.1.5), a value for each time; empty where it is not
// known.
struct SourceLoss {
  std::string ratio;   // (0028,2112)
  std::string method;  // (0028,2114)
};

struct SourceStudy {
  // The attributes of the source's first file but for pixels: patient, study, frame of reference. Text is
  // UTF-8.
  std::unique_ptr<DcmFileFormat> first;
  std::string study_uid;
  std::string series_uid;  // empty: there is nothing to refer to
  std::string frame_of_reference_uid;
  std::vector<SourceImage> images;                 // each once, in slice order
  std::optional<SourceLoss> loss;                  // of the first image that has lost by compression
  std::vector<std::optional<SourcePlace>> places;  // for each slice k of the grid, where there is one

  [[nodiscard]] DcmDataset& attributes() const { return *first->getDataset(); }
};

// Reads the files; without files it makes a new study of an anonymous patient. UIDs that are missing
// are new. Fails (ErrorKind::input) when a file cannot be read, or lies beside its slice of the grid.
Result<SourceStudy> source_study(SourceFiles files, const Geometry& geometry);

}  // namespace tidemark::imaging
