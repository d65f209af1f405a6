// Number boxes that follow a model while somebody may be typing in them.
#pragma once

#include <QDoubleSpinBox>

namespace tidemark {

// Shows the value, without a signal, unless the user is typing another one: digits that are being typed must
// stay.
void show_unless_typed(QDoubleSpinBox& box, double value);

}  // namespace tidemark
