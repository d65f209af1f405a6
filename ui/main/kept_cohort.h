// A cohort without its panel, which another main window may take over.
#pragma once

#include <QString>
#include <string>

namespace tidemark::engine {
class CaseProxy;
}

namespace tidemark::ui {

struct KeptCohort {
  QString folder;                             // empty: none is open
  std::string chosen;                         // the id of a case; empty: none
  std::string open;                           // likewise
  const engine::CaseProxy* opened = nullptr;  // as which `open` is open, among those of the main window
};

}  // namespace tidemark::ui
