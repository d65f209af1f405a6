// Words of functions that belong to no class of Qt's.
#pragma once

#include <QCoreApplication>
#include <QString>

namespace tidemark::ui {

inline QString tr(const char* words) {
  return QCoreApplication::translate("tidemark", words);
}

}  // namespace tidemark::ui
