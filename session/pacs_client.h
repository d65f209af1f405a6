// A PACS for the user interface, which never waits for it.
#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <memory>

#include "imaging/pacs/pacs.h"

namespace tidemark {

class BackgroundJob;

// Lives on the thread of the user interface; the work is done on others. One piece of work at a time: whoever
// asks for the next gives up the one before, of which nothing is heard any more.
class PacsClient : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;
  ~PacsClient() override;  // gives up what runs, and waits for nothing

  // Each ends with its signal, or with failed().
  void echo(const PacsServer& server);
  void find_studies(const PacsServer& server, const StudyQuery& query, const PacsLimits& limits);
  void find_series(const PacsServer& server, const SeriesQuery& query, const PacsLimits& limits);
  void retrieve(const PacsServer& server, const RetrieveRequest& request, const PacsLimits& limits);
  // Has files written into a new folder that is nobody else's, sends them, and removes it.
  using WriteFiles = std::function<Result<std::vector<std::filesystem::path>>(
      const std::filesystem::path& folder, const Progress& progress)>;
  void send(const PacsServer& server, WriteFiles write);

  [[nodiscard]] bool busy() const { return job_ != nullptr; }
  void cancel();  // emits cancelled() when something was given up

 signals:
  void progressed(double fraction, const QString& step);  // below 0 when unknown
  void answered(double seconds);
  void studies_found(std::shared_ptr<const tidemark::Found<tidemark::PacsStudy>> studies);
  void series_found(const QString& study_uid,
                    std::shared_ptr<const tidemark::Found<tidemark::PacsSeries>> series);
  void retrieved(const QString& folder, std::shared_ptr<const tidemark::Retrieved> what);
  void sent(std::shared_ptr<const tidemark::Sent> what);
  void failed(const QString& message);
  void cancelled();

 private:
  template <class Work, class Deliver>
  void run(Work work, Deliver deliver);

  std::shared_ptr<BackgroundJob> job_;
};

}  // namespace tidemark
