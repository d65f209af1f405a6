// The document: a volume, its level set, its labels, how it is shown, and its history.
#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "document/history.h"
#include "document/labels.h"
#include "document/level_set.h"
#include "document/origin.h"

namespace tidemark::document {

// Used on one thread at a time, as its level set.
class Case {
 public:
  // Starts to compute the origin's checksum on another thread.
  static Result<std::unique_ptr<Case>> create(std::shared_ptr<const Volume> volume, StudyOrigin origin,
                                              const solver::Parameters& parameters, solver::ExecutorKind kind,
                                              const solver::ExecutorOptions& options);

  ~Case();
  Case(const Case&) = delete;
  Case& operator=(const Case&) = delete;

  [[nodiscard]] const std::shared_ptr<const Volume>& volume() const { return volume_; }  // as loaded
  // Waits for the checksum if it is not ready.
  [[nodiscard]] StudyOrigin origin() const;
  [[nodiscard]] LevelSet& level_set() { return *level_set_; }
  [[nodiscard]] const LevelSet& level_set() const { return *level_set_; }
  [[nodiscard]] Labels& labels() { return labels_; }
  [[nodiscard]] const Labels& labels() const { return labels_; }
  [[nodiscard]] History& history() { return history_; }
  [[nodiscard]] const History& history() const { return history_; }

  // The source that the level set sees: the volume smoothed by that many mm (0: not at all).
  Status smooth_source(double sigma_mm);
  [[nodiscard]] double smoothed_mm() const { return level_set_->smoothed_mm(); }

  // Changes of labels; each is one entry of the history.
  // The surface's inside becomes the label; with label 0, a new one with the name `another`. Where the label
  // has voxels and none of them is inside, the surface is another structure: it becomes a new label with that
  // name, unless that is empty. Fails (ErrorKind::usage) without an inside.
  Result<Acceptance> accept_surface(std::uint8_t label, Take take, const std::string& another = {});
  // With `within_mm` the label is refined: the surface stays that near to it.
  Status begin_from_label(std::uint8_t label, std::optional<double> within_mm = std::nullopt, int levels = 1);

  // One step back or forward in the history of everything.
  Status undo() { return history_.undo(); }
  Status redo() { return history_.redo(); }

  // The display: JSON of the user interface, kept in session files.
  std::string view_state;

  // Whether the state, or one that undo leads to, differs from the saved one.
  [[nodiscard]] bool changed_since_save() const { return history_.position() != saved_position_; }
  void mark_saved() { mark_saved(history_.position()); }
  // The saved state is that position of the history.
  void mark_saved(std::uint64_t position) { saved_position_ = position; }

 private:
  Case(std::shared_ptr<const Volume> volume, StudyOrigin origin);

  std::shared_ptr<const Volume> volume_;
  StudyOrigin origin_;
  std::stop_source checksum_stop_;
  std::shared_future<std::string> checksum_;  // not yet in origin_
  History history_;                           // declared before the members that its entries refer to
  std::unique_ptr<LevelSet> level_set_;
  Labels labels_;
  std::uint64_t saved_position_ = 0;
};

}  // namespace tidemark::document
