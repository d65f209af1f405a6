// The unit of a study's values.
#pragma once

#include <QString>

#include "core/volume.h"

namespace tidemark {

// "HU" for CT; other modalities' values have no unit (empty).
inline QString value_unit(const Volume& volume) {
  return volume.modality == "CT" ? QStringLiteral("HU") : QString();
}

}  // namespace tidemark
