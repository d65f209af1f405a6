// The functions that drive a surface, and their absence.
#pragma once

#include <QString>
#include <algorithm>
#include <string_view>

#include "document/drive.h"
#include "engine/case_state.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {

inline bool is_driven_by(const document::Drive& drive, std::string_view function) {
  return std::ranges::any_of(drive.setting.terms,
                             [&](const solver::SpeedTerm& term) { return term.function == function; });
}

// Of a case that lacks its speed function.
inline QString lacking_speed_text(const engine::CaseState& state) {
  return state.speed_waits ? tr("The speed function is being made.")
                           : tr("The speed function is missing: nothing drives the surface.");
}

}  // namespace tidemark::ui
