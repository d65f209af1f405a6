#include "engine/pacs_client.h"

#include <QCoreApplication>
#include <QTemporaryDir>

namespace tidemark {
namespace {

// Steps as imaging/pacs names them, for translators.
[[maybe_unused]] constexpr const char* kSteps[] = {
    QT_TRANSLATE_NOOP("tidemark::PacsStep", "calling the server"),
    QT_TRANSLATE_NOOP("tidemark::PacsStep", "asking the server"),
    QT_TRANSLATE_NOOP("tidemark::PacsStep", "receiving objects"),
    QT_TRANSLATE_NOOP("tidemark::PacsStep", "writing segments"),
    QT_TRANSLATE_NOOP("tidemark::PacsStep", "writing contours"),
    QT_TRANSLATE_NOOP("tidemark::PacsStep", "looking at the files"),
    QT_TRANSLATE_NOOP("tidemark::PacsStep", "sending objects"),
};

Result<Sent> write_and_send(const PacsServer& server, const PacsClient::WriteFiles& write,
                            const Progress& progress) {
  const QTemporaryDir folder;  // of this user alone
  if (!folder.isValid()) {
    return fail(ErrorKind::write, "{}: no folder can be made for the files to be sent",
                folder.path().toStdString());
  }
  const auto files = write(folder.path().toStdString(), progress.part(0, 2));
  if (!files) return tl::unexpected<Error>(files.error());
  return send_files(server, *files, progress.part(1, 2));
}

}  // namespace

PacsClient::PacsClient(QObject* parent) : JobRunner("tidemark::PacsStep", parent) {}

void PacsClient::echo(const PacsServer& server) {
  run([server](const Progress& progress) { return pacs_echo(server, progress); },
      [this](double seconds) { emit answered(seconds); });
}

void PacsClient::find_studies(const PacsServer& server, const StudyQuery& query, const PacsLimits& limits) {
  run([=](const Progress& progress) { return tidemark::find_studies(server, query, limits, progress); },
      [this](Found<PacsStudy>&& found) {
        emit studies_found(std::make_shared<const Found<PacsStudy>>(std::move(found)));
      });
}

void PacsClient::find_series(const PacsServer& server, const SeriesQuery& query, const PacsLimits& limits) {
  run([=](const Progress& progress) { return find_pacs_series(server, query, limits, progress); },
      [this, study = QString::fromStdString(query.study_uid)](Found<PacsSeries>&& found) {
        emit series_found(study, std::make_shared<const Found<PacsSeries>>(std::move(found)));
      });
}

void PacsClient::retrieve(const PacsServer& server, const RetrieveRequest& request,
                          const PacsLimits& limits) {
  run([=](const Progress& progress) { return tidemark::retrieve(server, request, limits, progress); },
      [this, folder = QString::fromStdString(request.folder.string())](Retrieved&& what) {
        emit retrieved(folder, std::make_shared<const Retrieved>(std::move(what)));
      });
}

void PacsClient::send(const PacsServer& server, WriteFiles write) {
  run([server, write](const Progress& progress) { return write_and_send(server, write, progress); },
      [this](Sent&& what) { emit sent(std::make_shared<const Sent>(std::move(what))); });
}

}  // namespace tidemark
