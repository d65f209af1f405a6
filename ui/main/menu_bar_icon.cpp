#include "ui/main/menu_bar_icon.h"

#include <QChildEvent>
#include <QMenuBar>
#include <QPainter>

#include "ui/look/icons.h"
#include "ui/look/theme.h"

namespace tidemark {
namespace {

// Watches the menu bar for Qt's label, and paints in its place.
class IconPainter : public QObject {
 public:
  using QObject::QObject;

  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::ChildAdded) {
      QObject* child = static_cast<QChildEvent*>(event)->child();
      if (child->inherits("QMdi::ControlLabel")) child->installEventFilter(this);
      return false;
    }
    if (event->type() != QEvent::Paint || !watched->inherits("QMdi::ControlLabel")) return false;
    auto* label = static_cast<QWidget*>(watched);
    QPainter painter(label);
    QRect place(0, 0, kIconSmall, kIconSmall);
    place.moveCenter(label->rect().center());
    application_icon().paint(&painter, place);
    return true;
  }
};

}  // namespace

void draw_menu_bar_icon_whole(QMenuBar& bar) {
  bar.installEventFilter(new IconPainter(&bar));
}

}  // namespace tidemark
