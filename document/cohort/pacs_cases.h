// Cases whose studies a PACS has: found by a query, and brought when they are computed.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "core/progress.h"
#include "core/result.h"
#include "document/cohort/work_list.h"
#include "imaging/pacs/services.h"

namespace tidemark::cohort {

struct PacsQuery {
  imaging::StudyQuery studies;     // of a modality
  std::string series_description;  // may hold wildcards; empty: any
  bool operator==(const PacsQuery&) const = default;
};

// A case for each series of that modality and description in the studies that match, by their UIDs. Servers
// need not know all keys: what does not match is left out. Nothing is brought. Fails (ErrorKind::input)
// naming the server, also where it has more studies than a query may answer: none is left out in silence.
Result<WorkList> find_in_pacs(const imaging::PacsServer& server, const PacsQuery& query,
                              const imaging::PacsLimits& limits, const Progress& progress = {});

// What is wrong with a row of such a case; empty: nothing.
[[nodiscard]] std::string problem_with_server(const WorkRow& row, const imaging::PacsConfiguration& servers);

// The servers that cases are on, by a file of servers, or by the usual one where it is empty; none where the
// cases are on none. Fails as read_pacs_configuration().
Result<imaging::PacsConfiguration> servers_of(const std::filesystem::path& file,
                                              std::span<const WorkRow> rows);

// Brings the series of a case into a folder that is empty or not there, all of its objects or none. Fails as
// imaging::retrieve() does.
Status bring_series(const imaging::PacsConfiguration& servers, const WorkRow& row,
                    const std::filesystem::path& folder, const Progress& progress = {});

}  // namespace tidemark::cohort
