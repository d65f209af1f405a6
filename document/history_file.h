// The history of a case in its session file: entries of the archive beside the session's own.
//
// history.json: the states, parents before their children. Of recipe, wanted drive and curve a state has what
// its parent (the first state: the session) has not. history.tables: for each state int32 a virtual page, as
// phi.table has them; history.pages: float, the pages that they name. Numbers are little-endian.
#pragma once

#include <string>
#include <vector>

#include "core/json/json_document.h"
#include "document/saved_history.h"
#include "document/zip_archive.h"

namespace tidemark::document {

struct SessionContents;

inline constexpr std::string_view kHistoryJson = "history.json";
inline constexpr std::string_view kHistoryTables = "history.tables";
inline constexpr std::string_view kHistoryPages = "history.pages";
inline constexpr JsonLimits kHistoryLimits{.bytes = std::size_t{64} << 20};  // of history.json

// The entries' bytes, as long as they are written.
struct HistoryEntries {
  std::string json;
  FieldBytes phi;

  [[nodiscard]] std::vector<ZipEntry> entries() const;
};
// Of contents with a history. The states farthest from the present one are left out, as for_file() does it,
// where history.json could not be read again within the limits.
HistoryEntries history_entries(const SessionContents& contents, const JsonLimits& limits = kHistoryLimits);

// Into contents that are read but for their history; an archive without one has an empty history. Fails
// (ErrorKind::input) naming the file and what is wrong in it.
Status read_history(ZipReader& archive, SessionContents& contents, const std::string& file);

}  // namespace tidemark::document
