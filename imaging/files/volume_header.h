// The header of a volume file, checked: the geometry as ITK understands it, the voxels as we do. Private to
// this folder.
#pragma once

#include "core/geometry.h"
#include "imaging/files/itk_io.h"

namespace tidemark::imaging::files {

struct VolumeHeader {
  PixelLayout layout = {};
  Geometry geometry = {};
  std::string scalar = {};  // of the volume: "int16", "uint16" or "float"
  std::vector<std::string> changes = {};
  std::vector<std::string> warnings = {};
};

// The checks before memory is allocated for voxels: three axes (a fourth of size 1 is ignored),
// a scalar type, spacing finite and above 0, origin finite, axes at right angles within 1e-3 (smaller
// deviations are removed), and bytes on disk for all voxels. An ItkScope must live. Fails (ErrorKind::input)
// naming the file and the field.
Result<VolumeHeader> check_header(const std::filesystem::path& file);

}  // namespace tidemark::imaging::files
