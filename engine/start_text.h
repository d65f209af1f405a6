// The start of a surface, told in the user's language.
#pragma once

#include <QStringList>

#include "document/start.h"
#include "engine/message_text.h"

namespace tidemark::engine {

inline QString start_text(const document::Start& start) {
  QStringList parts;
  for (const std::string& part : start.parts()) parts << message_text(part);
  return parts.join(QStringLiteral(", "));
}

}  // namespace tidemark::engine
