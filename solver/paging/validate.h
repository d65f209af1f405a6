// The invariants of a paged level set.
#pragma once

#include "core/result.h"
#include "solver/field.h"

namespace tidemark::solver {

// Checks, cheap first: all values finite and within +-W; every face of a resident page towards a page that is
// not resident is constant and equal to it; pages that are inside and outside do not touch. The error
// (ErrorKind::internal) names the broken invariant and the place.
[[nodiscard]] Status validate(const Field& phi);

}  // namespace tidemark::solver
