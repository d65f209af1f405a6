#include "ui/widgets/wide_button.h"

#include <QToolButton>

#include "ui/look/icons.h"
#include "ui/look/theme.h"

namespace tidemark::ui {

QToolButton* make_wide_button(const QString& text, QStringView picture, const QString& tip) {
  auto* button = new QToolButton;
  button->setText(text);
  button->setIcon(icon(picture));
  button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  button->setIconSize({kIconSmall, kIconSmall});
  button->setFocusPolicy(Qt::StrongFocus);
  button->setToolTip(tip);
  button->setAccessibleName(text);
  button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  return button;
}

}  // namespace tidemark::ui
