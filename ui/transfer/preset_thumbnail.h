// A small picture of a transfer function's effect on values.
#pragma once

#include <QPalette>
#include <QPixmap>

#include "engine/source_summary.h"
#include "renderer/transfer_function.h"

namespace tidemark::ui {

inline constexpr QSize kThumbnailSize{64, 40};  // logical pixels

// Opacity over the histogram, in the colours that it gives; of the surface over the distance from the clip
// plane when the function says nothing of the source. `function` is in the source's units.
QPixmap preset_thumbnail(const renderer::TransferFunction& function, const engine::SourceSummary& summary,
                         const QPalette& palette, double pixel_ratio);

}  // namespace tidemark::ui
