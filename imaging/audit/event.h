// The events that a hospital has to be able to prove: who opened, asked for, brought, sent or exported whose
// study.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"

namespace tidemark::imaging {

// Whose study it is, as far as that is known, and how much of it took part.
struct AuditedStudy {
  std::string patient_id;                       // (0010,0020)
  std::string patient_name;                     // in UTF-8, as Patient has it
  std::string study_uid;                        // (0020,000D)
  std::map<std::string, std::int64_t> objects;  // by SOP class UID (0008,0016)

  [[nodiscard]] bool is_known() const {
    return !patient_id.empty() || !patient_name.empty() || !study_uid.empty();
  }
  bool operator==(const AuditedStudy&) const = default;
  [[nodiscard]] bool is_same_study(const AuditedStudy& other) const {
    return patient_id == other.patient_id && patient_name == other.patient_name &&
           study_uid == other.study_uid;
  }
};

// Adds the objects to those of the same study, or as another one.
void add_study(std::vector<AuditedStudy>& studies, const AuditedStudy& study);

// The other side of a conversation.
struct AuditedPeer {
  std::string host;          // or an IPv4 address; empty: there is none
  std::string url;           // of a service by DICOMweb
  std::string ae_title;      // empty by DICOMweb
  std::string own_ae_title;  // by which it knows us
};

struct AuditEvent {
  enum class Kind {
    started,   // the program
    stopped,   // the program
    accessed,  // images were loaded
    received,  // objects came from a peer
    sent,      // objects went to a peer
    exported,  // files were written, or copies given to a peer
    imported,  // results of others were read
    queried,   // a peer was asked for studies or series
  };
  Kind kind = Kind::accessed;
  AuditedStudy study = {};                        // not of started, stopped and queried
  std::string failure = {};                       // the reason; empty: it succeeded
  AuditedPeer peer = {};                          // of received, sent, queried, and copies given to one
  std::vector<std::filesystem::path> files = {};  // that were written or read
  bool is_deidentified = false;                   // what was exported, unlike the study that it was made of
  std::string query = {};        // by DICOM: a dataset, explicit little endian; else the request
  std::string query_class = {};  // SOP class UID of the query; empty by DICOMweb
  std::chrono::system_clock::time_point time = std::chrono::system_clock::now();
};

// Takes events from any thread.
class AuditSink {
 public:
  virtual ~AuditSink() = default;
  virtual void take(const AuditEvent& event) = 0;
};

// Where all events of this process go from now on; null: nowhere, as it is at first.
void set_audit_sink(std::shared_ptr<AuditSink> sink);

void record_audit(const AuditEvent& event);
// The same event for each of the studies.
void record_audit(AuditEvent event, const std::vector<AuditedStudy>& studies);

// The reason for AuditEvent::failure.
[[nodiscard]] std::string failure_of(const Status& status);

// Records that files of a study were written, or could not be, and hands `status` on.
Status exported(Status status, const AuditedStudy& study, const std::vector<std::filesystem::path>& files);

}  // namespace tidemark::imaging
