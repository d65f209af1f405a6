// Sentences about a page's record.
#pragma once

#include <QString>

#include "solver/stream/pass_record.h"

namespace tidemark::ui {

// "Page 3, 2, 41 (number 1234) lies at 32, 16 of G, which has 1024 × 32 texels: physical page 7."
QString address_text(const solver::PassRecord& record);
// What the processor does upon the message.
QString decision_text(const solver::PassRecord& record);

}  // namespace tidemark::ui
