// Sentences on why the surface moves or rests at a place.
#pragma once

#include <QString>

#include "engine/case_balance.h"

namespace tidemark::ui {

// Which terms win, and what would have to change for the surface to move. `decimals`: of epsilon.
QString why_text(const engine::ExplainedPlace& place, int decimals);

// The value of the source, with T and epsilon beside it where they make D.
QString brightness_text(const engine::ExplainedPlace& place, int decimals, const QString& unit);

}  // namespace tidemark::ui
