#include "ui/widgets/relative_font.h"

#include <QApplication>
#include <QDockWidget>
#include <QEvent>
#include <QWidget>

namespace tidemark::ui {
namespace {

// A child of the widget.
class RelativeFont : public QObject {
 public:
  RelativeFont(QWidget& widget, double size, QFont::Weight weight)
      : QObject(&widget), widget_(widget), size_(size), weight_(weight) {
    widget.installEventFilter(this);
    apply();
  }

  bool eventFilter(QObject* /*watched*/, QEvent* event) override {
    // Under a style sheet no other event says so.
    if (event->type() == QEvent::StyleChange) apply();
    return false;
  }

 private:
  void apply() {
    QFont font = QApplication::font(&widget_);
    font.setPointSizeF(font.pointSizeF() * size_);
    font.setWeight(weight_);
    if (font != widget_.font()) widget_.setFont(font);
  }

  QWidget& widget_;
  double size_;
  QFont::Weight weight_;
};

}  // namespace

void set_relative_font(QWidget& widget, double size, QFont::Weight weight) {
  new RelativeFont(widget, size, weight);
}

// As long as it has none of its own, Qt draws the title with the font of the time when the dock was made.
void let_title_follow_font(QDockWidget& dock) {
  QFont own;
  own.setStyleHint(QFont::System);  // nothing is seen of it
  dock.setFont(own);
}

}  // namespace tidemark::ui
