#include "document/cohort/review_list.h"

#include <unordered_map>
#include <utility>

#include "document/cohort/review.h"

namespace tidemark::cohort {

Result<ReviewList> load_review_list(const CohortFolder& folder, const Progress& progress) {
  auto plan = folder.load_plan();
  if (!plan) return pass_on(plan);
  auto list = folder.load_work_list();
  if (!list) return pass_on(list);
  auto reviewed = review(folder, *list, progress);
  if (!reviewed) return pass_on(reviewed);

  ReviewList result{std::move(*plan), {}, std::move(reviewed->unreadable)};
  std::unordered_map<std::string, WorkRow*> rows;
  for (WorkRow& row : list->rows) rows.emplace(row.id, &row);
  std::unordered_map<std::string, std::size_t> places;
  const auto add = [&](const std::string& id, std::optional<CaseStatus> status, double unusual) {
    places.emplace(id, result.entries.size());
    result.entries.push_back({std::move(*rows.at(id)), std::move(status), unusual, {id, {}, {}}});
  };
  for (ReviewedCase& one : reviewed->cases) {
    const std::string id = one.status.id;
    add(id, std::move(one.status), one.unusual);
  }
  for (const std::string& id : reviewed->not_done) add(id, std::nullopt, 0.0);
  // The table may name cases of an earlier work list.
  for (Decision& decision : reviewed->decisions) {
    const auto place = places.find(decision.id);
    if (place != places.end()) result.entries[place->second].decision = std::move(decision);
  }
  return result;
}

}  // namespace tidemark::cohort
