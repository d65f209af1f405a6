// The display of a case as JSON for session files.
#pragma once

#include <string>

#include "core/result.h"
#include "engine/display.h"

namespace tidemark::engine {

[[nodiscard]] std::string to_json(const DisplaySettings& settings);
// Fields that are missing keep the values of `settings`. Fails (ErrorKind::input) naming one that makes no
// sense.
Result<DisplaySettings> display_settings(const std::string& json, DisplaySettings settings);
// The measurements and the line of a profile alone, whatever else makes no sense.
Result<DisplaySettings> display_measurements(const std::string& json, DisplaySettings settings);

}  // namespace tidemark::engine
