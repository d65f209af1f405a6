// The options of a de-identification.
#pragma once

#include <optional>
#include <string>

namespace tidemark::imaging {

// What Deidentified has of the changes. Of a large archive a list of each takes gigabytes.
enum class RecordedChanges { counts, totals, each };

// Without any: the Basic Application Level Confidentiality Profile (DICOM PS3.15 E.2) alone.
struct DeidentifyOptions {
  bool keep_uids = false;             // Retain UIDs (E.3.9)
  bool keep_device = false;           // Retain Device Identity (E.3.8)
  bool keep_institution = false;      // Retain Institution Identity (E.3.11)
  bool keep_characteristics = false;  // Retain Patient Characteristics (E.3.7): sex, age, size, weight, ...
  // Retain Longitudinal Temporal Information with Modified Dates (E.3.6): days are moved, times stay.
  bool shift_dates = false;
  std::optional<int> shift_days = {};  // of all patients; else each has a number of its own, by chance

  std::optional<std::string> patient_id = {};    // else one by chance; of one patient alone
  std::optional<std::string> patient_name = {};  // else the new ID
  bool with_risky_images = false;                // takes images that may show who it is, too
  RecordedChanges record = RecordedChanges::counts;
};

}  // namespace tidemark::imaging
