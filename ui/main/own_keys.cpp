#include "ui/main/own_keys.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QComboBox>
#include <QKeyEvent>

namespace tidemark::ui {

bool owns_key(const QWidget* in_focus, const QKeyEvent& key) {
  if (key.modifiers() != Qt::NoModifier) return false;
  if (key.key() == Qt::Key_Space) return qobject_cast<const QAbstractButton*>(in_focus) != nullptr;
  if (key.key() != Qt::Key_Home) return false;
  return qobject_cast<const QComboBox*>(in_focus) || qobject_cast<const QAbstractItemView*>(in_focus) ||
         qobject_cast<const QAbstractSlider*>(in_focus);
}

}  // namespace tidemark::ui
