#include "document/cohort/shared_recipe.h"

#include <algorithm>

#include "solver/speed/motion_limit.h"

namespace tidemark::cohort {
namespace {

bool uses(const solver::SpeedSetting& setting, std::string_view function) {
  return std::any_of(setting.terms.begin(), setting.terms.end(),
                     [&](const solver::SpeedTerm& term) { return term.function == function; });
}

bool uses_tent(const SharedRecipe* recipe) {
  return recipe == nullptr || uses(recipe->setting(), "tent");
}

bool has_start(const WorkRow& row, const SharedRecipe* recipe) {
  return row.has_start() || row.auto_start || (recipe != nullptr && !recipe->start().empty());
}

}  // namespace

bool SharedRecipe::needs_map() const {
  return uses(setting_, "image");
}

Status SharedRecipe::take_start(const document::Recipe& recipe, const std::string& file) {
  start_ = recipe.start;
  const bool places = std::holds_alternative<document::MaskStart>(start_.from) ||
                      std::holds_alternative<document::FieldStart>(start_.from) ||
                      std::holds_alternative<document::FloodStart>(start_.from);
  if (const auto limit = recipe.start.limit()) within_mm_ = limit->within_mm();
  if (!places) return {};
  // What is added to a mask or taken from it is as little as the mask without it.
  start_ = {};
  start_.levels = recipe.start.levels;
  remarks_.push_back(
      fmt::format("{}: start: {} lies on its own study's voxels; each case needs its own start", file,
                  recipe.start.describe()));
  return {};
}

Status SharedRecipe::take_drive(const document::Recipe& recipe, const std::string& file) {
  const document::Drive drive = document::value_of(recipe.final_drive());
  setting_ = drive.setting;
  if (uses(setting_, "examples")) {
    return fail(ErrorKind::input,
                "{}: speed: 'examples' learns from strokes on its own study, and knows nothing of others",
                file);
  }
  if (drive.constraints != nullptr) {
    remarks_.push_back(fmt::format("{}: walls and anchors lie on its own study's voxels: left out", file));
  }
  return {};
}

Result<SharedRecipe> SharedRecipe::parse(std::string_view text, const std::string& file, bool without_edits) {
  const auto recipe = document::Recipe::parse(text, file);
  if (!recipe) return pass_on(recipe);
  std::size_t edits = 0;
  for (std::size_t i = 0; i < recipe->events.size(); ++i) {
    if (!std::holds_alternative<document::PaintEvent>(recipe->events[i].what)) continue;
    ++edits;
    if (without_edits) continue;
    return fail(ErrorKind::input,
                "{}: events[{}]: paints at a place of its own study, which means nothing on another; "
                "--without-edits leaves such edits out",
                file, i);
  }
  SharedRecipe shared;
  if (edits > 0) shared.remarks_.push_back(fmt::format("{}: {} painted edits: left out", file, edits));
  shared.spacing_mm_ = recipe->source.spacing_mm;
  shared.parameters_ = recipe->final_parameters();
  shared.smoothed_mm_ = recipe->final_smoothed_mm();
  TIDEMARK_TRY(shared.take_start(*recipe, file));
  TIDEMARK_TRY(shared.take_drive(*recipe, file));
  return shared;
}

std::vector<std::string> missing_in(const WorkRow& row, const SharedRecipe* recipe) {
  std::vector<std::string> missing;
  if (!has_start(row, recipe)) {
    missing.emplace_back("has no start: seed, seed_mm, mask, threshold or auto_start, or a recipe's");
  }
  if (recipe == nullptr && !row.auto_start) {
    for (const auto& [name, value] :
         {std::pair("target", &row.target), std::pair("range", &row.range), std::pair("alpha", &row.alpha)}) {
      if (!*value) missing.push_back(fmt::format("{}: is missing: there is no recipe", name));
    }
  }
  if (!uses_tent(recipe) && (row.target || row.range)) {
    missing.emplace_back("target, range: no tent drives the surface by the recipe");
  }
  const bool needs_map = recipe != nullptr && recipe->needs_map();
  if (needs_map && row.speed_map.empty()) missing.emplace_back("speed_map: the recipe needs one");
  if (!needs_map && !row.speed_map.empty()) missing.emplace_back("speed_map: the recipe uses none");
  return missing;
}

std::vector<std::string_view> own_values(const WorkRow& row, const SharedRecipe& recipe) {
  if (!row.recipe.empty()) return {"recipe"};
  std::vector<std::string_view> names;
  const auto compare = [&](std::string_view name, const auto& own, const auto& other) {
    if (own && *own != other) names.push_back(name);
  };
  compare("target", row.target, recipe.parameters().target);
  compare("range", row.range, recipe.parameters().range);
  compare("alpha", row.alpha, recipe.parameters().alpha);
  compare("smooth_mm", row.smooth_mm, recipe.smoothed_mm());
  compare("levels", row.levels, recipe.start().levels);
  return names;
}

solver::Parameters parameters_of(const WorkRow& row, const SharedRecipe* recipe) {
  solver::Parameters parameters = recipe != nullptr ? recipe->parameters() : solver::Parameters();
  parameters.target = row.target.value_or(parameters.target);
  parameters.range = row.range.value_or(parameters.range);
  parameters.alpha = row.alpha.value_or(parameters.alpha);
  return parameters;
}

}  // namespace tidemark::cohort
