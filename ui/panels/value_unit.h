// The unit of a study's values.
#pragma once

#include <QString>

#include "core/volume.h"

namespace tidemark::ui {

// Empty for values that have none.
inline QString value_unit(const Volume& volume) {
  return QString::fromStdString(volume.unit);
}

}  // namespace tidemark::ui
