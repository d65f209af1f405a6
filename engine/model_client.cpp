#include "engine/model_client.h"

#include "document/speed_map.h"
#include "engine/stroke_painting.h"
#include "imaging/files/volume_file.h"

namespace tidemark::engine {
namespace {

using Models = std::vector<imaging::AiModel>;

Result<ModelFinding> find(const imaging::AiServer& server, const Volume& volume,
                          const imaging::AiRequest& request, const Progress& progress) {
  auto answer = imaging::ai_segment(server, volume, request, progress);
  if (!answer) return pass_on(answer);
  auto segments = imaging::segments_of(*answer, request.model.name);
  if (!segments) return pass_on(segments);
  std::vector<double> ml;
  for (const imaging::Segment& segment : segments->list) {
    ml.push_back(static_cast<double>(segment.count()) * answer->geometry.voxel_volume_ml());
  }
  return ModelFinding{request.model.name, std::move(*answer),
                      std::make_shared<const imaging::Segments>(std::move(*segments)), std::move(ml)};
}

Result<std::shared_ptr<const document::SpeedMap>> write(const ModelFinding& finding, int label,
                                                        const std::filesystem::path& file,
                                                        const Progress& progress) {
  Volume map;
  map.geometry = finding.answer.geometry;
  map.voxels = imaging::map_of(finding.answer, label);
  TIDEMARK_TRY(imaging::write_volume_file(map, file));
  return document::load_speed_map(file, map.geometry, progress);
}

}  // namespace

ModelClient::ModelClient(QObject* parent) : JobRunner(parent) {}

void ModelClient::list(const imaging::AiServer& server) {
  run([server](const Progress& progress) { return imaging::ai_models(server, progress); },
      [this](Models&& models) { emit listed(std::make_shared<const Models>(std::move(models))); });
}

void ModelClient::ask(const imaging::AiServer& server, std::shared_ptr<const Volume> volume,
                      const imaging::AiRequest& request, std::shared_ptr<const solver::Strokes> strokes) {
  run(
      [=](const Progress& progress) {
        imaging::AiRequest clicked = request;
        if (strokes) {
          clicked.clicks.inside = middles_of_strokes(volume->geometry, strokes->inside);
          clicked.clicks.outside = middles_of_strokes(volume->geometry, strokes->outside);
        }
        return find(server, *volume, clicked, progress);
      },
      [this](ModelFinding&& finding) {
        emit found(std::make_shared<const ModelFinding>(std::move(finding)));
      });
}

void ModelClient::make_start(std::shared_ptr<const ModelFinding> finding, int label) {
  run(
      [=](const Progress&) -> Result<document::Start> {
        document::Start start;
        start.from = document::MaskStart{
            std::make_shared<const BitMask>(imaging::mask_of(finding->answer, label)), finding->model};
        return start;
      },
      [this](const document::Start& start) { emit start_made(start); });
}

void ModelClient::write_map(std::shared_ptr<const ModelFinding> finding, int label,
                            const std::filesystem::path& file) {
  run([=](const Progress& progress) { return write(*finding, label, file, progress); },
      [this](std::shared_ptr<const document::SpeedMap> map) { emit map_written(std::move(map)); });
}

}  // namespace tidemark::engine
