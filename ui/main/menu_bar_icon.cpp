#include "ui/main/menu_bar_icon.h"

#include <QChildEvent>
#include <QMenuBar>
#include <QPainter>
#include <algorithm>

#include "ui/look/icons.h"
#include "ui/look/theme.h"

namespace tidemark {
namespace {

// Qt's own class has no header, and inherits() does not know it.
bool is_icon_label(const QObject& object) {
  return qstrcmp(object.metaObject()->className(), "QMdi::ControlLabel") == 0;
}

// Watches the menu bar for Qt's label, and paints in its place.
class IconPainter : public QObject {
 public:
  using QObject::QObject;

  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::ChildAdded) {
      QObject* child = static_cast<QChildEvent*>(event)->child();
      if (is_icon_label(*child)) child->installEventFilter(this);
      return false;
    }
    if (event->type() != QEvent::Paint || !is_icon_label(*watched)) return false;
    auto* label = static_cast<QWidget*>(watched);
    QPainter painter(label);
    QRect place(0, 0, kIconSmall, kIconSmall);
    place.moveCenter(label->rect().center());
    place.moveLeft(std::min(place.left(), kSpaceTight));  // not at the first menu
    application_icon().paint(&painter, place);
    return true;
  }
};

}  // namespace

void draw_menu_bar_icon_whole(QMenuBar& bar) {
  bar.installEventFilter(new IconPainter(&bar));
}

}  // namespace tidemark
