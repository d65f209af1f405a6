// The profile, applied to a dataset and the items of its sequences. Private to this folder.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "imaging/deidentify/changes.h"
#include "imaging/deidentify/options.h"
#include "imaging/deidentify/pseudonyms.h"

class DcmDataset;
class DcmElement;
class DcmItem;
class DcmTagKey;

namespace tidemark::imaging {

class Cleaner {
 public:
  // `pseudonyms` must outlive the cleaner.
  Cleaner(const DeidentifyOptions& options, Pseudonyms& pseudonyms)
      : options_(options), pseudonyms_(pseudonyms) {}

  // Sequences are at most as deep as the preflight lets pass. Fails (ErrorKind::usage) as
  // Pseudonyms::patient() does, (ErrorKind::internal) when an attribute cannot be set.
  [[nodiscard]] Status clean(DcmDataset& dataset);

  // Of all datasets so far.
  [[nodiscard]] const ChangeCounts& counts() const { return counts_; }
  // Of the last dataset; empty with RecordedChanges::counts.
  [[nodiscard]] std::vector<ChangedAttribute> take_changes() { return std::move(changes_); }

 private:
  void clean_item(DcmItem& item, const std::string& path, bool is_all_text_replaced);
  std::unique_ptr<DcmElement> cleaned(std::unique_ptr<DcmElement> element, const std::string& path,
                                      bool is_all_text_replaced);
  std::unique_ptr<DcmElement> kept(std::unique_ptr<DcmElement> element, const std::string& path,
                                   bool is_all_text_replaced);
  std::unique_ptr<DcmElement> with_text(std::unique_ptr<DcmElement> element, const std::string& path,
                                        const std::string& text, Change change);
  [[nodiscard]] bool records() const { return options_.record != RecordedChanges::counts; }
  void note(const DcmTagKey& key, const std::string& path, Change change);

  DeidentifyOptions options_;
  Pseudonyms& pseudonyms_;
  int days_ = 0;  // of the dataset's patient
  ChangeCounts counts_;
  std::vector<ChangedAttribute> changes_;
};

// The patient's ID with its issuer, or what else tells whose the dataset is: the name, or the study.
[[nodiscard]] PatientIdentity identity_of(DcmDataset& dataset);

}  // namespace tidemark::imaging
