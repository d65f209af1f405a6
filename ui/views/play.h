// Play where there may be no surface yet: it then begins in the strokes of examples.
#pragma once

#include "engine/case_proxy.h"

namespace tidemark::ui {

// Whether there is a surface, or strokes of both kinds to begin in.
[[nodiscard]] bool can_play(const engine::CaseProxy& proxy);
void toggle_play(engine::CaseProxy& proxy);

}  // namespace tidemark::ui
