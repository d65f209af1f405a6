// The lanes of a tree that is drawn as a list, newest rows on top: where lines run between its rows.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace tidemark::ui {

inline constexpr int kMostLanes = 5;  // lines further right share the last one

struct TreeRow {
  std::uint64_t id = 0;
  std::optional<std::uint64_t> parent;

  bool operator==(const TreeRow&) const = default;
};

// Of a row. Lanes count from 0 at the left.
struct RowLanes {
  int lane = 0;  // of the row's own node
  bool parent_below = false;
  std::vector<int> above;    // from which lanes lines of children come down to the node
  std::vector<int> through;  // in which lanes lines pass by

  bool operator==(const RowLanes&) const = default;
};

// Parents come behind their children. A parent that is not among the rows has no line to it.
std::vector<RowLanes> lanes_of(const std::vector<TreeRow>& rows);

}  // namespace tidemark::ui
