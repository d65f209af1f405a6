// Words of functions that belong to no class of Qt's.
#pragma once

#include <QCoreApplication>
#include <QString>
#include <algorithm>
#include <cstdint>
#include <limits>

namespace tidemark::ui {

inline QString tr(const char* words, const char* = nullptr, int count = -1) {
  return QCoreApplication::translate("tidemark", words, nullptr, count);
}

// What chooses between "1 voxel" and "n voxels" in tr(), of a count that may be larger than its own.
inline int form_of(std::int64_t count) {
  return static_cast<int>(std::min<std::int64_t>(count, std::numeric_limits<int>::max()));
}

}  // namespace tidemark::ui
