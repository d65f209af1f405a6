#include "ui/look/colour.h"

namespace tidemark::ui {

QColor mixed(const QColor& from, const QColor& to, double share) {
  const auto part = [share](double a, double b) { return static_cast<float>(a + (b - a) * share); };
  return QColor::fromRgbF(part(from.redF(), to.redF()), part(from.greenF(), to.greenF()),
                          part(from.blueF(), to.blueF()), part(from.alphaF(), to.alphaF()));
}

}  // namespace tidemark::ui
