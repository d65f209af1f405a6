// The part of a lesson that its author measures, with what it needs from before.
#pragma once

#include "document/lesson.h"

namespace tidemark::ui {

// The lesson up to that part. Tries before the one from which it goes on are left out, and so are other
// figures. Texts that carrying out does not need may be missing in `lesson`.
[[nodiscard]] document::Lesson cut_after(const document::Lesson& lesson, std::size_t part);

}  // namespace tidemark::ui
