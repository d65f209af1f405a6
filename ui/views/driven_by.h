// The question which functions drive a surface.
#pragma once

#include <algorithm>
#include <string_view>

#include "document/drive.h"

namespace tidemark::ui {

inline bool is_driven_by(const document::Drive& drive, std::string_view function) {
  return std::ranges::any_of(drive.setting.terms,
                             [&](const solver::SpeedTerm& term) { return term.function == function; });
}

}  // namespace tidemark::ui
