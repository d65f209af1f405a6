// The colours of the equation's terms, on panels of either theme and over pictures.
#pragma once

#include <QColor>

namespace tidemark::ui {

// Colour-blind eyes tell them apart (after Okabe and Ito, "Color Universal Design"); none is the surface's
// yellow.
inline constexpr QColor kDataColour(38, 139, 210);
inline constexpr QColor kCurvatureColour(220, 95, 10);
inline constexpr QColor kRescalingColour(0, 158, 115);
inline constexpr QColor kAdvectionColour(196, 92, 158);
inline constexpr QColor kLimitsColour(128, 128, 128);  // of walls, anchors and limits

}  // namespace tidemark::ui
