// A further image of a case: another series of the patient, or any file, on a grid of its own.
#pragma once

#include <filesystem>
#include <glm/mat4x4.hpp>
#include <memory>
#include <mutex>
#include <string>

#include "core/result.h"
#include "core/volume.h"
#include "imaging/grid_policy.h"

namespace tidemark::imaging {
struct Resampled;
}

namespace tidemark::document {

struct CaseImage;

// An image on the grid of its case, kept from when it was first asked for.
class VoxelsOnGrid {
 public:
  VoxelsOnGrid() = default;
  // A copy of an image may come to lie elsewhere: it has none yet.
  VoxelsOnGrid(const VoxelsOnGrid& /*other*/) {}
  VoxelsOnGrid& operator=(const VoxelsOnGrid& other);

 private:
  friend Result<std::shared_ptr<const imaging::Resampled>> resampled(const CaseImage& image,
                                                                     const Geometry& grid);

  mutable std::mutex mutex_;
  mutable std::shared_ptr<const imaging::Resampled> voxels_;
};

// It is never overwritten: views and speed functions see it resampled. One that a recipe or a session names
// has no volume until its file is read.
struct CaseImage {
  std::string name;        // for people: the series' description or the file's name
  std::string series_uid;  // empty: not from DICOM
  std::string frame_of_reference_uid;
  std::string checksum;  // see checksum.h
  std::shared_ptr<const Volume> volume;
  // From its own patient coordinates (LPS, mm) to the case's: a registration that the user accepted.
  glm::dmat4 to_case{1.0};
  // Where it is found again; empty: not known.
  std::filesystem::path path;
  imaging::GridPolicy policy;  // by which its slices were made a grid
  VoxelsOnGrid voxels_on_grid;
};

// The image on the grid, and which voxels it covers there. Any thread; the first call takes a while and is
// not cancelled, because all that follow have its outcome. Fails (ErrorKind::usage) when the volume is
// missing, or shares no place with the grid.
Result<std::shared_ptr<const imaging::Resampled>> resampled(const CaseImage& image, const Geometry& grid);
// The same as speed functions see it: with the image's minimum in voxels that it does not cover.
Result<std::shared_ptr<const Volume>> on_grid(const CaseImage& image, const Geometry& grid);

}  // namespace tidemark::document
