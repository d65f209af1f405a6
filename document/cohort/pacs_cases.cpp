#include "document/cohort/pacs_cases.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <system_error>
#include <thread>

#include "core/file_lock.h"

namespace tidemark::cohort {
namespace {

namespace fs = std::filesystem;
using imaging::PacsServer;

// The lock of the port that servers send to, where they do: a port has one listener.
Result<FileLock> lock_port(const PacsServer& server, const Progress& progress) {
  if (server.retrieve == PacsServer::Retrieve::get) return FileLock();
  std::error_code error;
  const fs::path file =
      fs::temp_directory_path(error) / fmt::format("tidemark-port-{}-of-{}", server.move_port, ::geteuid());
  for (;;) {
    FileLock lock = FileLock::take(file, FileLock::Missing::make);
    if (lock || !FileLock::is_taken(file)) return lock;
    if (progress.cancelled()) return cancelled_error();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

}  // namespace

Result<WorkList> find_in_pacs(const PacsServer& server, const PacsQuery& query,
                              const imaging::PacsLimits& limits, const Progress& progress) {
  const auto studies = imaging::find_studies(server, query.studies, limits, progress);
  if (!studies) return pass_on(studies);
  const auto too_many = [&] {
    return fail(
        ErrorKind::input,
        "{}: has more than {} studies or series like that: ask for less, or raise \"answers\" in its file",
        server.name, limits.answers);
  };
  if (studies->more) return too_many();
  WorkList list;
  for (std::size_t i = 0; i < studies->entries.size(); ++i) {
    const std::string& study = studies->entries[i].uid;
    const auto series = imaging::find_pacs_series(
        server, {study, query.studies.modality, query.series_description}, limits, progress);
    if (!series) return pass_on(series);
    if (series->more) return too_many();
    for (const imaging::PacsSeries& one : series->entries) {
      WorkRow row;
      row.id = safe_id(one.uid);
      row.server = server.name;
      row.study = study;
      row.series = one.uid;
      list.rows.push_back(std::move(row));
    }
    progress(static_cast<double>(i + 1) / static_cast<double>(studies->entries.size()), "asking the server");
  }
  std::sort(list.rows.begin(), list.rows.end(), [](const WorkRow& a, const WorkRow& b) {
    return std::tie(a.study, a.series) < std::tie(b.study, b.series);
  });
  for (std::size_t i = 0; i < list.rows.size(); ++i) list.rows[i].line = i + 2;
  return list;
}

std::string problem_with_server(const WorkRow& row, const imaging::PacsConfiguration& servers) {
  const auto server = servers.server(row.server);
  if (!server) return "server: " + server.error().message;
  if (!imaging::is_uid(row.study)) return "study: '" + row.study + "' is no UID";
  if (!imaging::is_uid(row.series)) return "series: '" + row.series + "' is no UID";
  return {};
}

Result<imaging::PacsConfiguration> servers_of(const CohortPlan& plan) {
  if (plan.servers_file.empty()) return imaging::PacsConfiguration();
  return imaging::read_pacs_configuration(plan.servers_file);
}

Status bring_series(const imaging::PacsConfiguration& servers, const WorkRow& row, const fs::path& folder,
                    const Progress& progress) {
  const auto server = servers.server(row.server);
  if (!server) return pass_on(server);
  const auto port = lock_port(*server, progress);
  if (!port) return pass_on(port);
  const auto retrieved =
      imaging::retrieve(*server, {row.study, row.series, folder}, servers.limits, progress);
  if (!retrieved) return pass_on(retrieved);
  if (retrieved->missing == 0 && retrieved->refused.empty()) return {};
  std::error_code ignored;
  for (const fs::path& file : retrieved->files) fs::remove(file, ignored);
  if (!retrieved->refused.empty()) {
    return fail(ErrorKind::input, "{}: {}", row.place(), retrieved->refused.front());
  }
  return fail(ErrorKind::input, "{}: {} of its objects could not be sent", row.place(), retrieved->missing);
}

}  // namespace tidemark::cohort
