#include "document/history.h"

#include <algorithm>
#include <queue>
#include <utility>

namespace tidemark::document {

void History::set_limit(std::int64_t bytes) {
  limit_ = bytes;
  keep_below_limit();
}

std::int64_t History::bytes() const {
  std::int64_t sum = open_ != nullptr ? open_->bytes() : 0;
  for (const auto& [id, node] : nodes_) {
    if (node.change != nullptr) sum += node.change->bytes();
  }
  return sum;
}

// Memory.

void History::keep_below_limit() {
  std::int64_t sum = bytes();
  if (sum > limit_) sum = drop_ends(sum);
  while (sum > limit_ && present_ != root_ && present().parent != root_) {
    const std::uint64_t next = nodes_.at(root_).children.front();
    sum -= nodes_.at(next).change->bytes();
    drop_root();
  }
}

// Ends of branches, the farthest from the present state first and the oldest of several, until the rest is
// below the limit, or leads to that state. Returns the bytes of the rest, where `sum` are those of all.
std::int64_t History::drop_ends(std::int64_t sum) {
  using Away = std::pair<std::size_t, std::uint64_t>;  // changes from the present state, and the state
  const auto is_later = [](const Away& a, const Away& b) {
    return a.first != b.first ? a.first < b.first : a.second > b.second;
  };
  std::priority_queue<Away, std::vector<Away>, decltype(is_later)> ends(is_later);
  const std::unordered_map<std::uint64_t, std::size_t> away = distances();
  const auto add = [&](std::uint64_t id) {
    if (nodes_.at(id).children.empty() && id != present_ && id != root_) ends.emplace(away.at(id), id);
  };
  for (const auto& [id, node] : nodes_) add(id);
  while (sum > limit_ && !ends.empty()) {
    const std::uint64_t end = ends.top().second;
    ends.pop();
    const std::uint64_t parent = *nodes_.at(end).parent;
    sum -= nodes_.at(end).change->bytes();
    drop(end);
    add(parent);
  }
  return sum;
}

// Of all states from the present one, in changes.
std::unordered_map<std::uint64_t, std::size_t> History::distances() const {
  std::unordered_map<std::uint64_t, std::size_t> away;
  std::size_t up = 0;
  for (std::optional<std::uint64_t> at = present_; at; at = nodes_.at(*at).parent) away[*at] = up++;
  for (const auto& [id, node] : nodes_) {
    if (node.parent) away.try_emplace(id, away.at(*node.parent) + 1);  // parents have smaller numbers
  }
  return away;
}

void History::drop(std::uint64_t id) {
  Node& parent = nodes_.at(*nodes_.at(id).parent);
  std::erase(parent.children, id);
  if (parent.next == id) {
    parent.next.reset();
    if (!parent.children.empty()) parent.next = parent.children.back();
  }
  nodes_.erase(id);
}

// Of a root with one child: that is the root then.
void History::drop_root() {
  const std::uint64_t next = nodes_.at(root_).children.front();
  nodes_.erase(root_);
  root_ = next;
  Node& root = nodes_.at(root_);
  root.parent.reset();
  root.description = {};
  root.change.reset();
}

// Changes.

void History::add(ChangeDescription description, std::unique_ptr<Change> change,
                  std::optional<Steering> steering) {
  Node& parent = present();
  Node node;
  node.parent = present_;
  node.description = std::move(description);
  node.change = std::move(change);
  node.steering = steering ? *std::move(steering) : parent.steering;
  // All that may lack memory comes first: a state is there with both of its links or not at all.
  parent.children.reserve(parent.children.size() + 1);
  nodes_.emplace(last_id_ + 1, std::move(node));
  present_ = ++last_id_;
  parent.children.push_back(present_);
  parent.next = present_;
  ++edits_;
  keep_below_limit();
}

void History::restore(const std::vector<HistoryState>& states, std::vector<std::shared_ptr<Change>> changes,
                      std::uint64_t present) {
  nodes_.clear();
  root_ = states.front().id;
  present_ = present;
  last_id_ = states.back().id;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const HistoryState& state = states[i];
    nodes_.emplace(state.id, Node{state.parent, {}, {}, state.change, std::move(changes[i]), state.steering});
    if (!state.parent) continue;
    Node& parent = nodes_.at(*state.parent);
    parent.children.push_back(state.id);
    parent.next = state.id;
  }
  for (std::optional<std::uint64_t> at = present_; nodes_.at(*at).parent; at = nodes_.at(*at).parent)
    nodes_.at(*nodes_.at(*at).parent).next = at;
  ++edits_;
}

