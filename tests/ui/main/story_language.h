// Words of the user interface in the language that stories speak (TIDEMARK_STORY_LANGUAGE).
#pragma once

#include <QCoreApplication>
#include <QString>

namespace tidemark::test {

// As a button shows them, without the mark of its letter; the English ones where there is no translation.
inline QString in_story_language(const char* english) {
  return QCoreApplication::translate("", english).remove(QLatin1Char('&'));
}

}  // namespace tidemark::test
