// A PACS, asked, fetched from and given to over DICOM's network protocol.
//
// Every function takes as long as the server does, up to its time-outs: call them on a thread of their own. A
// request to stop (Progress::stop) ends them within a second with ErrorKind::cancelled. Failures are
// ErrorKind::input, name the server and say what went wrong; no message holds a patient's data.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "imaging/pacs/configuration.h"

namespace tidemark::imaging {

// Digits and dots, at most 64, beginning with a digit (DICOM PS3.5 9.1).
[[nodiscard]] bool is_uid(const std::string& text);

// Whether the server is there and knows us (C-ECHO). Returns the seconds that its answer took.
Result<double> pacs_echo(const PacsServer& server, const Progress& progress = {});

// Empty fields are not asked for. Texts may hold the wildcards * and ?.
struct StudyQuery {
  std::string uid;           // of the study itself; the other keys may then be empty
  std::string patient_name;  // as DICOM writes it: Family^Given
  std::string patient_id;
  std::string date_from;  // 2004-07-31 or 20040731, inclusive
  std::string date_to;
  std::string modality;  // of a series in the study: "CT", "MR"
  std::string description;

  bool operator==(const StudyQuery&) const = default;
};
struct PacsStudy {
  std::string uid;
  std::string patient_name;  // as it came, in UTF-8: Family^Given=ideographic=phonetic
  std::string patient_id;
  std::string birth_date;  // "1970-01-31"; empty when unknown
  std::string date;        // "2004-07-31"
  std::string description;
  std::vector<std::string> modalities;
  std::optional<std::int64_t> series;  // how many there are, where the server says it
  std::optional<std::int64_t> objects;
};

struct SeriesQuery {
  std::string study_uid;
  std::string modality;
  std::string description;
};
struct PacsSeries {
  std::string uid;
  std::string study_uid;
  std::string number;
  std::string modality;
  std::string description;
  std::string date;
  std::string body_part;
  std::optional<std::int64_t> objects;
};

template <class Entry>
struct Found {
  std::vector<Entry> entries;
  bool more = false;  // the server had more than were taken (PacsLimits::answers)
};

Result<Found<PacsStudy>> find_studies(const PacsServer& server, const StudyQuery& query,
                                      const PacsLimits& limits = {}, const Progress& progress = {});
Result<Found<PacsSeries>> find_pacs_series(const PacsServer& server, const SeriesQuery& query,
                                           const PacsLimits& limits = {}, const Progress& progress = {});
// "Doe, Jane" of "Doe^Jane"; other scripts follow after a slash.
[[nodiscard]] std::string readable_name(const std::string& dicom_name);

struct RetrieveRequest {
  std::string study_uid;
  std::string series_uid;        // empty: the whole study
  std::filesystem::path folder;  // made, or empty; objects come into it as 000001.dcm and so on
};
struct Retrieved {
  std::vector<std::filesystem::path> files;
  std::int64_t bytes = 0;
  std::int64_t missing = 0;           // objects that the server could not send
  std::vector<std::string> refused;   // the reasons for objects that came and were not taken
  std::string damaged;                // the first of them for one that may have been wanted; empty: none
  std::vector<AuditedStudy> studies;  // whose the files are
};
// Brings a series or a study as the server's `retrieve` says; by move, one at a time for each user and port
// of this machine. Objects are checked and get names of ours. The folder holds them when all have come; when
// it fails, or is killed before, nothing is in it.
Result<Retrieved> retrieve(const PacsServer& server, const RetrieveRequest& request,
                           const PacsLimits& limits = {}, const Progress& progress = {});

struct Unsent {
  std::filesystem::path file;
  std::string reason;
};
struct Sent {
  std::int64_t objects = 0;
  std::int64_t bytes = 0;
  std::vector<Unsent> unsent;  // not DICOM, not wanted by the server in their encoding, or refused by it
};
// Sends DICOM files unchanged: compressed pixels stay compressed, so that a server that does not take the
// encoding does not get the file. Uncompressed ones may change their byte order.
Result<Sent> send_files(const PacsServer& server, const std::vector<std::filesystem::path>& files,
                        const Progress& progress = {});

}  // namespace tidemark::imaging
