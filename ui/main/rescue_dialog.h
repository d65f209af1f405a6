// The question after a crash: what to do with copies of cases that were not saved.
#pragma once

#include <QString>
#include <vector>

#include "document/autosave.h"

class QWidget;

namespace tidemark::ui {

enum class RescueAnswer { open, discard, later };

// `why`: the reason why there are copies. The copies are listed by name, study and age.
RescueAnswer ask_about_copies(QWidget* parent, const QString& why,
                              const std::vector<document::Recoverable>& copies);

}  // namespace tidemark::ui
