// Recipes and their parts as JSON, for recipe files and session files.
#pragma once

#include "core/json/json.h"
#include "core/json/json_field.h"
#include "document/recipe.h"

namespace tidemark::document {

[[nodiscard]] Json to_json(const Recipe& recipe);
[[nodiscard]] Json to_json(const Geometry& geometry);
[[nodiscard]] Json to_json(const solver::Parameters& parameters);
[[nodiscard]] Json to_json(const Start& start);
[[nodiscard]] Json to_json(const imaging::GridPolicy& policy);
// The parameters that differ from those of `base`: a band or w that only `base` sets is "default".
[[nodiscard]] Json changed_parameters(const solver::Parameters& parameters, const solver::Parameters& base);
// What is wanted beside a recipe (LevelSet::wanted_drive()). What holds the surface is always the recipe's.
[[nodiscard]] Json wanted_drive_json(const Drive& drive);

// Errors are noted in the field's document.
std::shared_ptr<const Drive> read_wanted_drive(const JsonField& field, const Recipe& recipe);
Recipe read_recipe(const JsonField& field);
Geometry read_geometry(const JsonField& field);
solver::Parameters read_parameters(const JsonField& field);
Start read_start(const JsonField& field);
Start read_partial_start(const JsonField& field);  // the same, of which any part may be missing
// The parameters of `base` with those that the field names.
solver::Parameters read_changed_parameters(const JsonField& field, const solver::Parameters& base);
imaging::GridPolicy read_policy(const JsonField& field);

}  // namespace tidemark::document
