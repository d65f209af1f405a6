// The history of a case: a tree of its states, and the ways between them.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "document/change.h"

namespace tidemark::document {

// A state of a case, as lists show it.
struct HistoryState {
  std::uint64_t id = 0;
  std::optional<std::uint64_t> parent;  // unset: the oldest state that is known
  ChangeDescription change;             // that led from the parent to it
  Steering steering;

  bool operator==(const HistoryState&) const = default;
};

// Who goes back and on otherwise gets a new branch; the other one stays. A state holds the change from its
// parent only: a way from one to another is up to their common ancestor and down.
class History {
 public:
  static constexpr std::int64_t kDefaultLimit = std::int64_t{1} << 30;  // bytes

  History() { nodes_.emplace(root_, Node()); }

  // States are dropped to stay below it: first ends of branches, the farthest from the present one, then the
  // oldest on the way to it. The latest change is kept whatever its size.
  void set_limit(std::int64_t bytes);
  [[nodiscard]] std::int64_t bytes() const;

  // Adds a state after a change that was just made, a child of the present one. `steering`: as there; unset:
  // as in the parent.
  void add(ChangeDescription description, std::unique_ptr<Change> change,
           std::optional<Steering> steering = std::nullopt);
  // Of the present state, where no change has led to it.
  void set_steering(Steering steering) { present().steering = std::move(steering); }

  // Saved states in place of all that there are, as states() gives them; `changes` in the same order.
  void restore(const std::vector<HistoryState>& states, std::vector<std::shared_ptr<Change>> changes,
               std::uint64_t present);

  // Opens a change; the one before must be closed.
  void open(OpenChange& change);
  // Closes the open change, if there is one.
  Status close();

  // These close the open change. undo() goes to the parent, redo() to the child that was left or made last.
  // They fail (ErrorKind::usage) when there is no such state. Where a way fails, the case stays as it was.
  Status undo();
  Status redo();
  Status go_to(std::uint64_t id);
  // The changes that they would take back or make again.
  [[nodiscard]] std::optional<ChangeDescription> undo_description() const;
  [[nodiscard]] std::optional<ChangeDescription> redo_description() const;

  // Names the present state: the same number after an undo as before the change. While a change is open, a
  // number that no state has.
  [[nodiscard]] std::uint64_t position() const { return open_ != nullptr ? last_id_ : present_; }
  // Grows by one with each change, undo and redo: how much was done since the last copy.
  [[nodiscard]] std::uint64_t edits() const { return edits_; }

  // The state where the open change began; without one, the present state.
  [[nodiscard]] std::uint64_t last_state() const { return present_; }
  // All states, parents before their children, older ones first.
  [[nodiscard]] std::vector<HistoryState> states() const;
  // What an open change has come to.
  [[nodiscard]] std::optional<HistoryState> open_state() const;
  [[nodiscard]] bool has(std::uint64_t id) const { return nodes_.contains(id); }
  // From its parent; null: it is the oldest state.
  [[nodiscard]] std::shared_ptr<const Change> change(std::uint64_t id) const { return nodes_.at(id).change; }
  [[nodiscard]] const Steering& steering(std::uint64_t id) const { return nodes_.at(id).steering; }
  // The changes between two states.
  [[nodiscard]] std::size_t distance(std::uint64_t from, std::uint64_t to) const;

 private:
  struct Node {
    std::optional<std::uint64_t> parent;
    std::vector<std::uint64_t> children;  // by their age
    std::optional<std::uint64_t> next;    // the child to which redo goes
    ChangeDescription description;
    std::shared_ptr<Change> change;  // from the parent; null: the root's
    Steering steering;
  };
  // From one state to another: whose changes are taken back, and then whose are made again.
  struct Way {
    std::vector<std::uint64_t> up;
    std::vector<std::uint64_t> down;
  };

  [[nodiscard]] Node& present() { return nodes_.at(present_); }
  [[nodiscard]] const Node& present() const { return nodes_.at(present_); }
  [[nodiscard]] std::vector<std::uint64_t> line_to(std::uint64_t id) const;
  [[nodiscard]] Way way(std::uint64_t from, std::uint64_t to) const;
  Status walk(const Way& way);
  Status arrive(const Way& way);
  void keep_below_limit();
  std::int64_t drop_ends(std::int64_t sum);
  [[nodiscard]] std::unordered_map<std::uint64_t, std::size_t> distances() const;
  void drop(std::uint64_t id);
  void drop_root();

  std::uint64_t root_ = 0;
  std::map<std::uint64_t, Node> nodes_;
  std::uint64_t present_ = 0;
  OpenChange* open_ = nullptr;
  std::uint64_t last_id_ = 0;
  std::uint64_t edits_ = 0;
  std::int64_t limit_ = kDefaultLimit;
};

}  // namespace tidemark::document
