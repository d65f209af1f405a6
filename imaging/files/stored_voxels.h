// The voxels of a volume file, of any format, read by the layout that was checked. Private to this folder.
//
// Not by ITK, which would open the file by its name once more, and write into memory as many voxels as the
// header then says. Its NIfTI library also turns NaN and infinity into 0, reads the voxels of a.nii.gz from
// a.nii when there is one, and adds scl_inter when there is no slope.
#pragma once

#include "core/volume.h"
#include "imaging/guard/pixel_layout.h"

namespace tidemark::imaging::files {

// The type of the volume: "int16", "uint16" or "float"; `converted` when another type than float becomes
// float for its range.
struct VolumeType {
  const char* scalar = "float";
  bool converted = false;
};
VolumeType volume_type(const PixelLayout& layout);

// Throws std::bad_alloc. Fails (ErrorKind::input) naming the file when it has not got the voxels.
Result<Volume::Voxels> read_stored_voxels(const PixelLayout& layout);

}  // namespace tidemark::imaging::files
