// A case at one moment, to be written while it goes on.
#pragma once

#include <memory>

#include "study/case.h"

namespace tidemark {

struct CaseSnapshot {
  std::shared_ptr<const Volume> volume;
  std::shared_ptr<const Field> phi;
  Labels labels;  // without a history
  Recipe recipe;
};

}  // namespace tidemark
