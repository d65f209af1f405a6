#include "document/cohort/decisions.h"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <thread>

#include "core/atomic_file.h"
#include "core/csv.h"
#include "core/text_file.h"
#include "document/cohort/lease.h"

namespace tidemark::cohort {
namespace {

// No case has such an id: a safe one does not begin so.
constexpr const char* kLease = "_decisions";
constexpr double kTurnIsStaleAfter_s = 10.0;  // a turn takes some milliseconds
constexpr auto kLongestWait = std::chrono::seconds(30);
constexpr auto kBetweenTries = std::chrono::milliseconds(20);

std::string to_text(const std::vector<Decision>& decisions) {
  std::string text = csv_line({"id", "decision", "comment"});
  for (const Decision& one : decisions)
    text += csv_line({one.id, std::string(word_of(one.verdict)), csv_text(one.comment)});
  return text;
}

// The right to write the table.
Result<Lease> take_turn(const CohortFolder& folder) {
  const auto until = std::chrono::steady_clock::now() + kLongestWait;
  for (;;) {
    auto lease = Lease::take(folder.leases(), kLease, kTurnIsStaleAfter_s);
    if (!lease) return pass_on(lease);
    if (*lease) return std::move(**lease);
    if (std::chrono::steady_clock::now() > until)
      return fail(ErrorKind::write, "{}: another program writes it", folder.decisions().string());
    std::this_thread::sleep_for(kBetweenTries);
  }
}

}  // namespace

std::string_view word_of(Decision::Verdict verdict) {
  if (verdict == Decision::Verdict::accepted) return "accept";
  return verdict == Decision::Verdict::rejected ? "reject" : "";
}

Result<std::vector<Decision>> load_decisions(const std::filesystem::path& file) {
  const auto text = read_text_file(file, CsvLimits().bytes);
  if (!text) return pass_on(text);
  const auto table = CsvTable::parse(*text, file.string());
  if (!table) return pass_on(table);
  if (table->header != std::vector<std::string>{"id", "decision", "comment"}) {
    return fail(ErrorKind::input, "{}: line 1: the columns must be id, decision, comment", file.string());
  }
  std::vector<Decision> decisions;
  for (const CsvRow& row : table->rows) {
    Decision decision{row.fields[0], Decision::Verdict::none, text_of_csv(row.fields[2])};
    if (!is_safe_id(decision.id)) {
      return fail(ErrorKind::input, "{}: line {}: id: '{}' is none of a case", file.string(), row.line,
                  decision.id);
    }
    const std::string& word = row.fields[1];
    if (word == "accept") {
      decision.verdict = Decision::Verdict::accepted;
    } else if (word == "reject") {
      decision.verdict = Decision::Verdict::rejected;
    } else if (!word.empty()) {
      return fail(ErrorKind::input, "{}: line {}: decision: '{}' is neither accept nor reject", file.string(),
                  row.line, word);
    }
    decisions.push_back(std::move(decision));
  }
  return decisions;
}

Result<std::vector<Decision>> load_decisions(const CohortFolder& folder) {
  std::error_code ignored;
  if (!std::filesystem::exists(folder.decisions(), ignored)) return std::vector<Decision>();
  return load_decisions(folder.decisions());
}

Status decide(const CohortFolder& folder, const Decision& before, const Decision& decision) {
  auto turn = take_turn(folder);
  if (!turn) return pass_on(turn);
  auto decisions = load_decisions(folder);
  if (!decisions) return pass_on(decisions);
  Decision present{decision.id, {}, {}};
  for (const Decision& one : *decisions) {
    if (one.id == decision.id) present = one;
  }
  if (present != before)
    return fail(ErrorKind::usage, "{}: somebody else has spoken of this case meanwhile", decision.id);
  std::erase_if(*decisions, [&](const Decision& one) { return one.id == decision.id; });
  if (decision.verdict != Decision::Verdict::none || !decision.comment.empty())
    decisions->push_back(decision);
  if (!turn->held())
    return fail(ErrorKind::write, "{}: another program writes it", folder.decisions().string());
  TIDEMARK_TRY(write_file(folder.decisions(), to_text(*decisions)));
  turn->finish();
  return {};
}

}  // namespace tidemark::cohort
