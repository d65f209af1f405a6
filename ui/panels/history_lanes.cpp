#include "ui/panels/history_lanes.h"

#include <algorithm>
#include <array>
#include <functional>
#include <queue>
#include <unordered_map>
#include <unordered_set>

namespace tidemark::ui {
namespace {

// Places for lines beside each other, as many as there are lines; kMostLanes of them are drawn.
class Places {
 public:
  // The leftmost that is free.
  int take() {
    if (free_.empty()) return used_++;
    const int place = free_.top();
    free_.pop();
    return place;
  }
  void give_back(int place) { free_.push(place); }

 private:
  std::priority_queue<int, std::vector<int>, std::greater<>> free_;
  int used_ = 0;
};

int lane_of(int place) {
  return std::min(place, kMostLanes - 1);
}

}  // namespace

std::vector<RowLanes> lanes_of(const std::vector<TreeRow>& rows) {
  Places places;
  std::unordered_map<std::uint64_t, std::vector<int>> waiting;  // by the row that lines run down to
  std::array<int, kMostLanes> running{};                        // lines in each lane
  std::unordered_set<std::uint64_t> ids;
  for (const TreeRow& row : rows) ids.insert(row.id);
  std::vector<RowLanes> lanes;
  lanes.reserve(rows.size());
  for (const TreeRow& row : rows) {
    RowLanes here;
    const auto children = waiting.extract(row.id);
    const std::vector<int> lines = children ? children.mapped() : std::vector<int>();
    const int place = lines.empty() ? places.take() : *std::min_element(lines.begin(), lines.end());
    std::array<bool, kMostLanes> ends{};
    for (const int line : lines) {
      --running[static_cast<std::size_t>(lane_of(line))];
      ends[static_cast<std::size_t>(lane_of(line))] = true;
      if (line != place) places.give_back(line);
    }
    for (int lane = 0; lane < kMostLanes; ++lane) {
      if (ends[static_cast<std::size_t>(lane)]) here.above.push_back(lane);
      if (running[static_cast<std::size_t>(lane)] > 0) here.through.push_back(lane);
    }
    here.lane = lane_of(place);
    here.parent_below = row.parent && ids.contains(*row.parent);
    if (here.parent_below) {
      waiting[*row.parent].push_back(place);
      ++running[static_cast<std::size_t>(here.lane)];
    } else {
      places.give_back(place);
    }
    lanes.push_back(std::move(here));
  }
  return lanes;
}

}  // namespace tidemark::ui
