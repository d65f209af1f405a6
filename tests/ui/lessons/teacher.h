// The hands of a teacher at the editor of lessons.
#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QLineEdit>
#include <QListWidget>
#include <QRadioButton>
#include <QTest>
#include <filesystem>

#include "tests/ui/file_dialog.h"
#include "ui/widgets/into_sight.h"
#include "ui/widgets/number_box.h"

namespace tidemark::test {

// A shown widget by its accessible name, scrolled to where it can be clicked.
template <class Widget>
Widget* at_hand(QWidget& editor, const QString& name) {
  QCoreApplication::processEvents();  // rows that are new get their place
  for (Widget* widget : editor.findChildren<Widget*>()) {
    const auto* button = qobject_cast<const QAbstractButton*>(widget);
    if (widget->accessibleName() != name && !(button && button->text() == name)) continue;
    if (!widget->isVisible()) continue;
    const bool can_be_clicked = QTest::qWaitFor([widget] {
      ui::bring_into_sight(*widget);
      return !widget->visibleRegion().isEmpty();
    });
    if (!can_be_clicked) qFatal("%s is out of sight", qPrintable(name));
    return widget;
  }
  qFatal("there is no %s", qPrintable(name));
}

inline void click(QWidget& editor, const QString& name) {
  auto* button = at_hand<QAbstractButton>(editor, name);
  // On the mark of a check box or a radio button, not on the empty place behind its text.
  const bool is_mark = qobject_cast<QCheckBox*>(button) || qobject_cast<QRadioButton*>(button);
  const QPoint place = is_mark ? QPoint(8, button->height() / 2) : button->rect().center();
  QTest::mouseClick(button, Qt::LeftButton, {}, place);
}

template <class Field>
void type(QWidget& editor, const QString& name, const QString& text) {
  auto* field = at_hand<Field>(editor, name);
  field->setFocus();
  field->selectAll();
  QTest::keyClicks(field, text);
  if constexpr (std::is_same_v<Field, ui::NumberBox>)
    QTest::keyClick(field, Qt::Key_Tab);  // it is taken then
}

inline void choose(QWidget& editor, const QString& name, const QString& item) {
  auto* box = at_hand<QComboBox>(editor, name);
  const int row = box->findText(item);
  if (row < 0) qFatal("there is no %s", qPrintable(item));
  box->setFocus();
  while (box->currentIndex() != row)
    QTest::keyClick(box, box->currentIndex() < row ? Qt::Key_Down : Qt::Key_Up);
}

// The item of the list: 0 is the lesson itself.
inline void go_to(QWidget& editor, int row) {
  auto* list = editor.findChild<QListWidget*>();
  QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, list->visualItemRect(list->item(row)).center());
}

// Enters a name in the file dialog that is open.
inline bool name_file(QWidget& editor, const std::filesystem::path& file) {
  QFileDialog* dialog = nullptr;
  if (!QTest::qWaitFor([&] { return (dialog = editor.findChild<QFileDialog*>()) && dialog->isVisible(); }))
    return false;
  name_file(*dialog, QString::fromStdString(file.string()));
  return true;
}

}  // namespace tidemark::test