void History::open(OpenChange& change) {
  open_ = &change;
  ++last_id_;
}

Status History::close() {
  if (open_ == nullptr) return {};
  OpenChange& change = *std::exchange(open_, nullptr);
  try {
    return change.close();
  } catch (...) {
    open_ = &change;  // it lacked memory, and can be closed later
    throw;
  }
}

// Ways.

// From the root to a state, both included.
std::vector<std::uint64_t> History::line_to(std::uint64_t id) const {
  std::vector<std::uint64_t> line;
  for (std::optional<std::uint64_t> at = id; at; at = nodes_.at(*at).parent) line.push_back(*at);
  std::reverse(line.begin(), line.end());
  return line;
}

History::Way History::way(std::uint64_t from, std::uint64_t to) const {
  const std::vector<std::uint64_t> here = line_to(from);
  const std::vector<std::uint64_t> there = line_to(to);
  const auto [up, down] = std::mismatch(here.begin(), here.end(), there.begin(), there.end());
  return {{here.rbegin(), std::make_reverse_iterator(up)}, {down, there.end()}};
}

std::size_t History::distance(std::uint64_t from, std::uint64_t to) const {
  const Way between = way(from, to);
  return between.up.size() + between.down.size();
}

// Only the present state moves, step by step: a failure leaves it where it has come to.
Status History::walk(const Way& way) {
  for (const std::uint64_t id : way.up) {
    Node& node = nodes_.at(id);
    TIDEMARK_TRY(node.change->undo());
    present_ = *node.parent;
    present().next = id;
  }
  for (const std::uint64_t id : way.down) {
    TIDEMARK_TRY(nodes_.at(id).change->redo());
    present().next = id;
    present_ = id;
  }
  return {};
}

Status History::arrive(const Way& way) {
  for (const auto* ids : {&way.up, &way.down}) {
    for (const std::uint64_t id : *ids) TIDEMARK_TRY(nodes_.at(id).change->arrive());
  }
  return {};
}

Status History::go_to(std::uint64_t id) {
  TIDEMARK_TRY(close());
  if (!has(id)) return fail(ErrorKind::usage, "the history has no state {}", id);
  if (id == present_) return {};
  const std::uint64_t from = present_;
  const Way there = way(from, id);
  Status gone = walk(there);
  if (gone) gone = arrive(there);
  if (!gone) {
    const Way back = way(present_, from);
    TIDEMARK_TRY(walk(back));
    TIDEMARK_TRY(arrive(back));
    return gone;
  }
  ++edits_;
  return {};
}

Status History::undo() {
  TIDEMARK_TRY(close());
  if (!present().parent) return fail(ErrorKind::usage, "there is nothing to undo");
  return go_to(*present().parent);
}

Status History::redo() {
  TIDEMARK_TRY(close());
  if (!present().next) return fail(ErrorKind::usage, "there is nothing to redo");
  return go_to(*present().next);
}

std::optional<ChangeDescription> History::undo_description() const {
  if (open_ != nullptr) return open_->description();
  if (!present().parent) return std::nullopt;
  return present().description;
}

std::optional<ChangeDescription> History::redo_description() const {
  if (open_ != nullptr || !present().next) return std::nullopt;
  return nodes_.at(*present().next).description;
}

std::vector<HistoryState> History::states() const {
  std::vector<HistoryState> states;
  states.reserve(nodes_.size());
  for (const auto& [id, node] : nodes_) states.push_back({id, node.parent, node.description, node.steering});
  return states;
}

std::optional<HistoryState> History::open_state() const {
  if (open_ == nullptr) return std::nullopt;
  return HistoryState{last_id_, present_, open_->description(), open_->steering()};
}

}  // namespace tidemark::document
