// Number boxes that follow a model while somebody may be typing in them.
#pragma once

#include <QDoubleSpinBox>

namespace tidemark {

// Shows the value, without a signal, unless another one is just being typed: nothing is taken out of the
// user's hands.
void show_unless_typed(QDoubleSpinBox& box, double value);

}  // namespace tidemark
