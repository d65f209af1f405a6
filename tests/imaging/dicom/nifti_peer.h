// The volumes that dcm2niix makes of a folder of DICOM files: another reader's word on the same series.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/volume.h"

namespace tidemark::test {

// The version whose volumes are compared; others convert some series otherwise.
inline constexpr const char* kPeerVersion = "v1.0.20220720";
// What `dcm2niix --version` says; empty when there is none.
[[nodiscard]] std::string peer_version();

// A volume as dcm2niix wrote it, rescaled. One of four dimensions counts as several.
struct PeerVolume {
  Index3 size{0};
  glm::dmat3 step{0.0};       // column a: from one voxel to the next along axis a, LPS mm
  glm::dvec3 origin{0.0};     // LPS mm
  std::vector<float> values;  // none of colour images
};
// Converts the files of this one folder.
[[nodiscard]] std::vector<PeerVolume> convert_folder(const std::filesystem::path& folder);

// How well the peer's volume agrees with ours, whatever the order of its axes.
enum class Agreement { same, other_values, other_grid };
[[nodiscard]] Agreement compare(const Volume& ours, const PeerVolume& peer);

}  // namespace tidemark::test
