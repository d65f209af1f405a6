// Words of the user interface in the language that stories speak (TIDEMARK_STORY_LANGUAGE).
#pragma once

#include <QCoreApplication>
#include <QString>

namespace tidemark::test {

// The English ones where there is no translation.
inline QString in_story_language(const char* english) {
  return QCoreApplication::translate("", english);
}

}  // namespace tidemark::test
