// A client of a PACS that works beside the user interface.
#pragma once

#include <functional>
#include <memory>

#include "engine/job_runner.h"
#include "imaging/pacs/services.h"

namespace tidemark::engine {

class PacsClient : public JobRunner {
  Q_OBJECT
 public:
  explicit PacsClient(QObject* parent = nullptr);

  // Each ends with its signal, or with failed().
  void echo(const imaging::PacsServer& server);
  void find_studies(const imaging::PacsServer& server, const imaging::StudyQuery& query,
                    const imaging::PacsLimits& limits);
  void find_series(const imaging::PacsServer& server, const imaging::SeriesQuery& query,
                   const imaging::PacsLimits& limits);
  void retrieve(const imaging::PacsServer& server, const imaging::RetrieveRequest& request,
                const imaging::PacsLimits& limits);
  // Has files written into a new folder that only the user can read, sends them, and removes the folder.
  using WriteFiles = std::function<Result<std::vector<std::filesystem::path>>(
      const std::filesystem::path& folder, const Progress& progress)>;
  void send(const imaging::PacsServer& server, WriteFiles write);

  void cancel() { give_up(); }

 signals:
  void answered(double seconds);
  void studies_found(std::shared_ptr<const tidemark::imaging::Found<tidemark::imaging::PacsStudy>> studies);
  void series_found(const QString& study_uid,
                    std::shared_ptr<const tidemark::imaging::Found<tidemark::imaging::PacsSeries>> series);
  void retrieved(const QString& folder, std::shared_ptr<const tidemark::imaging::Retrieved> what);
  void sent(std::shared_ptr<const tidemark::imaging::Sent> what);
};

}  // namespace tidemark::engine
