// One page of help: a first segmentation, the mouse and the keys.
#pragma once

#include "ui/main/actions.h"

class QWidget;

namespace tidemark::ui {

// In a window of its own that may stay beside the work; there is one, and it comes to the front.
void show_first_steps(QWidget* parent, const Actions& actions);

}  // namespace tidemark::ui
