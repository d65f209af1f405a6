// A client of servers with models that works beside the user interface.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "document/drive.h"
#include "document/start.h"
#include "engine/job_runner.h"
#include "imaging/ai/ai_services.h"

namespace tidemark::engine {

// What a model has found in a volume.
struct ModelFinding {
  std::string model;
  imaging::AiAnswer answer;
  std::shared_ptr<const imaging::Segments> segments;  // by its labels, or where a probability is one half
  std::vector<double> ml;                             // the volume of each
};

class ModelClient : public JobRunner {
  Q_OBJECT
 public:
  explicit ModelClient(QObject* parent = nullptr);

  // Each ends with its signal, with failed() or with cancelled().
  void list(const imaging::AiServer& server);
  // The request's clicks are those of the strokes (null: none), one a stroke.
  void ask(const imaging::AiServer& server, std::shared_ptr<const Volume> volume,
           const imaging::AiRequest& request, std::shared_ptr<const solver::Strokes> strokes);
  // The finding as a start, of the label with that number or of all (0).
  void make_start(std::shared_ptr<const ModelFinding> finding, int label);
  // The finding as a map in a file, where sessions find it again.
  void write_map(std::shared_ptr<const ModelFinding> finding, int label, const std::filesystem::path& file);

  void cancel() { give_up(); }

 signals:
  void listed(std::shared_ptr<const std::vector<tidemark::imaging::AiModel>> models);
  void found(std::shared_ptr<const tidemark::engine::ModelFinding> finding);
  void start_made(const tidemark::document::Start& start);
  void map_written(std::shared_ptr<const tidemark::document::SpeedMap> map);
};

}  // namespace tidemark::engine
