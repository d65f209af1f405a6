// The description of a change of a case, in the user's language.
#pragma once

#include <QString>

#include "document/history.h"

namespace tidemark::engine {

QString change_text(const document::ChangeDescription& change);

}  // namespace tidemark::engine
