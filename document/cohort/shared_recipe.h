// The part of a recipe that means something on another study, and the recipe that a case makes of it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "document/cohort/work_list.h"
#include "document/recipe.h"

namespace tidemark::cohort {

// The parameters, the smoothing and the drive at the recipe's end, from the first step on: on the way there
// somebody tried. Its start is used where a case has none: seeds by their place in the patient, thresholds
// by their values. Places of its own study are none of another: masks, voxels, strokes, walls, anchors.
class SharedRecipe {
 public:
  // Edits at places of the study are refused, unless `without_edits` leaves them out. Fails
  // (ErrorKind::input) naming `file` and what cannot be used.
  static Result<SharedRecipe> parse(std::string_view text, const std::string& file, bool without_edits);

  [[nodiscard]] const solver::Parameters& parameters() const { return parameters_; }
  // Of its own study's voxels.
  [[nodiscard]] const glm::dvec3& spacing_mm() const { return spacing_mm_; }
  [[nodiscard]] double smoothed_mm() const { return smoothed_mm_; }
  [[nodiscard]] const solver::SpeedSetting& setting() const { return setting_; }
  [[nodiscard]] const document::Start& start() const { return start_; }
  [[nodiscard]] std::optional<double> within_mm() const { return within_mm_; }
  [[nodiscard]] bool needs_map() const;
  // What was left out, one sentence each.
  [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  Status take_start(const document::Recipe& recipe, const std::string& file);
  Status take_drive(const document::Recipe& recipe, const std::string& file);

  glm::dvec3 spacing_mm_{1.0};
  solver::Parameters parameters_;
  double smoothed_mm_ = 0.0;
  solver::SpeedSetting setting_;
  document::Start start_;
  std::optional<double> within_mm_;
  std::vector<std::string> remarks_;
};

// What a row lacks to be computed with that recipe (null: none), one sentence each.
[[nodiscard]] std::vector<std::string> missing_in(const WorkRow& row, const SharedRecipe* recipe);

// The columns whose values in the row count instead of other ones of the recipe.
[[nodiscard]] std::vector<std::string_view> own_values(const WorkRow& row, const SharedRecipe& recipe);

// The parameters of a case: its own, then the recipe's.
[[nodiscard]] solver::Parameters parameters_of(const WorkRow& row, const SharedRecipe* recipe);

}  // namespace tidemark::cohort
