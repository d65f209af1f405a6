// Sentences of the folders below in the user's language: why something failed, and what work does now.
#pragma once

#include <QCoreApplication>
#include <QString>
#include <QStringList>
#include <string>
#include <vector>

#include "core/result.h"

namespace tidemark::engine {

// The context of such sentences: unlike the user interface's texts they come with their values filled in.
inline constexpr const char* kMessageContext = "message";

// As it is where the language has no translation of it.
inline QString message_text(const std::string& message) {
  return QCoreApplication::translate(kMessageContext, message.c_str());
}
inline QString message_text(const Error& error) {
  return message_text(error.message);
}
// All of them, on one line; empty: none.
inline QString message_text(const std::vector<std::string>& messages) {
  QStringList texts;
  for (const std::string& message : messages) texts << message_text(message);
  return texts.join(QStringLiteral("; "));
}

}  // namespace tidemark::engine
