// Windows that radiologists know by name.
#pragma once

#include <QString>
#include <vector>

#include "core/volume.h"
#include "engine/source_summary.h"

namespace tidemark::ui {

struct WindowPreset {
  QString name;
  WindowLevel window;
};

// For CT those of its tissues; for all the file's own, if there is one, and the full range of values.
std::vector<WindowPreset> window_presets(const Volume& volume, const engine::SourceSummary& summary);

}  // namespace tidemark::ui
