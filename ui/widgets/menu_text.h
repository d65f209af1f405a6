// Names in menus and on buttons.
#pragma once

#include <QString>

namespace tidemark::ui {

// A name that is shown as it is: a single & would mark the letter behind it.
inline QString menu_text(QString name) {
  return name.replace(u'&', QStringLiteral("&&"));
}

}  // namespace tidemark::ui
