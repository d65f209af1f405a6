#include "ui/main/menu_bar_icon.h"

#include <QChildEvent>
#include <QMenuBar>
#include <QPainter>
#include <algorithm>

#include "ui/look/icons.h"
#include "ui/look/theme.h"

namespace tidemark::ui {
namespace {

// Watches the menu bar for new children, and paints in place of the label in its corner.
class IconPainter : public QObject {
 public:
  explicit IconPainter(QMenuBar& bar) : QObject(&bar), bar_(bar) {}

  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::ChildAdded && watched == &bar_) {
      static_cast<QChildEvent*>(event)->child()->installEventFilter(this);
      return false;
    }
    if (event->type() != QEvent::Paint) return false;
    QWidget* label = bar_.cornerWidget(Qt::TopLeftCorner);
    if (watched != label) return false;
    QPainter painter(label);
    QRect place(0, 0, kIconSmall, kIconSmall);
    place.moveCenter(label->rect().center());
    place.moveLeft(std::min(place.left(), kSpaceTight));  // not at the first menu
    application_icon().paint(&painter, place);
    return true;
  }

 private:
  QMenuBar& bar_;
};

}  // namespace

void draw_menu_bar_icon_whole(QMenuBar& bar) {
  bar.installEventFilter(new IconPainter(bar));
}

}  // namespace tidemark::ui
