#include "engine/pacs_client.h"

#include <QTemporaryDir>

namespace tidemark::engine {
namespace {

Result<imaging::Sent> write_and_send(const imaging::PacsServer& server, const PacsClient::WriteFiles& write,
                                     const Progress& progress) {
  const QTemporaryDir folder;  // of this user alone
  if (!folder.isValid()) {
    return fail(ErrorKind::write, "{}: no folder can be made for the files to be sent",
                folder.path().toStdString());
  }
  const auto files = write(folder.path().toStdString(), progress.part(0, 2));
  if (!files) return pass_on(files);
  return imaging::send_files(server, *files, progress.part(1, 2));
}

}  // namespace

PacsClient::PacsClient(QObject* parent) : JobRunner(parent) {}

void PacsClient::echo(const imaging::PacsServer& server) {
  run([server](const Progress& progress) { return imaging::pacs_echo(server, progress); },
      [this](double seconds) { emit answered(seconds); });
}

void PacsClient::find_studies(const imaging::PacsServer& server, const imaging::StudyQuery& query,
                              const imaging::PacsLimits& limits) {
  run(
      [=](const Progress& progress) {
        return tidemark::imaging::find_studies(server, query, limits, progress);
      },
      [this](imaging::Found<imaging::PacsStudy>&& found) {
        emit studies_found(std::make_shared<const imaging::Found<imaging::PacsStudy>>(std::move(found)));
      });
}

void PacsClient::find_series(const imaging::PacsServer& server, const imaging::SeriesQuery& query,
                             const imaging::PacsLimits& limits) {
  run([=](const Progress& progress) { return imaging::find_pacs_series(server, query, limits, progress); },
      [this, study = QString::fromStdString(query.study_uid)](imaging::Found<imaging::PacsSeries>&& found) {
        emit series_found(study,
                          std::make_shared<const imaging::Found<imaging::PacsSeries>>(std::move(found)));
      });
}

void PacsClient::retrieve(const imaging::PacsServer& server, const imaging::RetrieveRequest& request,
                          const imaging::PacsLimits& limits) {
  run(
      [=](const Progress& progress) {
        return tidemark::imaging::retrieve(server, request, limits, progress);
      },
      [this, folder = QString::fromStdString(request.folder.string())](imaging::Retrieved&& what) {
        emit retrieved(folder, std::make_shared<const imaging::Retrieved>(std::move(what)));
      });
}

void PacsClient::send(const imaging::PacsServer& server, WriteFiles write) {
  run([server, write](const Progress& progress) { return write_and_send(server, write, progress); },
      [this](imaging::Sent&& what) { emit sent(std::make_shared<const imaging::Sent>(std::move(what))); });
}

}  // namespace tidemark::engine
