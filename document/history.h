// The history of a case: its changes in order, with the way back and forward again.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "core/result.h"

namespace tidemark::document {

enum class ChangeKind {
  start,
  paint,
  erase,
  target,      // T
  range,       // epsilon
  smoothing,   // alpha
  parameters,  // several of them, or another one
  evolution,
  step_back,
  restart,
  sweep,   // a run of one was taken
  source,  // the volume as the level set sees it
  examples,
  constraints,  // walls and anchors
  speed,        // the speed functions, or their numbers
  new_label,
  label_settings,
  remove_label,
  import_labels,
  accept,
};

// A change in words. The interface words it in the user's language, describe() in English.
struct ChangeDescription {
  ChangeKind kind = ChangeKind::start;
  std::int64_t steps = 0;  // of evolution, step_back and sweep
  std::string name;        // of a label, or of several

  bool operator==(const ChangeDescription&) const = default;
};
[[nodiscard]] std::string describe(const ChangeDescription& change);  // "evolution, 120 steps"

// A change that was made. A function of it that fails changes nothing.
class Change {
 public:
  virtual ~Change() = default;
  virtual Status undo() = 0;
  virtual Status redo() = 0;
  [[nodiscard]] virtual std::int64_t bytes() const = 0;
};

// A change that is still open: a stroke of the brush, a run of steps.
class OpenChange {
 public:
  [[nodiscard]] virtual ChangeDescription description() const = 0;
  [[nodiscard]] virtual std::int64_t bytes() const = 0;
  // Ends it and adds it to the history. It is over even if this fails.
  virtual Status close() = 0;

 protected:
  ~OpenChange() = default;
};

class History {
 public:
  static constexpr std::int64_t kDefaultLimit = std::int64_t{1} << 30;  // bytes

  // The oldest entries are dropped to stay below it; the latest one is kept whatever its size.
  void set_limit(std::int64_t bytes);
  [[nodiscard]] std::int64_t bytes() const;

  // Adds an entry for a change that was just made. Drops the entries that could be redone.
  void add(ChangeDescription description, std::unique_ptr<Change> change);

  // Opens a change; the one before must be closed. Drops the entries that could be redone.
  void open(OpenChange& change);
  // Closes the open change, if there is one.
  Status close();

  // Both close the open change. They fail (ErrorKind::usage) when there is nothing to undo or redo.
  Status undo();
  Status redo();
  // The changes that they would take back or make again.
  [[nodiscard]] std::optional<ChangeDescription> undo_description() const;
  [[nodiscard]] std::optional<ChangeDescription> redo_description() const;

  // Names the present state: the same number after an undo as before the change. While a change is open, a
  // number that no state has.
  [[nodiscard]] std::uint64_t position() const;
  // Grows by one with each change, undo and redo: how much was done since the last copy.
  [[nodiscard]] std::uint64_t edits() const { return edits_; }

 private:
  struct Entry {
    ChangeDescription description;
    std::unique_ptr<Change> change;
    std::uint64_t id = 0;  // of the state after it
  };
  void keep_below_limit();

  std::deque<Entry> done_;
  std::deque<Entry> undone_;  // the next to redo is the last
  OpenChange* open_ = nullptr;
  std::uint64_t base_id_ = 0;  // of the state before the first entry
  std::uint64_t last_id_ = 0;
  std::uint64_t edits_ = 0;
  std::int64_t limit_ = kDefaultLimit;
};

}  // namespace tidemark::document
