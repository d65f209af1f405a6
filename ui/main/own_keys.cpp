#include "ui/main/own_keys.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QApplication>
#include <QComboBox>
#include <QKeyEvent>

namespace tidemark::ui {
namespace {

template <class... Widgets>
bool is_any_of(const QWidget* widget) {
  return (qobject_cast<const Widgets*>(widget) || ...);
}

// Lists of Qt's say of each entry that it may have a tick.
bool has_tick(const QModelIndex& cell) {
  return cell.flags().testFlag(Qt::ItemIsUserCheckable) && cell.data(Qt::CheckStateRole).isValid();
}

bool owns_key(const QWidget* in_focus, const QKeyEvent& key) {
  if (key.modifiers() != Qt::NoModifier) return false;
  const auto* view = qobject_cast<const QAbstractItemView*>(in_focus);
  if (key.key() == Qt::Key_Space)
    return is_any_of<QAbstractButton, QComboBox>(in_focus) || (view && has_tick(view->currentIndex()));
  return key.key() == Qt::Key_Home && (view || is_any_of<QComboBox, QAbstractSlider>(in_focus));
}

}  // namespace

OwnKeys::OwnKeys(QObject* parent) : QObject(parent) {
  qApp->installEventFilter(this);
}

bool OwnKeys::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::ShortcutOverride ||
      !owns_key(QApplication::focusWidget(), *static_cast<const QKeyEvent*>(event))) {
    return QObject::eventFilter(watched, event);
  }
  event->accept();
  return true;
}

}  // namespace tidemark::ui
