// The question after a crash: what to do with copies of work that was not saved.
#pragma once

#include <QString>
#include <optional>
#include <vector>

#include "document/autosave.h"
#include "document/lesson_copy.h"

class QWidget;

namespace tidemark::ui {

enum class RescueAnswer { open, discard, later };

struct RescuedWork {
  std::vector<document::Recoverable> cases;
  std::optional<document::RescuedLesson> lesson;

  [[nodiscard]] bool empty() const { return cases.empty() && !lesson; }
};

// `why`: the reason why there are copies. They are listed by name, study and age.
RescueAnswer ask_about_copies(QWidget* parent, const QString& why, const RescuedWork& work);

}  // namespace tidemark::ui
