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

class Pseudonyms {
 public:
  explicit Pseudonyms(const DeidentifyOptions& options) : options_(options) {}

  // UIDs with backslashes between them. Those of DICOM itself (1.2.840.10008: classes, transfer syntaxes,
  // coding schemes, frames of reference of atlases) stay.
  [[nodiscard]] std::string uids(std::string_view values);

  // Of the patient with that ID, or whatever else tells patients apart. Fails (ErrorKind::usage) on a second
  // patient where the options give an ID or a name.
  [[nodiscard]] Result<Pseudonym> patient(const std::string& old);

  // Whoever has these can undo the de-identification.
  [[nodiscard]] const std::map<std::string, std::string>& known_uids() const { return uids_; }
  [[nodiscard]] const std::map<std::string, Pseudonym>& known_patients() const { return patients_; }

 private:
  DeidentifyOptions options_;
  std::map<std::string, std::string> uids_;
  std::map<std::string, Pseudonym> patients_;
};

}  // namespace tidemark::imaging
