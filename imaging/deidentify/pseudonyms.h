// New UIDs, patients and days for old ones, the same in all files of a run.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "core/result.h"
#include "imaging/deidentify/options.h"

namespace tidemark::imaging {

struct Pseudonym {
  std::string id;
  std::string name;
  int days = 0;  // by which dates are moved
};

// In UTF-8, so that it is the same in files of different character sets.
struct PatientIdentity {
  std::string id;      // or whatever else tells patients apart
  std::string issuer;  // IssuerOfPatientID (0010,0021); empty where the file has none
};

class Pseudonyms {
 public:
  explicit Pseudonyms(const DeidentifyOptions& options) : options_(options) {}

  // UIDs with backslashes between them. Those of DICOM itself (1.2.840.10008: classes, transfer syntaxes,
  // coding schemes, frames of reference of atlases) stay.
  [[nodiscard]] std::string uids(std::string_view values);

  // Fails (ErrorKind::usage) on a second patient where the options give an ID or a name.
  [[nodiscard]] Result<Pseudonym> patient(const PatientIdentity& identity);

  // Whoever has these can undo the de-identification.
  [[nodiscard]] const std::map<std::string, std::string>& known_uids() const { return uids_; }
  [[nodiscard]] const std::map<std::string, Pseudonym>& known_patients() const { return patients_; }

 private:
  [[nodiscard]] std::string known_as(const PatientIdentity& patient);

  DeidentifyOptions options_;
  std::map<std::string, std::string> uids_;
  std::map<std::string, Pseudonym> patients_;
  std::map<std::string, std::string> first_issuers_;  // by ID
};

}  // namespace tidemark::imaging
