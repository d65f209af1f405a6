#include "ui/panels/history_lanes.h"

#include <algorithm>
#include <unordered_set>

namespace tidemark::ui {

std::vector<RowLanes> lanes_of(const std::vector<TreeRow>& rows) {
  std::vector<std::optional<std::uint64_t>> waiting;  // by lane: for which row its line runs down
  const auto free_lane = [&] {
    const auto free = std::find(waiting.begin(), waiting.end(), std::nullopt);
    if (free != waiting.end()) return static_cast<int>(free - waiting.begin());
    waiting.emplace_back();
    return static_cast<int>(waiting.size()) - 1;
  };
  std::unordered_set<std::uint64_t> ids;
  for (const TreeRow& row : rows) ids.insert(row.id);
  std::vector<RowLanes> lanes;
  lanes.reserve(rows.size());
  for (const TreeRow& row : rows) {
    RowLanes here;
    for (std::size_t lane = 0; lane < waiting.size(); ++lane) {
      if (!waiting[lane]) continue;
      (waiting[lane] == row.id ? here.above : here.through).push_back(static_cast<int>(lane));
    }
    here.lane = here.above.empty() ? free_lane() : here.above.front();
    for (const int lane : here.above) waiting[static_cast<std::size_t>(lane)].reset();
    here.parent_below = row.parent && ids.contains(*row.parent);
    if (here.parent_below) waiting[static_cast<std::size_t>(here.lane)] = row.parent;
    lanes.push_back(std::move(here));
  }
  return lanes;
}

}  // namespace tidemark::ui
