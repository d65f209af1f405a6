#include "tests/engine/ball_study.h"

#include <glm/geometric.hpp>
#include <random>

#include "renderer/camera.h"

namespace tidemark::test {

std::shared_ptr<const engine::LoadedStudy> ball_study() {
  auto volume = std::make_shared<Volume>();
  volume->geometry.size = {48, 44, 24};
  volume->geometry.spacing_mm = {1.0, 1.0, 2.0};
  volume->modality = "CT";
  volume->unit = "HU";
  volume->window = WindowLevel{50.0, 300.0};
  const glm::dvec3 middle = renderer::middle_of(volume->geometry);
  std::mt19937 noise(1);
  std::vector<std::int16_t> voxels;
  for (std::int64_t offset = 0; offset < volume->geometry.voxel_count(); ++offset) {
    const Index3 voxel = volume->geometry.voxel_at(offset);
    const double away = glm::distance(volume->geometry.to_patient(glm::dvec3(voxel)), middle);
    const auto deviation = static_cast<int>(noise() % 11U) - 5;
    voxels.push_back(static_cast<std::int16_t>((away <= kBallRadius ? 100 : 0) + deviation));
  }
  volume->voxels = std::move(voxels);
  auto study = std::make_shared<engine::LoadedStudy>();
  study->summary = engine::summarise(*volume);
  study->volume = std::move(volume);
  study->name = QStringLiteral("Ball");
  study->parameters.target = 100.0;
  study->parameters.range = 50.0;
  study->parameters.alpha = 0.8;
  return study;
}

}  // namespace tidemark::test
