// A client of a PACS that works beside the user interface.
#pragma once

#include <functional>
#include <memory>

#include "engine/job_runner.h"
#include "imaging/pacs/services.h"

namespace tidemark {

class PacsClient : public JobRunner {
  Q_OBJECT
 public:
  explicit PacsClient(QObject* parent = nullptr);

  // Each ends with its signal, or with failed().
  void echo(const PacsServer& server);
  void find_studies(const PacsServer& server, const StudyQuery& query, const PacsLimits& limits);
  void find_series(const PacsServer& server, const SeriesQuery& query, const PacsLimits& limits);
  void retrieve(const PacsServer& server, const RetrieveRequest& request, const PacsLimits& limits);
  // Has files written into a new folder that only the user can read, sends them, and removes the folder.
  using WriteFiles = std::function<Result<std::vector<std::filesystem::path>>(
      const std::filesystem::path& folder, const Progress& progress)>;
  void send(const PacsServer& server, WriteFiles write);

  void cancel() { give_up(); }

 signals:
  void answered(double seconds);
  void studies_found(std::shared_ptr<const tidemark::Found<tidemark::PacsStudy>> studies);
  void series_found(const QString& study_uid,
                    std::shared_ptr<const tidemark::Found<tidemark::PacsSeries>> series);
  void retrieved(const QString& folder, std::shared_ptr<const tidemark::Retrieved> what);
  void sent(std::shared_ptr<const tidemark::Sent> what);
};

}  // namespace tidemark
