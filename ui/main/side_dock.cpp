#include "ui/main/side_dock.h"

#include <QDockWidget>
#include <QMainWindow>

#include "ui/widgets/relative_font.h"

namespace tidemark::ui {

QDockWidget* make_side_dock(QMainWindow& window, const QString& object_name, const QString& title) {
  constexpr int kWidth = 340;  // logical pixels
  auto* dock = new QDockWidget(title, &window);
  dock->setObjectName(object_name);
  let_title_follow_font(*dock);
  dock->setMinimumWidth(kWidth);
  window.addDockWidget(Qt::LeftDockWidgetArea, dock);
  return dock;
}

}  // namespace tidemark::ui
