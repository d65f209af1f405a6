// A tool button with a picture and words, as wide as its column.
#pragma once

#include <QString>
#include <QStringView>

class QToolButton;

namespace tidemark::ui {

QToolButton* make_wide_button(const QString& text, QStringView picture, const QString& tip);

}  // namespace tidemark::ui
