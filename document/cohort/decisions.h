// Decisions of people about the cases of a cohort, as a table.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "document/cohort/cohort_folder.h"

namespace tidemark::cohort {

struct Decision {
  std::string id;
  enum class Verdict { none, accepted, rejected } verdict = Verdict::none;
  std::string comment;
  bool operator==(const Decision&) const = default;
};

// "accept", "reject", or nothing.
[[nodiscard]] std::string_view word_of(Decision::Verdict verdict);

// The table that the report's page and the desktop save: id, decision (accept, reject or nothing), comment.
// Fails (ErrorKind::input) naming file, line and column.
Result<std::vector<Decision>> load_decisions(const std::filesystem::path& file);
// Those that the cohort's folder keeps; none where there are none. Fails likewise.
Result<std::vector<Decision>> load_decisions(const CohortFolder& folder);

// Keeps a decision in the cohort's folder, in the place of that which was there `before`; one without verdict
// and comment takes it away. Others may do so at the same time, on other machines too. Fails
// (ErrorKind::usage) where somebody else has decided meanwhile, (ErrorKind::write), and as load_decisions().
Status decide(const CohortFolder& folder, const Decision& before, const Decision& decision);

}  // namespace tidemark::cohort
