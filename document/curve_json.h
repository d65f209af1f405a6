// The development of a surface as JSON, for session files.
#pragma once

#include "core/json/json.h"
#include "core/json/json_field.h"
#include "document/curve.h"

namespace tidemark::document {

[[nodiscard]] Json curve_json(const Curve::Points& points);
// Errors are noted in the field's document.
Curve read_curve(const JsonField& field);

}  // namespace tidemark::document
