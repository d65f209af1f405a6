#include "ui/panels/panel.h"

#include <QLabel>
#include <QVBoxLayout>

#include "ui/look/theme.h"
#include "ui/widgets/form.h"

namespace tidemark {

Panel::Panel(const QString& hint, QWidget* parent)
    : SessionWidget(parent),
      hint_(make_note(hint)),
      content_(new QWidget),
      parts_(new QVBoxLayout(content_)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(kSpace, kSpace, kSpace, kSpace);
  column->setSpacing(kSpace);
  column->addWidget(hint_);
  column->addWidget(content_);
  column->addStretch(1);
  parts_->setContentsMargins(0, 0, 0, 0);
  parts_->setSpacing(kSpaceGroups);
  content_->setEnabled(false);
}

void Panel::add(QWidget* part) {
  parts_->addWidget(part);
}

void Panel::add(SessionWidget* part) {
  parts_->addWidget(part);
  session_parts_.push_back(part);
  part->set_session(session());
}

void Panel::attach() {
  hint_->setVisible(session() == nullptr);
  content_->setEnabled(session() != nullptr);
  for (SessionWidget* part : session_parts_) part->set_session(session());
}

}  // namespace tidemark
