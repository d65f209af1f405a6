// The document: a volume, its level set, its labels, how it is shown, and its history.
#pragma once

#include <memory>
#include <string>

#include "study/history.h"
#include "study/labels.h"
#include "study/level_set.h"
#include "study/origin.h"

namespace tidemark {

class Case {
 public:
  static Result<std::unique_ptr<Case>> create(std::shared_ptr<const Volume> volume, StudyOrigin origin,
                                              const Parameters& parameters, ExecutorKind kind,
                                              const ExecutorOptions& options);

  [[nodiscard]] const std::shared_ptr<const Volume>& volume() const;  // as loaded
  [[nodiscard]] const StudyOrigin& origin() const;
  LevelSet& level_set();
  Labels& labels();
  History& history();

  // The source that the level set sees: the volume smoothed by that many mm (0: as it is).
  Status smooth_source(double sigma_mm, const Progress& progress = {});
  [[nodiscard]] double smoothed_mm() const;

  // Changes of labels that undo takes back, one entry each.
  Status accept_surface(std::uint8_t label);
  Status begin_from_label(std::uint8_t label);

  // One step back or forward in the history of everything.
  Status undo();
  Status redo();

  // How the case is shown: JSON of whoever shows it, kept in session files.
  std::string view_state;

  [[nodiscard]] bool changed_since_save() const;
};

}  // namespace tidemark
