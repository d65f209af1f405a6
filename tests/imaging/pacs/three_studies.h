// Three studies on a server, and the queries that are to find some of them.
#pragma once

#include <QTest>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "imaging/pacs/services.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"

namespace tidemark::test {

// "old" of 2004-07-31 (CT), "new" of 2025-01-15 (MR) and "newest" of 2026-02-01 (CT), sent to the server.
inline void send_three_studies(const imaging::PacsServer& server) {
  const TemporaryFolder folder;
  std::vector<std::filesystem::path> files;
  for (const auto& [name, date, modality] :
       {std::tuple{"old", "20040731", "CT"}, {"new", "20250115", "MR"}, {"newest", "20260201", "CT"}}) {
    for (const auto& file : write_series(sample_volume({4, 4, 2}), folder / name, modality)) {
      set_text(file, 0x0008, 0x0020, date);
      set_text(file, 0x0008, 0x1030, name);
      files.push_back(file);
    }
  }
  QCOMPARE(failure(imaging::send_files(server, files)), QString());
}

// `knows_modalities`: of a study; some servers do not.
inline void find_some_of_three_studies(const imaging::PacsServer& server, bool knows_modalities) {
  const auto count = [&](const imaging::StudyQuery& query) {
    const auto found = imaging::find_studies(server, query);
    return found ? static_cast<int>(found->entries.size()) : -1;
  };
  const auto by = [](std::string imaging::StudyQuery::*field, const char* value) {
    imaging::StudyQuery query;
    query.*field = value;
    return query;
  };
  QCOMPARE(count({}), 3);
  QCOMPARE(count(by(&imaging::StudyQuery::date_from, "2025-01-01")), 2);
  QCOMPARE(count(by(&imaging::StudyQuery::date_to, "2025-12-31")), 2);
  imaging::StudyQuery year = by(&imaging::StudyQuery::date_from, "20250101");
  year.date_to = "20251231";
  QCOMPARE(count(year), 1);
  QCOMPARE(count(by(&imaging::StudyQuery::description, "ne*")), 2);
  QCOMPARE(count(by(&imaging::StudyQuery::patient_name, "Nobody & sons?limit=1")), 0);
  if (knows_modalities) QCOMPARE(count(by(&imaging::StudyQuery::modality, "CT")), 2);
}

}  // namespace tidemark::test
