#include "studies.h"

#include <cmath>

#include "imaging/load_study.h"
#include "imaging/phantom/phantom.h"
#include "imaging/resample.h"

namespace tidemark {
namespace {

Study study_with(Volume volume, QString name) {
  auto study = std::make_shared<engine::LoadedStudy>();
  study->summary = engine::summarise(volume);
  study->parameters.target = 0.5 * (study->summary.low + study->summary.high);
  study->parameters.range = 0.25 * (study->summary.high - study->summary.low);
  study->volume = std::make_shared<const Volume>(std::move(volume));
  study->name = std::move(name);
  return study;
}

// As scanners store it, not in the floats that resampling makes.
void store_as_int16(Volume& volume) {
  std::vector<std::int16_t> voxels;
  voxels.reserve(static_cast<std::size_t>(volume.geometry.voxel_count()));
  for (const float value : std::get<std::vector<float>>(volume.voxels))
    voxels.push_back(static_cast<std::int16_t>(std::lround(value)));
  volume.voxels = std::move(voxels);
}

Study study_of(imaging::Phantom phantom, QString name) {
  auto study = std::make_shared<engine::LoadedStudy>(*study_with(std::move(phantom.volume), std::move(name)));
  study->parameters.target = phantom.target;
  study->parameters.range = phantom.range;
  study->truth = std::make_shared<const BitMask>(phantom.truth);
  study->start = engine::PhantomStart{phantom.seed, phantom.init_threshold};
  return study;
}

}  // namespace

Result<Study> phantom_study() {
  auto phantom = imaging::make_phantom("tumour");
  if (!phantom) return pass_on(phantom);
  return study_of(std::move(*phantom), QStringLiteral("phantom"));
}

Result<Study> large_phantom_study() {
  auto phantom = imaging::make_phantom("tumour");
  if (!phantom) return pass_on(phantom);
  const Geometry small = phantom->volume.geometry;
  Geometry grid = small;
  grid.size = {512, 512, 300};
  const glm::dvec3 finer = glm::dvec3(small.size) / glm::dvec3(grid.size);
  grid.spacing_mm = small.spacing_mm * finer;
  auto large = imaging::resample(phantom->volume, glm::dmat4(1.0), grid, "the phantom");
  if (!large) return pass_on(large);
  store_as_int16(large->volume);
  phantom->volume = std::move(large->volume);
  Mask truth{grid, {}};
  truth.voxels.reserve(static_cast<std::size_t>(grid.voxel_count()));
  for (std::int64_t z = 0; z < grid.size.z; ++z) {
    for (std::int64_t y = 0; y < grid.size.y; ++y) {
      for (std::int64_t x = 0; x < grid.size.x; ++x) {
        const Index3 from(glm::dvec3(x, y, z) * finer);
        truth.voxels.push_back(phantom->truth.voxels[static_cast<std::size_t>(small.offset(from))]);
      }
    }
  }
  phantom->truth = std::move(truth);
  if (phantom->seed) {
    for (int axis = 0; axis < 3; ++axis) (*phantom->seed)[static_cast<std::size_t>(axis)] /= finer[axis];
  }
  return study_of(std::move(*phantom), QStringLiteral("large phantom"));
}

Result<Study> study_of(const std::string& path) {
  auto volume = imaging::load_volume(path);
  if (!volume) return pass_on(volume);
  return study_with(std::move(*volume), QString::fromStdString(path));
}

Index3 start_of(const engine::LoadedStudy& study) {
  if (study.start && study.start->seed) {
    const auto& seed = *study.start->seed;
    return Index3(glm::dvec3(seed[0], seed[1], seed[2]));
  }
  return study.volume->geometry.size / Index3(2);
}

}  // namespace tidemark
