// DICOM files made anonymous, by the Basic Application Level Confidentiality Profile (DICOM PS3.15 E.2).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/atomic_file.h"
#include "core/progress.h"
#include "core/result.h"
#include "imaging/audit/event.h"
#include "imaging/deidentify/changes.h"
#include "imaging/deidentify/options.h"
#include "imaging/deidentify/pseudonyms.h"

namespace tidemark::imaging {

struct DeidentifiedFile {
  std::filesystem::path source;
  std::string name;                       // in the new folder: "series-001/000001.dcm"
  std::string risk;                       // why its pixels may show who it is; empty where nothing says so
  std::vector<ChangedAttribute> changes;  // with RecordedChanges::each
};

struct LeftOutFile {
  enum class Kind {
    not_dicom,
    document,    // a structured report, an encapsulated document, a voice, a DICOMDIR
    risky,       // an image that may show who it is
    unreadable,  // it cannot be opened, is damaged, or in an encoding that is not read
  };
  std::filesystem::path file;
  std::string reason;  // one line, without the file's name
  Kind kind = Kind::not_dicom;
};

struct Deidentified {
  AtomicFolder folder;  // to be committed
  std::vector<DeidentifiedFile> files;
  std::vector<LeftOutFile> left_out;
  ChangeCounts counts;
  std::vector<ChangeTotal> totals;  // in the order of the paths; none with RecordedChanges::counts
  std::int64_t series = 0;
  // What undoes it: old to new.
  std::map<std::string, std::string> uids;
  std::map<std::string, Pseudonym> patients;
  std::vector<AuditedStudy> studies;  // that the copies were made of, under their own names
};

// Writes the files, each in the encoding that it has (a deflated one inflated), into a new folder that takes
// the place of `folder` when the result's is committed, in folders by series and under names that tell
// nothing. Pixels are not changed. The same UID and the same patient become the same new ones in all files.
// What cannot be made anonymous is left out, and named. Fails (ErrorKind::input) when nothing is left,
// (ErrorKind::usage) when the options do not fit the files, (ErrorKind::write), or (ErrorKind::cancelled).
[[nodiscard]] Result<Deidentified> deidentify(const std::vector<std::filesystem::path>& files,
                                              const std::filesystem::path& folder,
                                              const DeidentifyOptions& options,
                                              const Progress& progress = {});

}  // namespace tidemark::imaging
