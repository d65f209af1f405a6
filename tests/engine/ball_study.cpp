#include "tests/engine/ball_study.h"

#include <QtGlobal>
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
  study->origin.phantom = "ball";
  study->parameters.target = 100.0;
  study->parameters.range = 50.0;
  study->parameters.alpha = 0.8;
  return study;
}

std::shared_ptr<const document::SessionContents> ball_without_its_map() {
  const auto study = ball_study();
  const auto made =
      document::Case::create(study->volume, study->origin, study->parameters, solver::ExecutorKind::host, {});
  if (!made) qFatal("%s", made.error().message.c_str());
  document::Start start;
  start.seeds.push_back({renderer::middle_of(study->volume->geometry), 6.0});
  if (const auto begun = (*made)->level_set().begin(start); !begun)
    qFatal("%s", begun.error().message.c_str());
  auto contents = document::snapshot_of(**made);
  if (!contents) qFatal("%s", contents.error().message.c_str());
  document::Drive drive;
  drive.setting.terms = {{"image", {}}};
  drive.map = std::make_shared<const document::SpeedMap>(document::SpeedMap{"map.nii", "none", nullptr, {}});
  contents->recipe.drive = document::shared(drive);
  contents->history = {};
  return std::make_shared<const document::SessionContents>(std::move(*contents));
}

std::shared_ptr<const engine::LoadedStudy> hopeless_study() {
  auto study = std::make_shared<engine::LoadedStudy>(*ball_study());
  study->parameters.range = 0.0;
  return study;
}

}  // namespace tidemark::test
