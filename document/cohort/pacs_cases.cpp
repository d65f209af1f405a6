#include "document/cohort/pacs_cases.h"

#include <fnmatch.h>

#include <algorithm>
#include <system_error>

namespace tidemark::cohort {
namespace {

namespace fs = std::filesystem;
using imaging::PacsServer;

// By the wildcards * and ? of a query (DICOM PS3.4 C.2.2.2.4), without regard to case, as servers may match.
// An empty pattern asks for nothing.
bool matches(const std::string& pattern, const std::string& text) {
  std::string known;  // to fnmatch, which knows more
  for (const char c : pattern) {
    if (c == '[' || c == '\\') known += '\\';
    known += c;
  }
  return pattern.empty() || ::fnmatch(known.c_str(), text.c_str(), FNM_CASEFOLD) == 0;
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
    if (!matches(query.studies.description, studies->entries[i].description)) continue;
    const std::string& study = studies->entries[i].uid;
    const auto series = imaging::find_pacs_series(
        server, {study, query.studies.modality, query.series_description}, limits, progress);
    if (!series) return pass_on(series);
    if (series->more) return too_many();
    for (const imaging::PacsSeries& one : series->entries) {
      if (!matches(query.studies.modality, one.modality)) continue;
      if (!matches(query.series_description, one.description)) continue;
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
  const auto again = std::unique(list.rows.begin(), list.rows.end());
  list.rows.erase(again, list.rows.end());
  for (std::size_t i = 0; i < list.rows.size(); ++i) list.rows[i].line = i + 2;
  list.find_double_ids(std::string(kPacsSource) + server.name);
  return list;
}

std::string problem_with_server(const WorkRow& row, const imaging::PacsConfiguration& servers) {
  const auto server = servers.server(row.server);
  if (!server) return "server: " + server.error().message;
  if (!imaging::is_uid(row.study)) return "study: '" + row.study + "' is no UID";
  if (!imaging::is_uid(row.series)) return "series: '" + row.series + "' is no UID";
  return {};
}

Result<imaging::PacsConfiguration> servers_of(const fs::path& file, std::span<const WorkRow> rows) {
  const auto is_on_server = [](const WorkRow& row) { return !row.server.empty(); };
  if (std::none_of(rows.begin(), rows.end(), is_on_server)) return imaging::PacsConfiguration();
  return imaging::read_chosen_pacs_configuration(file);
}

Status bring_series(const imaging::PacsConfiguration& servers, const WorkRow& row, const fs::path& folder,
                    const Progress& progress) {
  const auto server = servers.server(row.server);
  if (!server) return pass_on(server);
  const auto retrieved =
      imaging::retrieve(*server, {row.study, row.series, folder}, servers.limits, progress);
  if (!retrieved) return pass_on(retrieved);
  // Objects that nobody asked for, or that came twice, are refused, too: they are no loss.
  if (retrieved->missing == 0 && retrieved->damaged.empty()) return {};
  std::error_code ignored;
  for (const fs::path& object : retrieved->files) fs::remove(object, ignored);
  if (!retrieved->damaged.empty()) return fail(ErrorKind::input, "{}: {}", row.place(), retrieved->damaged);
  if (!retrieved->refused.empty()) {
    return fail(ErrorKind::input, "{}: {}", row.place(), retrieved->refused.front());
  }
  return fail(ErrorKind::input, "{}: {} of its objects could not be sent", row.place(), retrieved->missing);
}

}  // namespace tidemark::cohort
