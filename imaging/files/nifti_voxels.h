// The voxels of a NIfTI file (see NiftiVoxels for why not by ITK). Private to this folder.
#pragma once

#include "core/volume.h"
#include "imaging/guard/pixel_layout.h"

namespace tidemark::imaging::files {

// The type of read_nifti_voxels(): "int16", "uint16" or "float"; `converted` when a type other than float
// became float for its range, and its name.
struct NiftiType {
  const char* scalar = "float";
  const char* stored = "float32";
  bool converted = false;
};
NiftiType nifti_type(const NiftiVoxels& voxels);

// Throws std::bad_alloc. layout.nifti must be set.
Result<Volume::Voxels> read_nifti_voxels(const PixelLayout& layout);

}  // namespace tidemark::imaging::files
