// The patient and the study, for people to read.
#pragma once

#include <string>

namespace tidemark::imaging {

// In UTF-8; absent attributes stay empty. Views show it in their corners, cases and panels at their
// heads, and the list of series shows the name. A report that the user asks for names the patient while the
// views do, and audit messages name it where a site has asked for them. It goes nowhere else: no log, title,
// statistics, recipe or session holds it.
struct Patient {
  std::string name;  // in the original script, the Latin one behind it: "山田 太郎 (Yamada, Tarou)"
  std::string id;
  std::string sex;  // "F", "M" or "O"
  std::string age;  // at the study, in days, weeks, months or years: "45Y"

  bool operator==(const Patient&) const = default;
};

}  // namespace tidemark::imaging
