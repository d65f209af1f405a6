// Recipes and their parts as JSON, for recipe files and session files.
#pragma once

#include "core/json/json.h"
#include "core/json/json_field.h"
#include "document/recipe.h"

namespace tidemark {

[[nodiscard]] Json to_json(const Recipe& recipe);
[[nodiscard]] Json to_json(const Geometry& geometry);
[[nodiscard]] Json to_json(const Parameters& parameters);
[[nodiscard]] Json to_json(const GridPolicy& policy);

// Errors are noted in the field's document.
Recipe read_recipe(const JsonField& field);
Geometry read_geometry(const JsonField& field);
Parameters read_parameters(const JsonField& field);
GridPolicy read_policy(const JsonField& field);

}  // namespace tidemark
