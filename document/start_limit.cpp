// The limit of a start that is refined. Recipes are read and written without the rest of a start.
#include <cmath>

#include "document/start.h"
#include "solver/speed/motion_limit.h"

namespace tidemark::document {

Result<MaskStart> limited(MaskStart start, double within_mm) {
  if (!std::isfinite(within_mm) || within_mm <= 0.0) {
    return fail(ErrorKind::usage, "a surface cannot stay within {} mm of a mask", within_mm);
  }
  start.limit = std::make_shared<const solver::MotionLimit>(start.mask, within_mm);
  return start;
}

std::shared_ptr<const solver::MotionLimit> Start::limit() const {
  const auto* mask = std::get_if<MaskStart>(&from);
  return mask == nullptr ? nullptr : mask->limit;
}

std::shared_ptr<const solver::Constraints> joined(std::shared_ptr<const solver::Constraints> marks,
                                                  const solver::MotionLimit* limit) {
  if (limit == nullptr) return marks;
  if (marks == nullptr) return limit->constraints();
  return std::make_shared<const solver::Constraints>(marks->over(*limit->constraints()));
}

}  // namespace tidemark::document
