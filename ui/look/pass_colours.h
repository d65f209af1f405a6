// The colours of pictures of a page's values, on panels of either theme.
#pragma once

#include <QColor>

namespace tidemark::ui {

// The ends of signed values: below 0, which is outside and inward, and above it. Colour-blind eyes tell them
// apart.
inline constexpr QColor kNegativeColour(38, 139, 210);
inline constexpr QColor kPositiveColour(230, 130, 20);

// The nine substreams: the interior, then edges and corners, each a hue, in pairs of two strengths.
inline constexpr QColor kSubstreamColours[] = {
    QColor(150, 160, 170), QColor(0, 114, 178),   QColor(86, 180, 233),
    QColor(0, 158, 115),   QColor(120, 205, 165), QColor(213, 94, 0),
    QColor(240, 150, 60),  QColor(170, 60, 130),  QColor(225, 130, 190)};

}  // namespace tidemark::ui
