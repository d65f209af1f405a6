// The languages that the program speaks.
#pragma once

#include <QString>
#include <span>

namespace tidemark::ui {

struct Language {
  const char* code;  // as QLocale has it, "zh_CN"; its file is resources/languages/zh_CN.json
  const char* name;  // in the language itself
};

std::span<const Language> languages();  // English first

// Texts that are made from now on are in that language, Qt's own too, and numbers and dates as it writes
// them. An empty code: in the system's language where the program speaks it, else in English, and numbers as
// the system has them. There is an application; on the thread of the user interface.
void use_language(const QString& code);

// The code of the language that texts are made in: never empty.
QString used_language();

}  // namespace tidemark::ui
