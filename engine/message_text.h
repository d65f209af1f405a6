// Sentences of the folders below in the user's language: why something failed, and what work does now.
#pragma once

#include <QCoreApplication>
#include <QString>
#include <string>

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

}  // namespace tidemark::engine
