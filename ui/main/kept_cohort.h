// A cohort without its panel, which another main window may take over.
#pragma once

#include <QString>
#include <memory>
#include <string>

namespace tidemark::ui {

struct CohortCase;

struct KeptCohort {
  QString folder;                    // empty: none is open
  std::string chosen;                // the id of a case; empty: none
  std::shared_ptr<CohortCase> open;  // null: none
};

}  // namespace tidemark::ui
