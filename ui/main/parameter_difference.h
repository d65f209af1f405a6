// The parameters in which several level sets differ, in words.
#pragma once

#include <QStringList>
#include <vector>

#include "solver/parameters.h"

namespace tidemark::ui {

// For each of them its own values of what is not the same in all: "Paper scheme, α 0.7". Empty where all are
// the same.
QStringList parameter_differences(const std::vector<solver::Parameters>& all);

}  // namespace tidemark::ui
