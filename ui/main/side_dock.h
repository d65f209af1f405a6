// A dock at the left of the window for what goes on beside the cases: a lesson, a cohort.
#pragma once

#include <QString>

class QDockWidget;
class QMainWindow;

namespace tidemark::ui {

// Its object's name is that by which an arrangement of the window knows it.
[[nodiscard]] QDockWidget* make_side_dock(QMainWindow& window, const QString& object_name,
                                          const QString& title);

}  // namespace tidemark::ui
