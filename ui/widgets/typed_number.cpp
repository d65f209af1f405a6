#include "ui/widgets/typed_number.h"

#include <QSignalBlocker>

namespace tidemark {

void show_unless_typed(QDoubleSpinBox& box, double value) {
  if (box.hasFocus() && box.cleanText() != box.textFromValue(box.value())) return;
  const QSignalBlocker quiet(box);
  box.setValue(value);
}

}  // namespace tidemark
