// Synthetic studies with a known answer.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/progress.h"
#include "core/volume.h"

namespace tidemark::imaging {

// A volume, its ground truth, and a start and parameters that suit it. Where there are both a threshold and
// a seed to start from, the threshold is the quick way and the seed the long one.
struct Phantom {
  std::string kind;
  Volume volume;
  Mask truth;
  double target = 0.0;  // T, in the volume's units
  double range = 1.0;   // epsilon
  double alpha = 0.5;
  std::optional<std::array<double, 4>> seed;                // i, j, k (voxels), radius (mm)
  std::optional<std::pair<double, double>> init_threshold;  // low, high, in the volume's units
  double noise_percent = 0.0;                               // standard deviation, % of the brightest tissue
  std::uint64_t random_seed = 1;
};

// "sphere", "dumbbell", "bridge", "tumour", "cortex", "organ", "junction", "head".
const std::vector<std::string_view>& phantom_kinds();

struct PhantomOptions {
  double noise_percent = -1.0;  // standard deviation in % of the brightest tissue; < 0: the kind's default
  // Of the noise; the body and the truth stay the same. The same seed gives the same voxels on every machine.
  std::uint64_t random_seed = 1;
};

// Fails (ErrorKind::usage) on an unknown kind.
Result<Phantom> make_phantom(std::string_view kind, const PhantomOptions& options = {},
                             const Progress& progress = {});

// Writes folder/series (DICOM), folder/truth.nii.gz and folder/phantom.json.
Status write_phantom(const Phantom& phantom, const std::filesystem::path& folder,
                     const Progress& progress = {});

}  // namespace tidemark::imaging
