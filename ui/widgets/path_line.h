// A row of a form for a path: a line to type it into, and a button to choose it.
#pragma once

#include <QHBoxLayout>
#include <QLineEdit>
#include <QToolButton>

#include "ui/widgets/form.h"

namespace tidemark::ui {

// The row takes the button, whose click is the caller's to answer. The label is the line's accessible name.
inline QLineEdit* add_path_line(Form& form, const QString& label, const QString& tip, QToolButton* choose) {
  auto* whole = new QWidget;
  auto* row = new QHBoxLayout(whole);
  row->setContentsMargins(0, 0, 0, 0);
  auto* line = new QLineEdit;
  line->setAccessibleName(label);
  line->setToolTip(tip);
  whole->setFocusProxy(line);
  row->addWidget(line, 1);
  row->addWidget(choose);
  form.row(label, whole, tip);
  return line;
}

}  // namespace tidemark::ui
