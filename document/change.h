// A change of a case as an entry of its history: what it was, and the way back and forward again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "core/result.h"
#include "document/drive.h"
#include "solver/field.h"
#include "solver/parameters.h"

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
  finish,  // labels, by a tool
  label_brush,
};
inline constexpr std::size_t kChangeKinds = static_cast<std::size_t>(ChangeKind::label_brush) + 1;
// The surface is the same before it and after it.
[[nodiscard]] bool is_of_labels(ChangeKind kind);

// A change in words. The interface words it in the user's language, describe() in English.
struct ChangeDescription {
  ChangeKind kind = ChangeKind::start;
  std::int64_t steps = 0;  // of evolution, step_back and sweep
  std::string name;        // of a label, or of several

  bool operator==(const ChangeDescription&) const = default;
};
[[nodiscard]] std::string describe(const ChangeDescription& change);  // "evolution, 120 steps"

// How far a level set has come, what it is there, and what steers it.
struct Steering {
  bool begun = false;     // there is a surface
  std::int64_t step = 0;  // since the start
  solver::Parameters parameters;
  DriveSummary drive;
  std::shared_ptr<const solver::Field> phi = nullptr;  // null: a change goes on

  bool operator==(const Steering&) const = default;
};

// A change that was made. A function of it that fails changes nothing.
class Change {
 public:
  virtual ~Change() = default;
  // They may be called for several changes in a row, and arrive() then, for each of them. Until then an
  // executor may be as before them all.
  virtual Status undo() = 0;
  virtual Status redo() = 0;
  virtual Status arrive() { return {}; }
  [[nodiscard]] virtual std::int64_t bytes() const = 0;
};

// A change that is still open: a stroke of the brush, a run of steps.
class OpenChange {
 public:
  [[nodiscard]] virtual ChangeDescription description() const = 0;
  [[nodiscard]] virtual Steering steering() const = 0;  // at present
  [[nodiscard]] virtual std::int64_t bytes() const = 0;
  // Ends it and adds it to the history. It is over even if this fails.
  virtual Status close() = 0;

 protected:
  ~OpenChange() = default;
};

}  // namespace tidemark::document
